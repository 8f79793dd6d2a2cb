// The tables of experiment `speed-accuracy`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// The kind of a run's setting: a step, or the tolerance of an adaptive method.
enum class SettingKind { step, tolerance };
inline std::string_view name_of(SettingKind kind) { return kind == SettingKind::step ? "step [s]" : "tolerance [1]"; }
template <>
inline constexpr std::pair range_of<SettingKind>{SettingKind::step, SettingKind::tolerance};

/// The distance that accuracy is judged by: an error, or a difference from the converged contact rule.
enum class Measure { error, difference };
inline std::string_view name_of(Measure measure) { return measure == Measure::error ? "error" : "difference"; }
template <>
inline constexpr std::pair range_of<Measure>{Measure::error, Measure::difference};

enum class RunEnd { ok, failed };
inline std::string_view name_of(RunEnd end) { return end == RunEnd::ok ? "ok" : "failed"; }
template <>
inline constexpr std::pair range_of<RunEnd>{RunEnd::ok, RunEnd::failed};

/// The cost that runs are compared by.
enum class Cost { evaluations, cpu };

/// Errors of every method at many steps or tolerances.
struct SpeedAccuracyRow {
  TABLE("speed-accuracy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "what was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "step or tolerance that was asked for");
  COLUMN(double, step, "step", "s", "time step used; the mean of adaptive methods");
  COLUMN(long, steps, "steps", "1", "time steps taken");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, end, "end", "s", "simulated time reached");
  COLUMN(OptionalNumber, error, "largest error", "m", "largest RMS position error against the truth");
  COLUMN(OptionalNumber, error_over_time, "error over time", "m", "the same error, RMS over time");
  COLUMN(OptionalNumber, difference, "largest difference from converged contact", "m",
         "largest RMS position difference from the converged contact rule");
  COLUMN(OptionalNumber, difference_over_time, "difference from converged contact over time", "m",
         "the same difference, RMS over time");
  COLUMN(OptionalNumber, to_own_finest, "distance to own finest", "m",
         "largest RMS position difference from the method's own finest run");
  COLUMN(double, motion, "motion", "m", "largest RMS distance of the truth from the start");
  COLUMN(double, until, "until", "s", "time up to which errors are taken");
  COLUMN(std::optional<std::string>, truth, "truth", "1", "tier of the truth");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(std::string, different_law, "different law", "1", "ingredients that the method follows under another law");
};

/// CPU time of the same runs, or of their first part.
struct SpeedAccuracyTimingRow {
  TABLE("speed-accuracy-timing-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "what was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "step or tolerance that was asked for");
  COLUMN(double, part, "part of the run", "1", "part of the run that was timed");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations in that part");
  COLUMN(double, cpu, "cpu", "s", "CPU time of that part, median");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(long, repetitions, "repetitions", "1", "runs that were timed");
  COLUMN(double, noise, "noise", "1", "relative difference of two measurements of the same");
};

/// CPU time of whole runs.
struct SpeedAccuracyCostRow {
  TABLE("speed-accuracy-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "what was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "step or tolerance that was asked for");
  COLUMN(RunEnd, verdict, "verdict", "1", "whether the run ended well");
  COLUMN(double, cpu, "cpu", "s",
         "CPU time of the whole run, median; scaled from a part by force evaluations, of Bullet's implicit and "
         "position-based worlds by steps");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(long, repetitions, "repetitions", "1", "runs that were timed");
  COLUMN(double, part, "part timed", "1", "part of the run that was timed; the rest is scaled");
  COLUMN(double, noise, "noise", "1", "relative difference of two measurements of the same");
  COLUMN(std::string, build, "build", "1", "who compiled the code that was timed");
};

/// Runs that no cheaper run beats.
template <Cost kind>
struct ParetoRow {
  static constexpr bool timed = kind == Cost::cpu;
  TABLE(timed ? "speed-accuracy-pareto-cost" : "speed-accuracy-pareto");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, cost, timed ? "cpu" : "evaluations", timed ? "s" : "1",
         timed ? "CPU time of the run" : "force evaluations");
  COLUMN(double, distance, "distance", "m", "largest RMS position error or difference");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "what was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "step or tolerance that was asked for");
};

/// Cheapest run within an accuracy, and Bullet's.
template <Cost kind>
struct CheapestRow {
  static constexpr bool timed = kind == Cost::cpu;
  TABLE(timed ? "speed-accuracy-cheapest-cost" : "speed-accuracy-cheapest");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, part_of_motion, "part of motion", "1", "accuracy, as a part of the motion");
  COLUMN(double, bound, "bound", "m", "accuracy, as a distance");
  COLUMN(Measure, measure, "measure", "1", "distance that is bounded");
  COLUMN(std::optional<std::string>, method, "method", "1", "method of the cheapest run");
  COLUMN(std::optional<SettingKind>, setting, "setting", "1", "what was set, and its unit");
  COLUMN(OptionalNumber, requested, "asked", "see setting", "step or tolerance that was asked for");
  COLUMN(OptionalNumber, cost, timed ? "cpu" : "evaluations", timed ? "s" : "1",
         timed ? "CPU time of the run" : "force evaluations");
  COLUMN(OptionalNumber, distance, "distance", "m", "its largest RMS position error or difference");
  COLUMN(std::optional<std::string>, bullet, "best of Bullet", "1", "method of Bullet's cheapest run");
  COLUMN(std::optional<SettingKind>, bullet_setting, "setting of Bullet", "1", "what was set in Bullet, and its unit");
  COLUMN(OptionalNumber, bullet_requested, "asked of Bullet", "see setting", "step that was asked for in Bullet");
  COLUMN(OptionalNumber, bullet_cost, timed ? "cpu of Bullet" : "evaluations of Bullet", timed ? "s" : "1",
         timed ? "CPU time of Bullet's run" : "force evaluations of Bullet's run");
  COLUMN(OptionalNumber, bullet_distance, "distance of Bullet", "m",
         "largest RMS position error or difference of Bullet's run");
  COLUMN(OptionalNumber, bullet_over_mysim, "Bullet / mysim", "1", "cost of Bullet's over that of mysim's cheapest");
  COLUMN(std::optional<std::string>, tied, "as cheap within noise", "1",
         "methods that cannot be told from the cheapest");
  COLUMN(std::optional<std::string>, remark, "remark", "1", "why there is no run");
};

/// Cheapest run of each engine within an accuracy, beside mysim's.
struct EngineSpeedRow {
  TABLE("speed-accuracy-engines-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, part_of_motion, "part of motion", "1", "accuracy, as a part of the motion");
  COLUMN(Measure, measure, "measure", "1", "distance that is bounded");
  COLUMN(std::string, engine, "engine", "1", "engine");
  COLUMN(std::string, method, "method", "1", "method of its cheapest run");
  COLUMN(SettingKind, setting, "setting", "1", "what was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "step or tolerance that was asked for");
  COLUMN(double, cpu, "cpu", "s", "CPU time of the run");
  COLUMN(double, distance, "distance", "m", "its largest RMS position error or difference");
  COLUMN(OptionalNumber, times_mysim, "times mysim", "1", "CPU time over that of mysim's cheapest run");
  COLUMN(OptionalNumber, times_mysim_low, "times mysim low", "1", "least that both intervals allow");
  COLUMN(OptionalNumber, times_mysim_high, "times mysim high", "1", "most that both intervals allow");
  COLUMN(double, part_timed, "part timed", "1", "part of the run that was timed; the rest is scaled");
  COLUMN(OptionalNumber, part_timed_of_mysim, "part timed of mysim", "1", "the same of mysim's run");
};

}  // namespace crosscheck
