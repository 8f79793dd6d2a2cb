#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

enum class SettingKind { step, tolerance };
inline std::string_view name_of(SettingKind kind) { return kind == SettingKind::step ? "step [s]" : "tolerance [1]"; }
template <>
inline constexpr std::pair range_of<SettingKind>{SettingKind::step, SettingKind::tolerance};

/// The distance that measures accuracy: an error, or a difference from the converged contact rule of mysim.
enum class Measure { error, difference };
inline std::string_view name_of(Measure measure) { return measure == Measure::error ? "error" : "difference"; }
template <>
inline constexpr std::pair range_of<Measure>{Measure::error, Measure::difference};

enum class RunEnd { ok, failed };
inline std::string_view name_of(RunEnd end) { return end == RunEnd::ok ? "ok" : "failed"; }
template <>
inline constexpr std::pair range_of<RunEnd>{RunEnd::ok, RunEnd::failed};

enum class Cost { evaluations, cpu };

struct SpeedAccuracyRow {
  TABLE("speed-accuracy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "quantity that was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "requested step or tolerance");
  COLUMN(double, step, "step", "s", "time step used; the mean for adaptive methods");
  COLUMN(long, steps, "steps", "1", "time steps taken");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, end, "end", "s", "simulated time reached");
  COLUMN(OptionalNumber, error, "largest error", "m", "largest RMS position error against the truth");
  COLUMN(OptionalNumber, error_over_time, "error over time", "m", "RMS over time of the RMS position error");
  COLUMN(OptionalNumber, difference, "largest difference from converged contact", "m",
         "largest RMS position difference from the converged contact rule");
  COLUMN(OptionalNumber, difference_over_time, "difference from converged contact over time", "m",
         "RMS over time of that difference");
  COLUMN(OptionalNumber, to_own_finest, "distance to own finest", "m",
         "largest RMS position difference from the method's own finest run");
  COLUMN(double, motion, "motion", "m", "largest RMS distance of the truth from the start");
  COLUMN(double, until, "until", "s", "time up to which errors are measured");
  COLUMN(std::optional<std::string>, truth, "truth", "1", "tier of the truth");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(std::string, different_law, "different law", "1", "ingredients that the method models with a different law");
};

/// CPU time of the runs in `speed-accuracy`, or of the first part of each run.
struct SpeedAccuracyTimingRow {
  TABLE("speed-accuracy-timing-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "quantity that was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "requested step or tolerance");
  COLUMN(double, part, "part of the run", "1", "fraction of the run that was timed");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations in that part");
  COLUMN(double, cpu, "cpu", "s", "median CPU time of that part");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(long, repetitions, "repetitions", "1", "runs that were timed");
  COLUMN(double, noise, "noise", "1", "relative difference of two measurements of the same run");
};

struct SpeedAccuracyCostRow {
  TABLE("speed-accuracy-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "quantity that was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "requested step or tolerance");
  COLUMN(RunEnd, verdict, "verdict", "1", "whether the run ended well");
  COLUMN(double, cpu, "cpu", "s",
         "median CPU time of the whole run; scaled up from a part by force evaluations, for Bullet's implicit and "
         "position-based worlds by steps");
  COLUMN(double, cpu_low, "cpu low", "s", "lower end of its 90 % interval");
  COLUMN(double, cpu_high, "cpu high", "s", "upper end of its 90 % interval");
  COLUMN(long, repetitions, "repetitions", "1", "runs that were timed");
  COLUMN(double, part, "part timed", "1", "fraction of the run that was timed; the rest is scaled up");
  COLUMN(double, noise, "noise", "1", "relative difference of two measurements of the same run");
  COLUMN(std::string, build, "build", "1", "build that the timed code comes from");
};

/// A run on the Pareto front: no cheaper run is as accurate.
template <Cost kind>
struct ParetoRow {
  static constexpr bool timed = kind == Cost::cpu;
  TABLE(timed ? "speed-accuracy-pareto-cost" : "speed-accuracy-pareto");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, cost, timed ? "cpu" : "evaluations", timed ? "s" : "1",
         timed ? "CPU time of the run" : "force evaluations");
  COLUMN(double, distance, "distance", "m", "largest RMS position error or difference");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(SettingKind, setting, "setting", "1", "quantity that was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "requested step or tolerance");
};

template <Cost kind>
struct CheapestRow {
  static constexpr bool timed = kind == Cost::cpu;
  TABLE(timed ? "speed-accuracy-cheapest-cost" : "speed-accuracy-cheapest");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, part_of_motion, "part of motion", "1", "accuracy, as a fraction of the motion");
  COLUMN(double, bound, "bound", "m", "accuracy, as a distance");
  COLUMN(Measure, measure, "measure", "1", "bounded distance");
  COLUMN(std::optional<std::string>, method, "method", "1", "method of the cheapest run");
  COLUMN(std::optional<SettingKind>, setting, "setting", "1", "quantity that was set, and its unit");
  COLUMN(OptionalNumber, requested, "asked", "see setting", "requested step or tolerance");
  COLUMN(OptionalNumber, cost, timed ? "cpu" : "evaluations", timed ? "s" : "1",
         timed ? "CPU time of the run" : "force evaluations");
  COLUMN(OptionalNumber, distance, "distance", "m", "largest RMS position error or difference of that run");
  COLUMN(std::optional<std::string>, bullet, "best of Bullet", "1", "method of Bullet's cheapest run");
  COLUMN(std::optional<SettingKind>, bullet_setting, "setting of Bullet", "1",
         "quantity that was set in Bullet, and its unit");
  COLUMN(OptionalNumber, bullet_requested, "asked of Bullet", "see setting", "requested step in Bullet");
  COLUMN(OptionalNumber, bullet_cost, timed ? "cpu of Bullet" : "evaluations of Bullet", timed ? "s" : "1",
         timed ? "CPU time of Bullet's run" : "force evaluations of Bullet's run");
  COLUMN(OptionalNumber, bullet_distance, "distance of Bullet", "m",
         "largest RMS position error or difference of Bullet's run");
  COLUMN(OptionalNumber, bullet_over_mysim, "Bullet / mysim", "1",
         "cost of Bullet's cheapest run over that of mysim's");
  COLUMN(std::optional<std::string>, tied, "as cheap within noise", "1",
         "methods that cannot be distinguished from the cheapest");
  COLUMN(std::optional<std::string>, remark, "remark", "1", "why there is no run");
};

struct EngineSpeedRow {
  TABLE("speed-accuracy-engines-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, part_of_motion, "part of motion", "1", "accuracy, as a fraction of the motion");
  COLUMN(Measure, measure, "measure", "1", "bounded distance");
  COLUMN(std::string, engine, "engine", "1", "engine");
  COLUMN(std::string, method, "method", "1", "method of the engine's cheapest run");
  COLUMN(SettingKind, setting, "setting", "1", "quantity that was set, and its unit");
  COLUMN(double, requested, "asked", "see setting", "requested step or tolerance");
  COLUMN(double, cpu, "cpu", "s", "CPU time of the run");
  COLUMN(double, distance, "distance", "m", "largest RMS position error or difference of that run");
  COLUMN(OptionalNumber, times_mysim, "times mysim", "1", "CPU time over that of mysim's cheapest run");
  COLUMN(OptionalNumber, times_mysim_low, "times mysim low", "1", "smallest ratio that both intervals allow");
  COLUMN(OptionalNumber, times_mysim_high, "times mysim high", "1", "largest ratio that both intervals allow");
  COLUMN(double, part_timed, "part timed", "1", "fraction of the run that was timed; the rest is scaled up");
  COLUMN(OptionalNumber, part_timed_of_mysim, "part timed of mysim", "1", "fraction of mysim's run that was timed");
};

}  // namespace crosscheck
