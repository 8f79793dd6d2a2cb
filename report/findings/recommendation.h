// The recommended run of a scene.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/speed_accuracy.h"
#include "report/findings/findings.h"

namespace crosscheck {

/// The representative scene: the last timed cloth without contact, else the last timed scene; null if none was timed.
const Scene* main_scene(std::span<const Scene> scenes, const TableSet& rows);

/// The cheapest run of another engine within the same accuracy.
struct EngineBeside {
  std::string engine, method;
  double times = 0;         // its CPU time / that of mysim's run
  bool timed_whole = true;  // false: its time is scaled from a part of the run
};

/// The recommended run of a scene.
struct RecommendedRun {
  std::string method;
  SettingKind setting = SettingKind::step;
  double requested = 0;              // s, or a tolerance
  double error = 0, motion = 0;      // m
  double error_bar = 0;              // m, error bar of the truth
  std::string tier;                  // tier of the truth
  long evaluations = 0;              // force evaluations, the cost that is minimised
  double cost = 0;                   // s of CPU time
  bool timed_whole = true;           // false: scaled from a part of the run
  std::vector<std::string> tied;     // other methods of the same cost, each with a larger error
  std::vector<EngineBeside> beside;  // if mysim has a run within the accuracy, too
  std::string_view bound;            // why the step cannot be longer: stability, accuracy, failure or sampling
};

/// The run that recommend() chooses within a fraction of the motion (0.01; other fractions use the steps of the ladder
/// only). Empty if there is no such run, no truth, or no timing of it.
std::optional<RecommendedRun> recommended_run(const std::string& scene, double part_of_motion, const TableSet& rows);

/// "step 2 ms", or "tolerance 1.0e-6".
std::string setting_of(const RecommendedRun& run);

}  // namespace crosscheck
