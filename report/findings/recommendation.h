#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/speed_accuracy.h"
#include "report/findings/findings.h"

namespace crosscheck {

/// The representative scene: the last timed cloth without contact, or else the last timed scene. Null if no scene was
/// timed.
const Scene* main_scene(std::span<const Scene> scenes, const TableSet& rows);

/// Cheapest run of another engine within the same accuracy.
struct EngineBeside {
  std::string engine, method;
  double times = 0;         // CPU time of this run / CPU time of mysim's run
  bool timed_whole = true;  // false: the CPU time is scaled from a part of the run
};

struct RecommendedRun {
  std::string method;
  SettingKind setting = SettingKind::step;
  double requested = 0;          // step (s) or tolerance
  double error = 0, motion = 0;  // m
  double error_bar = 0;          // m
  std::string tier;
  long evaluations = 0;              // force evaluations: the cost that is minimised
  double cost = 0;                   // CPU time, s
  bool timed_whole = true;           // false: the CPU time is scaled from a part of the run
  std::vector<std::string> tied;     // methods that cost the same but have larger errors
  std::vector<EngineBeside> beside;  // empty if mysim has no run within the accuracy
  std::string_view bound;            // reason why the step cannot be longer: stability, accuracy, failure or sampling
};

/// The run that recommend() chooses, with an error of at most this fraction of the motion (usually 0.01; other
/// fractions use only steps measured for all methods). Returns nullopt without such a run, truth or timing.
std::optional<RecommendedRun> recommended_run(const std::string& scene, double part_of_motion, const TableSet& rows);

/// "step 2 ms", or "tolerance 1.0e-6".
std::string setting_of(const RecommendedRun& run);

}  // namespace crosscheck
