// Round-robin timing and order statistics.
#include "experiments/timing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace crosscheck {
namespace {

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// The largest k such that fewer than k of n fair coins show heads with probability 0.05 at most; at least 1.
size_t rank_of_bound(size_t n) {
  double weight = std::pow(0.5, static_cast<double>(n)), below = 0;  // P(heads = k - 1), and P(heads < k)
  size_t k = 0;
  while (k < n && below + weight <= 0.05) {
    below += weight;
    weight *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    ++k;
  }
  return std::max<size_t>(1, k);
}

double once(const std::function<double()>& run, double resolution) {
  double sum = 0;
  int count = 0;
  // 1000: what takes hardly any time must end too
  do sum += run();
  while (++count < 1000 && sum < resolution);
  return sum / count;
}

}  // namespace

Timing timing_of(std::vector<double> seconds) {
  if (seconds.empty()) throw std::invalid_argument("timing_of: no times");
  std::sort(seconds.begin(), seconds.end());
  const size_t k = rank_of_bound(seconds.size());
  return {median_of(seconds), seconds[k - 1], seconds[seconds.size() - k], static_cast<long>(seconds.size())};
}

std::vector<std::vector<double>> timed_in_turns(std::span<const std::function<double()>> runs, const TimingPlan& plan) {
  std::vector<std::vector<double>> times(runs.size());
  std::vector<size_t> telling;
  for (size_t i = 0; i < runs.size(); ++i) {
    const double first = runs[i]();
    if (first > 0)
      telling.push_back(i);
    else
      times[i] = {0};
    if (first >= plan.warm) times[i] = {first};
  }
  for (int round = 0; round < plan.most; ++round)
    for (const size_t i : telling) {
      const double spent = std::accumulate(times[i].begin(), times[i].end(), 0.);
      const auto repetitions = static_cast<int>(times[i].size());
      if (repetitions < plan.least || (repetitions < plan.most && spent < plan.enough))
        times[i].push_back(once(runs[i], plan.resolution));
    }
  return times;
}

std::vector<double> quotients(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) all.push_back(a[i] / b[i]);
  return all;
}

double noise_floor(std::span<const std::vector<double>> times) {
  std::vector<double> apart;
  for (const auto& run : times) {
    std::vector<double> half[2];
    for (size_t i = 0; i < run.size(); ++i) half[i % 2].push_back(run[i]);
    if (half[1].empty()) continue;
    const double a = median_of(half[0]), b = median_of(half[1]);
    if (a + b > 0) apart.push_back(std::abs(a - b) / ((a + b) / 2));
  }
  if (apart.empty()) return 0.01;
  std::sort(apart.begin(), apart.end());
  return std::max(0.01, apart[static_cast<size_t>(0.9 * static_cast<double>(apart.size() - 1))]);
}

bool differ(const Timing& a, const Timing& b, double noise) {
  const bool apart = a.high < b.low || b.high < a.low;
  return apart && std::abs(a.median - b.median) > noise * std::min(a.median, b.median);
}

}  // namespace crosscheck
