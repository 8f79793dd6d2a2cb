// The tables of experiment `stability`.
#pragma once

#include <cmath>

#include "experiments/tables/typed.h"

namespace crosscheck {

/// The state that a limit is one of: the scene's rest, or its start where it has none.
enum class LimitState { rest, start };
inline std::string_view name_of(LimitState state) { return state == LimitState::rest ? "rest" : "start"; }
template <>
struct EnumRange<LimitState> {
  static constexpr LimitState first = LimitState::rest, last = LimitState::start;
};

enum class PredictionKind { limit, no_step, every_step, none };
inline std::string_view name_of(PredictionKind kind) {
  // in the order of the kinds
  constexpr std::string_view names[] = {"limit", "no stable step", "every step", "none"};
  return names[static_cast<int>(kind)];
}
template <>
struct EnumRange<PredictionKind> {
  static constexpr PredictionKind first = PredictionKind::limit, last = PredictionKind::none;
};

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
struct EnumRange<MeasuredLimit::Kind> {
  static constexpr MeasuredLimit::Kind first = MeasuredLimit::found, last = MeasuredLimit::unsupported;
};

struct LimitRow {
  std::string scene, method;
  LimitState state = LimitState::rest;
  PredictionKind prediction = PredictionKind::limit;
  std::optional<double> predicted, omega, gamma;
  MeasuredLimit::Kind measurement = MeasuredLimit::found;
  std::optional<double> measured, held, failed, deviation;
  std::optional<Verdict> above;
  long steps = 0;
  std::string reason;
  std::optional<double> precision;
  // against the truth of a scene without rest
  std::optional<double> step_below = {}, error_below = {}, step_above = {}, error_above = {}, motion = {},
                        truth_bar = {};

  static constexpr std::string_view table = "stability", about = "Largest stable steps, measured and predicted.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &LimitRow::scene, "scene"), column("method", "1", &LimitRow::method, "method"),
        column("state", "1", &LimitRow::state, "state about which the limit is looked for"),
        column("prediction", "1", &LimitRow::prediction, "what linear theory says of steps"),
        column("predicted limit", "s", &LimitRow::predicted, "critical time step by linear theory"),
        column("binding omega", "rad/s", &LimitRow::omega, "angular frequency of the mode that binds it"),
        column("binding gamma", "1/s", &LimitRow::gamma, "damping rate of that mode"),
        column("measurement", "1", &LimitRow::measurement, "what the runs say of steps"),
        column("measured limit", "s", &LimitRow::measured, "geometric middle of held and failed"),
        column("held", "s", &LimitRow::held, "largest step at which a run held"),
        column("failed", "s", &LimitRow::failed, "smallest step at which a run failed"),
        column("deviation", "1", &LimitRow::deviation, "measured over predicted limit, less 1"),
        column("verdict above", "1", &LimitRow::above, "how a run ends at 1.05 times the failed step"),
        column("steps", "1", &LimitRow::steps, "steps of each run"),
        column("reason", "1", &LimitRow::reason, "why measurement and prediction differ, or one is missing"),
        column("precision", "1", &LimitRow::precision, "width of the bracket from held to failed, over held"),
        column("step below", "s", &LimitRow::step_below,
               "largest step up to held that divides the time between samples, where a scene without rest has a truth"),
        column("error below", "m", &LimitRow::error_below, "largest RMS position error at that step"),
        column("step above", "s", &LimitRow::step_above, "the smallest such step from failed on"),
        column("error above", "m", &LimitRow::error_above,
               "largest RMS position error at that step, up to where the run fails"),
        column("motion", "m", &LimitRow::motion, "largest RMS distance of the truth from the start"),
        column("truth bar", "m", &LimitRow::truth_bar, "error bar of the truth");
  };
};

/// One step of a run above its method's limit, from the scene's own start.
struct FailureRow {
  std::string scene, method;
  double h = 0, limit = 0;
  std::optional<double> growth;
  long step = 0;
  double t = 0, kinetic = 0;
  std::optional<double> holding;
  bool still = false;

  static constexpr std::string_view table = "stability-failure", about = "The last steps of a run above its limit.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &FailureRow::scene, "scene"), column("method", "1", &FailureRow::method, "method"),
        column("time step", "s", &FailureRow::h, "time step of the run"),
        column("measured limit", "s", &FailureRow::limit, "largest stable step, from table stability"),
        column("growth by theory", "1", &FailureRow::growth, "factor of the energy of the fastest vibration in a step"),
        column("step", "1", &FailureRow::step, "steps since the start"), column("t", "s", &FailureRow::t, "time"),
        column("kinetic energy", "J", &FailureRow::kinetic, "kinetic energy of the free particles"),
        column("kinetic energy below", "J", &FailureRow::holding,
               "the same at a quarter of the time step, where the run holds"),
        column("still", "1", &FailureRow::still, "whether the report shows a picture of this moment");
  };
};

struct GrowthRow {
  std::string scene, method;
  double omega = 0, gamma = 0, step = 0, h_omega = 0;
  std::optional<double> share_of_limit;
  double predicted = 0, measured = 0, deviation = 0;

  static constexpr std::string_view table = "stability-growth", about = "Growth of one mode in each step.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &GrowthRow::scene, "scene"), column("method", "1", &GrowthRow::method, "method"),
        column("omega", "rad/s", &GrowthRow::omega, "angular frequency of the mode"),
        column("gamma", "1/s", &GrowthRow::gamma, "damping rate of the mode"),
        column("step", "s", &GrowthRow::step, "time step"),
        column("h omega", "1", &GrowthRow::h_omega, "time step times angular frequency"),
        column("share of limit", "1", &GrowthRow::share_of_limit, "time step over the predicted limit"),
        column("predicted growth", "1", &GrowthRow::predicted, "spectral radius of a step by theory, less 1"),
        column("measured growth", "1", &GrowthRow::measured, "mean factor of the amplitude in a step, less 1"),
        column("deviation", "1", &GrowthRow::deviation, "measured over predicted growth, less 1");
  };
};

struct MapRow {
  std::string scene, method, map;
  double value = 0, step = 0;
  Verdict verdict = Verdict::ok;
  std::optional<double> end, growth;

  static constexpr std::string_view table = "stability-map", about = "Cells of maps: one run in each.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &MapRow::scene, "scene"), column("method", "1", &MapRow::method, "method"),
        column("map", "1", &MapRow::map, "what the rows of the map change: stiffness or drag"),
        column("value", "see map", &MapRow::value, "stiffness over the scene's own, or drag rate in 1/s"),
        column("step", "s", &MapRow::step, "time step"), column("verdict", "1", &MapRow::verdict, "how the run ended"),
        column("end", "s", &MapRow::end, "simulated time reached"),
        column("growth", "1", &MapRow::growth, "growth of the kick over the run");
  };
};

struct MapLimitRow {
  std::string scene, method, map;
  double value = 0;
  std::optional<double> predicted, held, failed;

  static constexpr std::string_view table = "stability-map-limit", about = "Largest stable steps on the rows of maps.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &MapLimitRow::scene, "scene"), column("method", "1", &MapLimitRow::method, "method"),
        column("map", "1", &MapLimitRow::map, "what the rows of the map change: stiffness or drag"),
        column("value", "see map", &MapLimitRow::value, "stiffness over the scene's own, or drag rate in 1/s"),
        column("predicted limit", "s", &MapLimitRow::predicted, "critical time step by linear theory"),
        column("held", "s", &MapLimitRow::held, "largest step at which a run held"),
        column("failed", "s", &MapLimitRow::failed, "smallest step at which a run failed");
  };
};

struct MapCheckRow {
  std::string scene, method, map;
  long steps = 0, cells = 0, changed = 0;

  static constexpr std::string_view table = "stability-map-check",
                                    about = "Cells of maps that change in runs ten times longer.";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &MapCheckRow::scene, "scene"), column("method", "1", &MapCheckRow::method, "method"),
        column("map", "1", &MapCheckRow::map, "what the rows of the map change: stiffness or drag"),
        column("steps", "1", &MapCheckRow::steps, "steps of each run of the map"),
        column("cells", "1", &MapCheckRow::cells, "cells with a run"),
        column("changed", "1", &MapCheckRow::changed, "cells that hold in one of the two runs only");
  };
};

}  // namespace crosscheck
