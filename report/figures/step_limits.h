// Largest stable steps, one row per method, as h omega of the fastest vibration: so expressed, limits of all scenes
// coincide.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/stability.h"
#include "report/figures/figure.h"

namespace crosscheck {

struct StepLimits : FigureInfo {
  /// Limits on one scene, as h omega.
  struct Mark {
    size_t scene;  // index in `scenes`
    double measured;
    std::optional<double> predicted;
    std::string words;
  };
  struct Row {
    double held = 0;    // h omega of the longest stable step
    bool open = false;  // true: no step failed
    std::string words;  // next to the bar
    std::vector<Mark> marks;
    std::string measured, predicted;  // ms, on the scene named by `columns_of`
  };
  struct SceneMark {
    std::string name;
    double omega;  // rad/s
  };
  std::vector<std::string> names;  // top to bottom
  std::vector<Row> rows;
  std::vector<SceneMark> scenes;
  std::string columns_of;
};

/// Reads the rows of table `stability` about states of rest. Methods that are stable at every step come first, then the
/// others by decreasing limit. The result is empty if no limit is known in terms of h omega. Its columns are for
/// `scene`, if the limits of that scene were searched.
StepLimits step_limits_of(const std::vector<LimitRow>& table, const std::string& scene);

/// Text of the measured or predicted limit: a step in ms, or a word.
std::string measured_text(const LimitRow& row);
std::string predicted_text(const LimitRow& row);

Drawing drawing_of(const StepLimits& limits);

}  // namespace crosscheck
