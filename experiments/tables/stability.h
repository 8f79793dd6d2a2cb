// The tables of experiment `stability`.
#pragma once

#include <cmath>

#include "experiments/tables/typed.h"

namespace crosscheck {

/// The state that a limit is one of: the scene's rest, or its start where it has none.
enum class LimitState { rest, start };
inline std::string_view name_of(LimitState state) { return state == LimitState::rest ? "rest" : "start"; }
template <>
inline constexpr std::pair range_of<LimitState>{LimitState::rest, LimitState::start};

enum class PredictionKind { limit, no_step, every_step, none };
inline std::string_view name_of(PredictionKind kind) {
  // in the order of the kinds
  constexpr std::string_view names[] = {"limit", "no stable step", "every step", "none"};
  return names[static_cast<int>(kind)];
}
template <>
inline constexpr std::pair range_of<PredictionKind>{PredictionKind::limit, PredictionKind::none};

/// What runs say of the largest step that holds.
struct MeasuredLimit {
  enum Kind { found, no_step, every_step, refused_above, unsupported } kind = found;
  double held = 0, failed = 0;  // s: the bracket; 0 where there is none
  std::string reason;           // of what was refused
  /// s, the bracket's geometric middle.
  double limit() const { return kind == found ? std::sqrt(held * failed) : 0; }
  /// The bracket's width over its lower end; 0 where there is none.
  double precision() const { return kind == found ? failed / held - 1 : 0; }
};

inline std::string_view name_of(MeasuredLimit::Kind kind) {
  // in the order of the kinds
  constexpr std::string_view names[] = {"limit", "no stable step", "every step tried", "held up to a refusal",
                                        "unsupported"};
  return names[kind];
}
template <>
inline constexpr std::pair range_of<MeasuredLimit::Kind>{MeasuredLimit::found, MeasuredLimit::unsupported};

/// Largest stable steps, measured and predicted.
struct LimitRow {
  TABLE("stability");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(LimitState, state, "state", "1", "state about which the limit is looked for");
  COLUMN(PredictionKind, prediction, "prediction", "1", "what linear theory says of steps");
  COLUMN(OptionalNumber, predicted, "predicted limit", "s", "critical time step by linear theory");
  COLUMN(OptionalNumber, omega, "binding omega", "rad/s", "angular frequency of the mode that binds it");
  COLUMN(OptionalNumber, gamma, "binding gamma", "1/s", "damping rate of that mode");
  COLUMN(MeasuredLimit::Kind, measurement, "measurement", "1", "what the runs say of steps");
  COLUMN(OptionalNumber, measured, "measured limit", "s", "geometric middle of held and failed");
  COLUMN(OptionalNumber, held, "held", "s", "largest step at which a run held");
  COLUMN(OptionalNumber, failed, "failed", "s", "smallest step at which a run failed");
  COLUMN(OptionalNumber, deviation, "deviation", "1", "measured over predicted limit, less 1");
  COLUMN(std::optional<Verdict>, above, "verdict above", "1", "how a run ends at 1.05 times the failed step");
  COLUMN(long, steps, "steps", "1", "steps of each run");
  COLUMN(std::string, reason, "reason", "1", "why measurement and prediction differ, or one is missing");
  COLUMN(OptionalNumber, precision, "precision", "1", "width of the bracket from held to failed, over held");
  COLUMN(OptionalNumber, step_below, "step below", "s",
         "largest step up to held that divides the time between samples, where a scene without rest has a truth");
  COLUMN(OptionalNumber, error_below, "error below", "m", "largest RMS position error at that step");
  COLUMN(OptionalNumber, step_above, "step above", "s", "the smallest such step from failed on");
  COLUMN(OptionalNumber, error_above, "error above", "m",
         "largest RMS position error at that step, up to where the run fails");
  COLUMN(OptionalNumber, motion, "motion", "m", "largest RMS distance of the truth from the start");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
};

/// One step of a run above its method's limit, from the scene's own start.
struct FailureRow {
  TABLE("stability-failure");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(double, h, "time step", "s", "time step of the run");
  COLUMN(double, limit, "measured limit", "s", "largest stable step, from table stability");
  COLUMN(OptionalNumber, growth, "growth by theory", "1", "factor of the energy of the fastest vibration in a step");
  COLUMN(long, step, "step", "1", "steps since the start");
  COLUMN(double, t, "t", "s", "time");
  COLUMN(double, kinetic, "kinetic energy", "J", "kinetic energy of the free particles");
  COLUMN(OptionalNumber, holding, "kinetic energy below", "J",
         "the same at a quarter of the time step, where the run holds");
  COLUMN(bool, still, "still", "1", "whether the report shows a picture of this moment");
};

/// Growth of one mode in each step.
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
  COLUMN(double, measured, "measured growth", "1", "mean factor of the amplitude in a step, less 1");
  COLUMN(double, deviation, "deviation", "1", "measured over predicted growth, less 1");
};

/// Cells of maps: one run in each.
struct MapRow {
  TABLE("stability-map");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, map, "map", "1", "what the rows of the map change: stiffness or drag");
  COLUMN(double, value, "value", "see map", "stiffness over the scene's own, or drag rate in 1/s");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(OptionalNumber, end, "end", "s", "simulated time reached");
  COLUMN(OptionalNumber, growth, "growth", "1", "growth of the kick over the run");
};

/// Largest stable steps on the rows of maps.
struct MapLimitRow {
  TABLE("stability-map-limit");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, map, "map", "1", "what the rows of the map change: stiffness or drag");
  COLUMN(double, value, "value", "see map", "stiffness over the scene's own, or drag rate in 1/s");
  COLUMN(OptionalNumber, predicted, "predicted limit", "s", "critical time step by linear theory");
  COLUMN(OptionalNumber, held, "held", "s", "largest step at which a run held");
  COLUMN(OptionalNumber, failed, "failed", "s", "smallest step at which a run failed");
};

/// Cells of maps that change in runs ten times longer.
struct MapCheckRow {
  TABLE("stability-map-check");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method");
  COLUMN(std::string, map, "map", "1", "what the rows of the map change: stiffness or drag");
  COLUMN(long, steps, "steps", "1", "steps of each run of the map");
  COLUMN(long, cells, "cells", "1", "cells with a run");
  COLUMN(long, changed, "changed", "1", "cells that hold in one of the two runs only");
};

}  // namespace crosscheck
