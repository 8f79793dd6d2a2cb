// Largest stable steps in units of the fastest vibration: a row for each method, in which all scenes fall on one line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/stability.h"
#include "report/figures/figure.h"

namespace crosscheck {

struct StepLimits : FigureInfo {
  /// The limit on one scene, in h omega.
  struct Mark {
    size_t scene;  // of `scenes`
    double measured;
    std::optional<double> predicted;
    std::string words;
  };
  struct Row {
    double held = 0;    // h omega up to which runs hold
    bool open = false;  // no step failed
    std::string words;  // beside the bar
    std::vector<Mark> marks;
    std::string measured, predicted;  // ms, on the scene of the columns
  };
  struct SceneMark {
    std::string name;
    double omega;  // rad/s
  };
  std::vector<std::string> names;  // methods, from above
  std::vector<Row> rows;           // one for each
  std::vector<SceneMark> scenes;
  std::string columns_of;  // a scene
};

/// From rows of table `stability` about states of rest: methods that hold at every step first, then from long limits to
/// short ones. Methods, scenes and columns are empty where no limit is known in h omega. `scene` is that of the
/// columns where it was searched.
StepLimits step_limits_of(const std::vector<LimitRow>& table, const std::string& scene);

/// Limits in ms by runs and by theory, or a word.
std::string measured_text(const LimitRow& row);
std::string predicted_text(const LimitRow& row);

/// Throws std::runtime_error that names the figure when there is nothing to draw.
Drawing drawing_of(const StepLimits& limits);

}  // namespace crosscheck
