#include "experiments/timing/timing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

/// The largest k >= 1 such that n fair coins show fewer than k heads with a probability of at most 0.05; 1 if there is
/// no such k.
size_t rank_of_bound(size_t n) {
  double weight = std::pow(0.5, static_cast<double>(n)), below = 0;  // P(heads = k), and P(heads < k)
  size_t k = 0;
  while (k < n && below + weight <= 0.05) {
    below += weight;
    weight *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    ++k;
  }
  return std::max<size_t>(1, k);
}

}  // namespace

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

double mean_time(const std::function<double()>& run, double resolution) {
  double sum = 0;
  int count = 0;
  // the limit of 1000 ends the loop even if a run takes almost no time
  do sum += run();
  while (++count < 1000 && sum < resolution);
  return sum / count;
}

long repetitions_in(double seconds, const std::function<double(long)>& seconds_of) {
  long count = 1;
  for (double taken; count < (1L << 40) && (taken = seconds_of(count)) < seconds;)
    count = std::lround(std::ceil(static_cast<double>(count) * std::clamp(1.2 * seconds / taken, 2., 64.)));
  return count;
}

Timing timing_of(std::vector<double> seconds) {
  if (seconds.empty()) throw std::invalid_argument("timing_of: no times");
  std::sort(seconds.begin(), seconds.end());
  const size_t k = rank_of_bound(seconds.size());
  return {median_of(seconds), seconds[k - 1], seconds[seconds.size() - k], static_cast<long>(seconds.size())};
}

std::vector<std::vector<double>> time_round_robin(std::span<const std::function<double()>> runs,
                                                  const TimingOptions& plan) {
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
        times[i].push_back(mean_time(runs[i], plan.resolution));
    }
  return times;
}

std::vector<std::vector<double>> time_rounds(std::span<const std::function<double()>> runs, int rounds) {
  return time_round_robin(runs, {.least = rounds, .most = rounds, .resolution = 0, .warm = INFINITY});
}

Timing ratio_of_rounds(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) all.push_back(a[i] / b[i]);
  return timing_of(std::move(all));
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

namespace {

/// The first part of a run, with one sample: further samples would cost as much as some steps of a small scene.
Run part_of(const TimedRun& turn, double share) {
  Run part = turn.run;
  part.samples = 1;
  if (turn.method.adaptive) {
    part.duration = share * turn.run.duration;
    return part;
  }
  const TimeGrid whole = time_grid(turn.run);
  const auto all = static_cast<double>(whole.steps_per_sample) * whole.samples;
  part.step = whole.h;
  part.duration = whole.h * std::clamp(std::round(share * all), 1., all);
  return part;
}

Outcome outcome_of(const TimedRun& turn, double share) {
  std::optional<ScopedInstructionSet> kept;
  if (turn.instructions) kept.emplace(*turn.instructions);
  NullObserver null_observer;
  try {
    return turn.method.engine(*turn.scene, part_of(turn, share), null_observer);
  } catch (const Unsupported&) {
    return {};
  }
}

double share_to_time(const TimedRun& turn, double seconds) {
  double share = 1. / 256;
  while (share < 1) {
    const double taken = outcome_of(turn, share).cpu_seconds;
    if (!(taken < seconds)) break;
    share = std::min(1., share * std::clamp(1.2 * seconds / std::max(taken, 1e-9), 2., 64.));
  }
  return share;
}

}  // namespace

std::vector<EvaluationTimes> time_round_robin(const std::vector<TimedRun>& turns, const TimedRunOptions& plan,
                                              const LockPatience& patience) {
  const MachineLock exclusive(MachineLock::Mode::exclusive, patience);
  std::vector<EvaluationTimes> all(turns.size());
  std::vector<std::function<double()>> runs;
  for (size_t i = 0; i < turns.size(); ++i) {
    all[i].share = share_to_time(turns[i], plan.seconds);
    runs.push_back([&turn = turns[i], share = all[i].share] {
      const Outcome out = outcome_of(turn, share);
      return out.evaluations > 0 ? out.cpu_seconds / static_cast<double>(out.evaluations) : 0;
    });
  }
  // the runs return times per evaluation, and are long enough not to be repeated within a round
  const auto times = time_rounds(runs, plan.rounds);
  for (size_t i = 0; i < turns.size(); ++i)
    if (times[i] != std::vector<double>{0}) all[i].per_evaluation = times[i];
  return all;
}

}  // namespace crosscheck
