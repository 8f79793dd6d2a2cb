#include "tests/coursework/classic/oracles.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace coursework::classic {
namespace {

using probe::Plain, std::size_t;
using Flags = std::vector<bool>;

double dot(const Plain& a, const Plain& b) { return double(a[0]) * b[0] + double(a[1]) * b[1] + double(a[2]) * b[2]; }
int count(const Flags& flags) { return static_cast<int>(std::count(flags.begin(), flags.end(), true)); }

/// True if the particles in `odd` act as anchors of an unusual kind: they are at most half of the particles, and there
/// are no ordinary anchors.
bool few(const Flags& odd, const Flags& anchors) {
  return count(anchors) == 0 && 2 * static_cast<size_t>(count(odd)) <= odd.size();
}

}  // namespace

Feature share(int good, int all) { return all == 0 ? Feature(0) : Feature(double(good) / all, all); }

double sign(int plus, int minus, int all) {
  if (all == 0 || plus + minus == 0) return 0;
  return plus == all ? 1 : minus == all ? -1 : 0.5;
}

bool zero(const Plain& v) { return probe::same(v, {}); }

bool close(const Plain& a, const Plain& b) {
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(a[k] - b[k]) <= 1e-5 * std::max({1.f, std::abs(a[k]), std::abs(b[k])}))) return false;
  return true;
}

Features purity(const Findings& found) {
  const int all = static_cast<int>(found.n);
  int again = 0, kept = 0, given = 0;
  bool something = false;
  for (const auto& [f, once_more, stored_too, change] : found.rows) {
    again += probe::same(f, once_more);
    given += close(f, stored_too);
    kept += zero(change);
    something = something || !zero(f);
  }
  // if evalF is always zero, it uses no input and gets no points here
  return {found.per_entry, something ? share(again, all) : 0, something ? share(kept, all) : 0,
          something ? share(given, all) : 0};
}

Features motion(const Findings& found, int wanted) {
  const size_t n = found.n;
  Flags anchors(n), still(n), driven(n);
  int right = 0;
  for (size_t i = 0; i < n; ++i) {
    bool stays = true, rests = true, follows = true, constant = true;
    for (size_t draw = 0; draw < 3; ++draw) {
      const auto& [v, slope, pull, start] = found.row(i, draw);
      stays = stays && zero(slope);
      rests = rests && zero(pull);
      follows = follows && close(v, slope);
      constant = constant && probe::same(slope, found.row(i)[1]);
    }
    anchors[i] = stays || rests;
    still[i] = stays || (rests && zero(found.row(i)[3]));
    driven[i] = constant;
    right += stays || rests || follows;
  }
  // If there are no ordinary anchors, particles that hang on fixed points in space count as anchors; if there are none
  // of those either, particles with a prescribed velocity do.
  const bool any_tied = count(found.tied) > 0;
  if (few(any_tied ? found.tied : driven, anchors)) {
    if (!any_tied) right += count(driven);
    anchors = any_tied ? found.tied : driven;
    if (any_tied) still = found.tied;
  }
  const int particles = static_cast<int>(n), fixed = count(anchors);
  return {share(std::min(particles, wanted), wanted), share(right, particles), double(fixed),
          share(count(still), fixed)};
}

double gravity_on(const Findings& found, size_t i) {
  std::vector<double> draws;
  for (size_t draw = 0; draw < 3; ++draw) {
    const Plain &a = found.row(i, draw)[0], &mirrored = found.row(i, draw)[1];
    double even[3];
    for (int k = 0; k < 3; ++k) even[k] = -(double(a[k]) + mirrored[k]) / 2;
    // y is up; a few solutions use z
    const double here = std::abs(even[1]) < 1e-3 * std::abs(even[2]) ? even[2] : even[1];
    // zero if below the rounding error of springs whose pulls cancel in single precision
    draws.push_back(std::abs(here) < 1e-5 * (length(a) + length(mirrored)) ? 0 : here);
  }
  // the median, because an obstacle may affect one draw
  std::sort(draws.begin(), draws.end());
  return draws[1];
}

double drag_on(const Findings& found, size_t i) {
  const auto& [w, at_rest, once, twice] = found.row(i);
  const double rate = (dot(at_rest, w) - dot(once, w)) / dot(w, w);
  // the threshold is below the smallest drag seen so far (0.03) and above the rounding error of stiff springs
  return std::abs(rate) > 1e-3 ? rate : 0;
}

Plain proportional_drag(const Findings& found, size_t i) {
  const auto& [w, at_rest, at_w, at_2w] = found.row(i);
  return probe::plus(probe::plus(at_w, 1, at_w), -1, at_rest);
}

bool is_proportional(const Findings& found, size_t i) {
  const auto& [w, at_rest, at_w, at_2w] = found.row(i);
  return length(probe::plus(at_2w, -1, proportional_drag(found, i))) < 0.03f * length(probe::plus(at_w, -1, at_rest));
}

bool is_free(const Findings& found, size_t i, size_t first, size_t last) {
  for (size_t draw = 0; draw * found.n < found.rows.size(); ++draw)
    for (size_t k = first; k <= last; ++k)
      if (!zero(found.row(i, draw)[k])) return true;
  return false;
}

Features gravity(const Findings& found) {
  std::vector<double> down;
  Flags anchors(found.n), weightless;
  for (const bool with_tied : {false, true})  // tied particles only if no other particle is free
    for (size_t i = 0; i < found.n && (!with_tied || down.empty()); ++i) {
      anchors[i] = !is_free(found, i, 0, 1);
      if (anchors[i] || (found.tied[i] && !with_tied)) continue;
      down.push_back(gravity_on(found, i));
      weightless.push_back(down.back() == 0);
    }
  // a particle that is anchored at first and released later may have no weight; another test checks the anchor
  if (few(weightless, anchors)) std::erase(down, 0.0);
  if (down.empty()) return {0, 0};
  const auto [low, high] = std::minmax_element(down.begin(), down.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  const bool alike = largest > 0 && *high - *low < 0.02 * largest;
  const auto plus = std::count_if(down.begin(), down.end(), [](double d) { return d > 0; }),
             minus = std::count_if(down.begin(), down.end(), [](double d) { return d < 0; });
  return {sign(static_cast<int>(plus), static_cast<int>(minus), static_cast<int>(down.size())), alike ? 1.0 : 0.0};
}

Features drag(const Findings& found) {
  int all = 0, plus = 0, minus = 0, straight = 0;
  Flags anchors(found.n), loose(found.n);
  for (size_t i = 0; i < found.n; ++i) {
    const auto& [w, at_rest, at_w, at_2w] = found.row(i);
    anchors[i] = !is_free(found, i, 1, 3);
    if (anchors[i]) continue;
    ++all;
    const double rate = drag_on(found, i);
    plus += rate > 0, minus += rate < 0, loose[i] = rate == 0;
    const Plain once = probe::plus(at_w, -1, at_rest), across = probe::plus(once, static_cast<float>(rate), w);
    straight += rate != 0 && is_proportional(found, i) && length(across) < 0.03f * length(once);
  }
  // a particle that is anchored at first and released later may have no drag, as in gravity()
  if (few(loose, anchors)) all -= count(loose);
  return {sign(plus, minus, all), share(straight, all)};
}

}  // namespace coursework::classic
