// The tables of experiment `speed-accuracy`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// The kind of a run's setting: a step, or the tolerance of an adaptive method.
enum class SettingKind { step, tolerance };
inline std::string_view name_of(SettingKind kind) { return kind == SettingKind::step ? "step [s]" : "tolerance [1]"; }
template <>
struct EnumRange<SettingKind> {
  static constexpr SettingKind first = SettingKind::step, last = SettingKind::tolerance;
};

/// The distance that accuracy is judged by: an error, or a difference from the converged contact rule.
enum class Measure { error, difference };
inline std::string_view name_of(Measure measure) { return measure == Measure::error ? "error" : "difference"; }
template <>
struct EnumRange<Measure> {
  static constexpr Measure first = Measure::error, last = Measure::difference;
};

enum class RunEnd { ok, failed };
inline std::string_view name_of(RunEnd end) { return end == RunEnd::ok ? "ok" : "failed"; }
template <>
struct EnumRange<RunEnd> {
  static constexpr RunEnd first = RunEnd::ok, last = RunEnd::failed;
};

/// The cost that runs are compared by.
enum class Cost { evaluations, cpu };

struct SpeedAccuracyRow {
  std::string scene, method;
  SettingKind setting = SettingKind::step;
  double requested = 0, step = 0;
  long steps = 0, evaluations = 0;
  Verdict verdict = Verdict::ok;
  double end = 0;
  std::optional<double> error, error_over_time, difference, difference_over_time, to_own_finest;
  double motion = 0, until = 0;
  std::optional<std::string> truth;
  std::optional<double> truth_bar;
  std::string different_law;

  static constexpr std::string_view table = "speed-accuracy",
                                    about = "Errors of every method at many steps or tolerances.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &SpeedAccuracyRow::scene, "scene"), column("method", "1", &SpeedAccuracyRow::method, "method"),
        column("setting", "1", &SpeedAccuracyRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &SpeedAccuracyRow::requested, "step or tolerance that was asked for"),
        column("step", "s", &SpeedAccuracyRow::step, "time step used; the mean of adaptive methods"),
        column("steps", "1", &SpeedAccuracyRow::steps, "time steps taken"),
        column("evaluations", "1", &SpeedAccuracyRow::evaluations, "force evaluations"),
        column("verdict", "1", &SpeedAccuracyRow::verdict, "how the run ended"),
        column("end", "s", &SpeedAccuracyRow::end, "simulated time reached"),
        column("largest error", "m", &SpeedAccuracyRow::error, "largest RMS position error against the truth"),
        column("error over time", "m", &SpeedAccuracyRow::error_over_time, "the same error, RMS over time"),
        column("largest difference from converged contact", "m", &SpeedAccuracyRow::difference,
               "largest RMS position difference from the converged contact rule"),
        column("difference from converged contact over time", "m", &SpeedAccuracyRow::difference_over_time,
               "the same difference, RMS over time"),
        column("distance to own finest", "m", &SpeedAccuracyRow::to_own_finest,
               "largest RMS position difference from the method's own finest run"),
        column("motion", "m", &SpeedAccuracyRow::motion, "largest RMS distance of the truth from the start"),
        column("until", "s", &SpeedAccuracyRow::until, "time up to which errors are taken"),
        column("truth", "1", &SpeedAccuracyRow::truth, "tier of the truth"),
        column("truth bar", "m", &SpeedAccuracyRow::truth_bar, "error bar of the truth"),
        column("different law", "1", &SpeedAccuracyRow::different_law,
               "ingredients that the method follows under another law");
  };
};

struct SpeedAccuracyTimingRow {
  std::string scene, method;
  SettingKind setting = SettingKind::step;
  double requested = 0, part = 0;
  long evaluations = 0;
  double cpu = 0, cpu_low = 0, cpu_high = 0;
  long repetitions = 0;
  double noise = 0;

  static constexpr std::string_view table = "speed-accuracy-timing-cost",
                                    about = "CPU time of the same runs, or of their first part.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &SpeedAccuracyTimingRow::scene, "scene"),
        column("method", "1", &SpeedAccuracyTimingRow::method, "method"),
        column("setting", "1", &SpeedAccuracyTimingRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &SpeedAccuracyTimingRow::requested, "step or tolerance that was asked for"),
        column("part of the run", "1", &SpeedAccuracyTimingRow::part, "part of the run that was timed"),
        column("evaluations", "1", &SpeedAccuracyTimingRow::evaluations, "force evaluations in that part"),
        column("cpu", "s", &SpeedAccuracyTimingRow::cpu, "CPU time of that part, median"),
        column("cpu low", "s", &SpeedAccuracyTimingRow::cpu_low, "lower end of its 90 % interval"),
        column("cpu high", "s", &SpeedAccuracyTimingRow::cpu_high, "upper end of its 90 % interval"),
        column("repetitions", "1", &SpeedAccuracyTimingRow::repetitions, "runs that were timed"),
        column("noise", "1", &SpeedAccuracyTimingRow::noise, "relative difference of two measurements of the same");
  };
};

struct SpeedAccuracyCostRow {
  std::string scene, method;
  SettingKind setting = SettingKind::step;
  double requested = 0;
  RunEnd verdict = RunEnd::ok;
  double cpu = 0, cpu_low = 0, cpu_high = 0;
  long repetitions = 0;
  double part = 0, noise = 0;
  std::string build;

  static constexpr std::string_view table = "speed-accuracy-cost", about = "CPU time of whole runs.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &SpeedAccuracyCostRow::scene, "scene"),
        column("method", "1", &SpeedAccuracyCostRow::method, "method"),
        column("setting", "1", &SpeedAccuracyCostRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &SpeedAccuracyCostRow::requested, "step or tolerance that was asked for"),
        column("verdict", "1", &SpeedAccuracyCostRow::verdict, "whether the run ended well"),
        column("cpu", "s", &SpeedAccuracyCostRow::cpu,
               "CPU time of the whole run, median; scaled from a part by force evaluations, of Bullet's implicit and "
               "position-based worlds by steps"),
        column("cpu low", "s", &SpeedAccuracyCostRow::cpu_low, "lower end of its 90 % interval"),
        column("cpu high", "s", &SpeedAccuracyCostRow::cpu_high, "upper end of its 90 % interval"),
        column("repetitions", "1", &SpeedAccuracyCostRow::repetitions, "runs that were timed"),
        column("part timed", "1", &SpeedAccuracyCostRow::part, "part of the run that was timed; the rest is scaled"),
        column("noise", "1", &SpeedAccuracyCostRow::noise, "relative difference of two measurements of the same"),
        column("build", "1", &SpeedAccuracyCostRow::build, "who compiled the code that was timed");
  };
};

template <Cost kind>
struct ParetoRow {
  std::string scene;
  double cost = 0, distance = 0;
  std::string method;
  SettingKind setting = SettingKind::step;
  double requested = 0;

  static constexpr bool timed = kind == Cost::cpu;
  static constexpr std::string_view table = timed ? "speed-accuracy-pareto-cost" : "speed-accuracy-pareto",
                                    about = "Runs that no cheaper run beats.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &ParetoRow::scene, "scene"),
        column(timed ? "cpu" : "evaluations", timed ? "s" : "1", &ParetoRow::cost,
               timed ? "CPU time of the run" : "force evaluations"),
        column("distance", "m", &ParetoRow::distance, "largest RMS position error or difference"),
        column("method", "1", &ParetoRow::method, "method"),
        column("setting", "1", &ParetoRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &ParetoRow::requested, "step or tolerance that was asked for");
  };
};

template <Cost kind>
struct CheapestRow {
  std::string scene;
  double part_of_motion = 0, bound = 0;
  Measure measure = Measure::error;
  std::optional<std::string> method;
  std::optional<SettingKind> setting;
  std::optional<double> requested, cost, distance;
  std::optional<std::string> bullet;
  std::optional<SettingKind> bullet_setting;
  std::optional<double> bullet_requested, bullet_cost, bullet_distance, bullet_over_mysim;
  std::optional<std::string> tied, remark;

  static constexpr bool timed = kind == Cost::cpu;
  static constexpr std::string_view table = timed ? "speed-accuracy-cheapest-cost" : "speed-accuracy-cheapest",
                                    about = "Cheapest run within an accuracy, and Bullet's.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &CheapestRow::scene, "scene"),
        column("part of motion", "1", &CheapestRow::part_of_motion, "accuracy, as a part of the motion"),
        column("bound", "m", &CheapestRow::bound, "accuracy, as a distance"),
        column("measure", "1", &CheapestRow::measure, "distance that is bounded"),
        column("method", "1", &CheapestRow::method, "method of the cheapest run"),
        column("setting", "1", &CheapestRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &CheapestRow::requested, "step or tolerance that was asked for"),
        column(timed ? "cpu" : "evaluations", timed ? "s" : "1", &CheapestRow::cost,
               timed ? "CPU time of the run" : "force evaluations"),
        column("distance", "m", &CheapestRow::distance, "its largest RMS position error or difference"),
        column("best of Bullet", "1", &CheapestRow::bullet, "method of Bullet's cheapest run"),
        column("setting of Bullet", "1", &CheapestRow::bullet_setting, "what was set in Bullet, and its unit"),
        column("asked of Bullet", "see setting", &CheapestRow::bullet_requested, "step that was asked for in Bullet"),
        column(timed ? "cpu of Bullet" : "evaluations of Bullet", timed ? "s" : "1", &CheapestRow::bullet_cost,
               timed ? "CPU time of Bullet's run" : "force evaluations of Bullet's run"),
        column("distance of Bullet", "m", &CheapestRow::bullet_distance,
               "largest RMS position error or difference of Bullet's run"),
        column("Bullet / mysim", "1", &CheapestRow::bullet_over_mysim,
               "cost of Bullet's over that of mysim's cheapest"),
        column("as cheap within noise", "1", &CheapestRow::tied, "methods that cannot be told from the cheapest"),
        column("remark", "1", &CheapestRow::remark, "why there is no run");
  };
};

struct EngineSpeedRow {
  std::string scene;
  double part_of_motion = 0;
  Measure measure = Measure::error;
  std::string engine, method;
  SettingKind setting = SettingKind::step;
  double requested = 0, cpu = 0, distance = 0;
  std::optional<double> times_mysim, times_mysim_low, times_mysim_high;
  double part_timed = 0;
  std::optional<double> part_timed_of_mysim;

  static constexpr std::string_view table = "speed-accuracy-engines-cost",
                                    about = "Cheapest run of each engine within an accuracy, beside mysim's.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &EngineSpeedRow::scene, "scene"),
        column("part of motion", "1", &EngineSpeedRow::part_of_motion, "accuracy, as a part of the motion"),
        column("measure", "1", &EngineSpeedRow::measure, "distance that is bounded"),
        column("engine", "1", &EngineSpeedRow::engine, "engine"),
        column("method", "1", &EngineSpeedRow::method, "method of its cheapest run"),
        column("setting", "1", &EngineSpeedRow::setting, "what was set, and its unit"),
        column("asked", "see setting", &EngineSpeedRow::requested, "step or tolerance that was asked for"),
        column("cpu", "s", &EngineSpeedRow::cpu, "CPU time of the run"),
        column("distance", "m", &EngineSpeedRow::distance, "its largest RMS position error or difference"),
        column("times mysim", "1", &EngineSpeedRow::times_mysim, "CPU time over that of mysim's cheapest run"),
        column("times mysim low", "1", &EngineSpeedRow::times_mysim_low, "least that both intervals allow"),
        column("times mysim high", "1", &EngineSpeedRow::times_mysim_high, "most that both intervals allow"),
        column("part timed", "1", &EngineSpeedRow::part_timed, "part of the run that was timed; the rest is scaled"),
        column("part timed of mysim", "1", &EngineSpeedRow::part_timed_of_mysim, "the same of mysim's run");
  };
};

}  // namespace crosscheck
