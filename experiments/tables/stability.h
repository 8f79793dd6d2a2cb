#pragma once

#include <cmath>

#include "experiments/tables/typed.h"

namespace crosscheck {

/// The state to which a limit refers: the scene's state of rest, or its start if it has none.
enum class LimitState { rest, start };
inline std::string_view name_of(LimitState state) { return state == LimitState::rest ? "rest" : "start"; }
template <>
inline constexpr std::pair range_of<LimitState>{LimitState::rest, LimitState::start};

enum class PredictionKind { limit, no_step, every_step, none };
inline std::string_view name_of(PredictionKind kind) {
  constexpr std::string_view names[] = {"limit", "no stable step", "every step", "none"};
  return names[static_cast<int>(kind)];
}
template <>
inline constexpr std::pair range_of<PredictionKind>{PredictionKind::limit, PredictionKind::none};

struct MeasuredLimit {
  enum Kind { found, no_step, every_step, refused_above, unsupported } kind = found;
  double held = 0, failed = 0;  // s: the steps at the ends of the bracket; 0 if there is no bracket
  std::string reason;           // for a refusal
  /// Geometric mean of the bracket, s.
  double limit() const { return kind == found ? std::sqrt(held * failed) : 0; }
  double precision() const { return kind == found ? failed / held - 1 : 0; }
};

inline std::string_view name_of(MeasuredLimit::Kind kind) {
  constexpr std::string_view names[] = {"limit", "no stable step", "every step tried", "held up to a refusal",
                                        "unsupported"};
  return names[kind];
}
template <>
inline constexpr std::pair range_of<MeasuredLimit::Kind>{MeasuredLimit::found, MeasuredLimit::unsupported};

struct LimitRow {
  TABLE("stability");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(LimitState, state, "state", "1", "state about which the limit is determined");
  COLUMN(PredictionKind, prediction, "prediction", "1", "kind of limit that linear theory predicts");
  COLUMN(OptionalNumber, predicted, "predicted limit", "s", "critical time step by linear theory");
  COLUMN(OptionalNumber, omega, "binding omega", "rad/s", "angular frequency of the mode that sets this limit");
  COLUMN(OptionalNumber, gamma, "binding gamma", "1/s", "damping rate of that mode");
  COLUMN(MeasuredLimit::Kind, measurement, "measurement", "1", "kind of limit that the runs show");
  COLUMN(OptionalNumber, measured, "measured limit", "s", "geometric mean of held and failed");
  COLUMN(OptionalNumber, held, "held", "s", "largest step at which a run held");
  COLUMN(OptionalNumber, failed, "failed", "s", "smallest step at which a run failed");
  COLUMN(OptionalNumber, deviation, "deviation", "1", "measured over predicted limit, less 1");
  COLUMN(std::optional<Verdict>, above, "verdict above", "1", "how the run ended at 1.05 times the failed step");
  COLUMN(long, steps, "steps", "1", "steps of each run");
  COLUMN(std::string, reason, "reason", "1", "why measurement and prediction differ, or why one is missing");
  COLUMN(OptionalNumber, precision, "precision", "1", "width of the bracket from held to failed, over held");
  COLUMN(OptionalNumber, step_below, "step below", "s",
         "largest step up to held that divides the sampling interval, for scenes that have a truth but no rest");
  COLUMN(OptionalNumber, error_below, "error below", "m", "largest RMS position error at that step");
  COLUMN(OptionalNumber, step_above, "step above", "s",
         "smallest step from failed on that divides the sampling interval");
  COLUMN(OptionalNumber, error_above, "error above", "m",
         "largest RMS position error at that step, until the run fails");
  COLUMN(OptionalNumber, motion, "motion", "m", "largest RMS distance of the truth from the start");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
};

/// One step of a run at failing_step(), from the scene's own start.
struct FailureRow {
  TABLE("stability-failure");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(double, h, "time step", "s", "time step of the run");
  COLUMN(double, limit, "measured limit", "s", "largest stable step, from table stability");
  COLUMN(OptionalNumber, growth, "growth by theory", "1",
         "growth factor per step of the energy of the fastest vibration");
  COLUMN(long, step, "step", "1", "steps since the start");
  COLUMN(double, t, "t", "s", "time");
  COLUMN(double, kinetic, "kinetic energy", "J", "kinetic energy of the free particles");
  COLUMN(OptionalNumber, holding, "kinetic energy below", "J",
         "kinetic energy at a quarter of the time step, where the run holds");
  COLUMN(bool, still, "still", "1", "1 if the report shows a picture of this moment");
};

struct GrowthRow {
  TABLE("stability-growth");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(double, omega, "omega", "rad/s", "angular frequency of the mode");
  COLUMN(double, gamma, "gamma", "1/s", "damping rate of the mode");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(double, h_omega, "h omega", "1", "time step times angular frequency");
  COLUMN(OptionalNumber, share_of_limit, "share of limit", "1", "time step over the predicted limit");
  COLUMN(double, predicted, "predicted growth", "1", "spectral radius of a step by theory, less 1");
  COLUMN(double, measured, "measured growth", "1", "mean growth factor of the amplitude per step, less 1");
  COLUMN(double, deviation, "deviation", "1", "measured over predicted growth, less 1");
};

struct MapRow {
  TABLE("stability-map");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, map, "map", "1", "parameter that varies over the rows of the map: stiffness or drag");
  COLUMN(double, value, "value", "see map", "stiffness over the scene's own, or drag rate in 1/s");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(OptionalNumber, end, "end", "s", "simulated time reached");
  COLUMN(OptionalNumber, growth, "growth", "1", "growth of the initial perturbation over the run");
};

struct MapLimitRow {
  TABLE("stability-map-limit");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, map, "map", "1", "parameter that varies over the rows of the map: stiffness or drag");
  COLUMN(double, value, "value", "see map", "stiffness over the scene's own, or drag rate in 1/s");
  COLUMN(OptionalNumber, predicted, "predicted limit", "s", "critical time step by linear theory");
  COLUMN(OptionalNumber, held, "held", "s", "largest step at which a run held");
  COLUMN(OptionalNumber, failed, "failed", "s", "smallest step at which a run failed");
};

/// Verdicts of a map's cells that change in runs ten times longer.
struct MapCheckRow {
  TABLE("stability-map-check");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, map, "map", "1", "parameter that varies over the rows of the map: stiffness or drag");
  COLUMN(long, steps, "steps", "1", "steps of each run of the map");
  COLUMN(long, cells, "cells", "1", "cells with a run");
  COLUMN(long, changed, "changed", "1", "cells that hold in only one of the two runs");
};

}  // namespace crosscheck
