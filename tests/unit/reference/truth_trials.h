// Compares a scene's converged truth and its error bar with the exact solution.
#pragma once

#include "reference/truth/exact/exact.h"
#include "reference/truth/truth.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck::testing_tools {

struct BarTrial {
  std::string scene;
  bool known = false;    // a converged truth was found
  double error_bar = 0;  // m
  double error = 0;      // m, largest at any sample
  /// m, of the closed form: 1e-15 times the scene's size plus the path length.
  double round_off = 0;

  double ratio() const { return error_bar / error; }
  bool covered() const { return known && error_bar >= error; }
  /// True if truncation dominates the error. Only then can a bar be too wide.
  bool above_round_off() const { return known && error > 10 * round_off; }
};

inline BarTrial bar_trial(const Scene& scene) {
  BarTrial trial{scene.name};
  const auto exact = exact_solution(scene);
  const auto truth = converged_truth(scene, default_run(scene));
  trial.known = exact && truth;
  if (!trial.known) return trial;
  trial.error_bar = truth->error_bar;
  double path = 0;
  for (int i = 0; i < truth->trajectory.frames(); ++i) {
    trial.error = std::max(trial.error, rms_distance(truth->trajectory.x[i], exact->at(truth->trajectory.t[i]).x));
    if (i > 0) path += (truth->trajectory.x[i] - truth->trajectory.x[i - 1]).norm();
  }
  trial.round_off = 1e-15 * (scene.size() + path);
  return trial;
}

struct BarSummary {
  size_t scenes = 0, known = 0, covered = 0, above = 0;
  double median = 0, high = 0;  // bar divided by error above round-off: median and 95th percentile
  double least = INFINITY;      // smallest ratio of bar to error in all trials
};

inline BarSummary summary_of(const std::vector<BarTrial>& trials) {
  BarSummary s;
  std::vector<double> ratios;
  for (const BarTrial& t : trials) {
    ++s.scenes, s.known += t.known, s.covered += t.covered();
    if (t.known) s.least = std::min(s.least, t.ratio());
    if (t.above_round_off()) ratios.push_back(t.ratio());
  }
  std::sort(ratios.begin(), ratios.end());
  s.above = ratios.size();
  if (!ratios.empty()) {
    s.median = ratios[ratios.size() / 2];
    s.high = ratios[static_cast<size_t>(std::ceil(0.95 * static_cast<double>(ratios.size()))) - 1];
  }
  return s;
}

inline std::string text_of(const BarSummary& s) {
  return fmt::format(
      "{} scenes: {} known, {} covered, bar over error at least {:.3g}; {} above ten times round-off: {:.3g} in the "
      "median, {:.3g} at the 95th percentile",
      s.scenes, s.known, s.covered, s.least, s.above, s.median, s.high);
}

}  // namespace crosscheck::testing_tools
