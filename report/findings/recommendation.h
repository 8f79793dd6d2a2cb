// Which run to take for a scene.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/tables/speed_accuracy.h"
#include "report/findings/findings.h"

namespace crosscheck {

/// The scene that stands for the others where one must: the last cloth without contact that was timed, else the last
/// scene that was; null where none was.
const Scene* main_scene(const std::vector<Scene>& scenes, const TableSet& rows);

/// The cheapest run of another engine within the same accuracy.
struct EngineBeside {
  std::string engine, method;
  double times = 0, low = 0, high = 0;  // its CPU time over that of mysim's run, and what both intervals allow
  bool timed_whole = true;              // else its time is scaled from a part of the run
};

/// A run to take for a scene.
struct RecommendedRun {
  std::string method;
  SettingKind setting = SettingKind::step;
  double requested = 0;              // s, or a tolerance
  double error = 0, motion = 0;      // m
  double error_bar = 0;              // m, of the truth
  std::string tier;                  // of the truth
  long evaluations = 0;              // of forces, the cost that it is chosen by
  double cost = 0;                   // s of CPU time
  bool timed_whole = true;           // else scaled from a part of the run
  std::vector<std::string> tied;     // others of the same cost, each further from the truth
  std::vector<EngineBeside> beside;  // where mysim has a run within the accuracy, too
  std::string_view bound;            // what keeps the step from being longer: stability, accuracy, failure or sampling
};

/// The run that recommend() chooses within a part of the motion, 0.01 or, from the steps of the ladder alone, another.
/// Empty where there is none, no truth, or no time of it.
std::optional<RecommendedRun> recommended_run(const std::string& scene, double part_of_motion, const TableSet& rows);

/// "step 2 ms", or "tolerance 1.0e-6".
std::string setting_of(const RecommendedRun& run);
/// "160 times faster", than real time.
std::string speed_text(const RecommendedRun& run, const Scene& scene);

/// What is said of it in the part of its scene; the page shows it as a row of a table.
std::vector<Finding> recommendation_findings(const Scene& scene, const TableSet& rows);
/// The topic of these.
inline constexpr std::string_view recommendation_topic = "choice";

}  // namespace crosscheck
