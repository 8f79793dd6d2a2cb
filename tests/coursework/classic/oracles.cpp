#include "tests/coursework/classic/oracles.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace coursework::classic {
namespace {

using std::size_t;

double length(const double* v) { return std::hypot(v[0], v[1], v[2]); }
double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
bool zero(const double* v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// Of single-precision numbers that went the same way.
bool close(double a, double b) { return std::abs(a - b) <= 1e-5 * std::max({1.0, std::abs(a), std::abs(b)}); }

/// 1 where all are positive, -1 where all are negative, 0 where all are neither; else 0.5.
double sign(int plus, int minus, int all) {
  if (all == 0 || plus + minus == 0) return 0;
  return plus == all ? 1 : minus == all ? -1 : 0.5;
}

size_t count_of(const Numbers& raw, size_t each) {
  if (raw.empty() || !(raw[0] >= 1) || raw[0] > 1e6) return 0;
  const auto n = static_cast<size_t>(raw[0]);
  return raw.size() >= 1 + n * each ? n : 0;
}

}  // namespace

Feature share(int good, int all) { return all == 0 ? Feature(0) : Feature(double(good) / all, all); }

Features purity(const Numbers& raw) {
  if (raw.size() < 6) return {0, 0, 0, 0};
  int all = 0, again = 0, kept = 0, given = 0;
  bool something = false;
  for (size_t i = 2; i + 3 < raw.size(); i += 4, ++all) {
    again += raw[i] == raw[i + 1];
    given += close(raw[i], raw[i + 2]);
    kept += raw[i + 3] == 0;
    something = something || raw[i] != 0;
  }
  // an evalF that is zero whatever it is given uses nothing
  return {raw[1] / raw[0], something ? share(again, all) : 0, something ? share(kept, all) : 0,
          something ? share(given, all) : 0};
}

Features motion(const Numbers& raw, int wanted) {
  const size_t n = count_of(raw, 30);
  if (n == 0) return {0, 0, 0, 0};
  int fixed = 0, still = 0, right = 0;
  for (size_t i = 0; i < n; ++i) {
    const bool at_rest = zero(&raw[1 + 3 * i]);
    bool stays = true, rests = true, follows = true;
    for (size_t draw = 0; draw < 3; ++draw) {
      const double* v = &raw[1 + 3 * n + (draw * n + i) * 9];
      stays = stays && zero(v + 3);
      rests = rests && zero(v + 6);
      for (int k = 0; k < 3; ++k) follows = follows && close(v[k], v[3 + k]);
    }
    fixed += stays || rests;
    still += stays || (rests && at_rest);
    right += stays || follows;
  }
  const int particles = static_cast<int>(n);
  return {share(std::min(particles, wanted), wanted), share(right, particles), double(fixed), share(still, fixed)};
}

Features gravity(const Numbers& raw) {
  const size_t n = count_of(raw, 18);
  if (n == 0) return {0, 0};
  std::vector<double> down;
  int plus = 0, minus = 0;
  for (size_t i = 0; i < n; ++i) {
    bool moves = false;
    std::vector<double> draws;
    for (size_t draw = 0; draw < 3; ++draw) {
      const double* a = &raw[1 + (draw * n + i) * 6];
      moves = moves || !zero(a) || !zero(a + 3);
      double even[3];
      for (int k = 0; k < 3; ++k) even[k] = -(a[k] + a[k + 3]) / 2;
      // y is up; a few take z
      const double here = std::abs(even[1]) < 1e-3 * std::abs(even[2]) ? even[2] : even[1];
      // what single precision leaves of springs that cancel
      draws.push_back(std::abs(here) < 1e-5 * (length(a) + length(a + 3)) ? 0 : here);
    }
    if (!moves) continue;
    // an obstacle may be in the way of one draw
    std::sort(draws.begin(), draws.end());
    down.push_back(draws[1]);
    plus += draws[1] > 0;
    minus += draws[1] < 0;
  }
  if (down.empty()) return {0, 0};
  const auto [low, high] = std::minmax_element(down.begin(), down.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  const bool alike = largest > 0 && *high - *low < 0.02 * largest;
  return {sign(plus, minus, static_cast<int>(down.size())), alike ? 1.0 : 0.0};
}

Features drag(const Numbers& raw) {
  const size_t n = count_of(raw, 12);
  int all = 0, plus = 0, minus = 0, straight = 0;
  for (size_t i = 0; i < n; ++i) {
    const double* w = &raw[1 + i * 12];
    const double *a0 = w + 3, *a1 = w + 6, *a2 = w + 9;
    if (zero(a0) && zero(a1) && zero(a2)) continue;
    ++all;
    double once[3], bent[3];
    for (int k = 0; k < 3; ++k) once[k] = a1[k] - a0[k], bent[k] = a2[k] - a1[k] - once[k];
    const double rate = -dot(once, w) / dot(w, w);
    // weaker than any that was seen (0.03), and above what rounding leaves of stiff springs
    plus += rate > 1e-3;
    minus += rate < -1e-3;
    double across[3];
    for (int k = 0; k < 3; ++k) across[k] = once[k] + rate * w[k];
    straight += length(once) > 0 && length(bent) < 0.03 * length(once) && length(across) < 0.03 * length(once);
  }
  return {sign(plus, minus, all), share(straight, all)};
}

}  // namespace coursework::classic
