// Which run to take for a scene.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/speed_accuracy.h"
#include "report/findings/findings.h"

namespace crosscheck {

/// The scene that stands for the others where one must: the last cloth without contact that was timed, else the last
/// scene that was; null where none was.
const Scene* main_scene(std::span<const Scene> scenes, const TableSet& rows);

/// The cheapest run of another engine within the same accuracy.
struct EngineBeside {
  std::string engine, method;
  double times = 0;         // its CPU time over that of mysim's run
  bool timed_whole = true;  // else its time is scaled from a part of the run
};

/// A run to take for a scene.
struct RecommendedRun {
  std::string method;
  SettingKind setting = SettingKind::step;
  double requested = 0;              // s, or a tolerance
  double error = 0, motion = 0;      // m
  double error_bar = 0;              // m, of the truth
  std::string tier;                  // of the truth
  long evaluations = 0;              // force evaluations, the cost that it is chosen by
  double cost = 0;                   // s of CPU time
  bool timed_whole = true;           // else scaled from a part of the run
  std::vector<std::string> tied;     // others of the same cost, each further from the truth
  std::vector<EngineBeside> beside;  // where mysim has a run within the accuracy, too
  std::string_view bound;            // stability, accuracy, failure or sampling keeps the step from being longer
};

/// The run that recommend() chooses within a part of the motion, 0.01 or, from the steps of the ladder alone, another.
/// Empty where there is none, no truth, or no time of it.
std::optional<RecommendedRun> recommended_run(const std::string& scene, double part_of_motion, const TableSet& rows);

/// "step 2 ms", or "tolerance 1.0e-6".
std::string setting_of(const RecommendedRun& run);

}  // namespace crosscheck
