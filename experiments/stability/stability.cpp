// Experiment `stability`: the largest stable step of every method on every scene, measured and predicted; growth rates
// for rules without a stable step; and maps of verdicts.
#include "experiments/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/estimate.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/stability/map.h"
#include "experiments/stability/margin.h"
#include "experiments/tables/stability.h"
#include "mysim/model/energy.h"
#include "mysim/run/observers.h"

namespace crosscheck {
namespace {

PredictionKind kind_of(const PredictedLimit& p) {
  if (!p.missing.empty()) return PredictionKind::none;
  return p.limit == 0          ? PredictionKind::no_step
         : std::isinf(p.limit) ? PredictionKind::every_step
                               : PredictionKind::limit;
}

/// Adds the growth per step of the mode that determines the limit. Uses steps around the limit or, if no step is
/// stable, a few short steps, at which a run until its blow-up would take millions of steps.
void add_growth(const Method& method, const Stepper& rule, const BaseState& base, const PredictedLimit& predicted,
                TableSet& tables) {
  const Spectrum& s = base.spectrum;
  if (!base.at_rest || !s.commuting || s.modes.empty() || !is_runge_kutta(rule)) return;
  const int mode = predicted.mode >= 0 ? predicted.mode : static_cast<int>(s.modes.size()) - 1;
  const Vibration& vibration = s.modes[mode];
  Table table = table_of<GrowthRow>();
  std::vector<double> steps;
  for (const double z : {0.1, 0.2, 0.5})
    if (predicted.limit == 0) steps.push_back(z / vibration.omega);
  for (const double part : {0.9, 0.98, 1.02, 1.1})
    if (predicted.limit > 0) steps.push_back(part * predicted.limit);
  for (const double h : steps) {
    const double expected = growth_per_step(rule, vibration, h);
    if (expected == 1) continue;
    // enough steps to change the amplitude tenfold, and to average over rounding errors, at a moderate cost
    const long count = std::clamp(std::lround(2.3 / std::abs(std::log(expected))), 100L, 2000L);
    const PerturbedRun trial = run_perturbed(method, base, h, count, {mode});
    if (!trial.of_mode) continue;
    GrowthRow row{.scene = base.scene.name,
                  .method = method.name,
                  .omega = vibration.omega,
                  .gamma = vibration.gamma,
                  .step = h,
                  .h_omega = h * vibration.omega,
                  .predicted = expected - 1,
                  .measured = trial.per_step - 1,
                  .deviation = (trial.per_step - 1) / (expected - 1) - 1};
    if (predicted.limit > 0) row.share_of_limit = h / predicted.limit;
    add(table, row);
  }
  tables.add(table);
}

/// True for the cheapest second-order rule, which the report recommends when stability limits the step.
bool shows_failure(const Method& method) {
  return method.family().is_subject() && method.stepper &&
         method.name == fmt::format("{}/{}", subject().name, method.stepper->name) && method.stepper->order == 2 &&
         method.stepper->evaluations == 1 && method.stepper->symplectic;
}

/// Samples of a run at intervals h, each of which has `per_sample` steps. The run may fail early.
Trajectory steps_of(const Method& method, const Scene& scene, double h, int per_sample, int samples) {
  Recorder recorder;
  Run run{h / per_sample, h * samples, samples};
  run.timed = false;
  run_method(method, scene, run, {&recorder});
  return std::move(recorder.trajectory);
}

}  // namespace

void add_failure(const Scene& scene, const Method& method, double limit, std::optional<double> growth,
                 TableSet& tables) {
  constexpr int most = 400, shown = 16;
  const double h = failing_step(limit);
  const Trajectory run = steps_of(method, scene, h, 1, most);
  if (run.frames() > most) return;  // the run from the scene's own start does not fail
  const Trajectory holds = steps_of(method, scene, h, 4, run.frames() - 1);
  // Pictures show the last frame in which no particle is farther from the stable run than half the scene's size, and
  // some frames before it.
  const auto strayed = [&](int i) {
    return i >= holds.frames() || !run.x[i].allFinite() || largest_column(run.x[i] - holds.x[i]) > 0.5 * scene.size();
  };
  int last = 0;
  while (last + 1 < run.frames() && !strayed(last + 1)) ++last;
  const auto kinetic = [&](const Trajectory& of, int i) {
    return energy_of(scene.model, State{of.t[i], of.x[i], of.v[i]}).kinetic;
  };
  Table table = table_of<FailureRow>();
  for (int i = std::max(1, std::min(last - 4, run.frames() - shown)); i < run.frames(); ++i) {
    FailureRow row{.scene = scene.name,
                   .method = method.name,
                   .h = h,
                   .limit = limit,
                   .growth = growth,
                   .step = i,
                   .t = run.t[i],
                   .kinetic = kinetic(run, i),
                   .still = i == last - 4 || i == last - 2 || i == last - 1 || i == last};
    if (!std::isfinite(row.kinetic)) break;
    if (i < holds.frames()) row.holding = kinetic(holds, i);
    add(table, row);
  }
  tables.add(table);
}

namespace {

std::string why_not(const Method& method) {
  if (method.family().role == Role::truth) return "a reference solution takes no steps";
  if (method.adaptive) return "its steps follow a tolerance";
  if (method.sticky_contact) return "its contact rule does not change the limit";
  return "";
}

/// True for large scenes with methods whose rule is unknown or implicit (stable at every step).
bool is_dear(const Method& method, const Scene& scene) {
  const Stepper* rule = stepper_of(method);
  return !is_small(scene) && (!rule || std::isinf(rule->limit(1, 0)));
}

bool same_stability_class(const Stepper& a, const Stepper& b) {
  return a.symplectic == b.symplectic && (a.limit(1, 0) > 0) == (b.limit(1, 0) > 0);
}

bool has_linear_limit(const Stepper& rule) { return std::isfinite(rule.limit(1, 0)); }

/// For scenes without a state of rest: errors at the nearest steps that divide the sampling interval show whether a run
/// follows the true motion below a limit and loses it above.
void add_errors_beside_limit(const Scene& scene, const Method& method, LimitRow& row) {
  const Run whole = default_run(scene);
  const auto truth = truth_of(scene, whole);
  if (!truth || truth->under_contact_rule) return;
  const Trajectory& known = truth->trajectory;
  const double interval = whole.duration / whole.samples;
  int last = 0;
  while (last + 1 < known.frames() && known.t[last + 1] <= scene.window * (1 + 1e-9)) ++last;
  const auto error_with = [&](int steps_per_sample) {
    Recorder recorder;
    Run run{interval / steps_per_sample, interval * last, last * steps_per_sample};
    run.timed = false;
    run_method(method, scene, run, {&recorder});
    const auto& x = recorder.trajectory.x;
    double error = 0;
    for (size_t i = 0; i < x.size(); ++i) {
      const size_t sample = i / steps_per_sample;
      const double part = static_cast<double>(i % steps_per_sample) / steps_per_sample;
      // a failed run may end between samples; linear interpolation of the truth is then accurate enough
      if (part == 0)
        error = std::max(error, rms_distance(x[i], known.x[sample]));
      else if (i + 1 == x.size())
        error = std::max(error, rms_distance(x[i], (1 - part) * known.x[sample] + part * known.x[sample + 1]));
    }
    return error;
  };
  row.motion = motion_of(known), row.truth_bar = truth->error_bar;
  const int below = static_cast<int>(std::ceil(interval / *row.held * (1 - 1e-9))),
            above = static_cast<int>(std::floor(interval / *row.failed * (1 + 1e-9)));
  row.step_below = interval / below, row.error_below = error_with(below);
  if (above > 0) row.step_above = interval / above, row.error_above = error_with(above);
}

}  // namespace

bool is_mapped(const Method& method) {
  if (!method.family().is_subject()) return method.family().by_default();
  const Stepper& rule = *method.stepper;
  if (!has_linear_limit(rule)) return false;
  const auto first = std::ranges::find_if(
      steppers(), [&](const Stepper& s) { return has_linear_limit(s) && same_stability_class(s, rule); });
  return first->name == rule.name && method.name == fmt::format("{}/{}", subject().name, rule.name);
}

Effort effort_for(const Method& method, const Scene& scene, bool full) {
  const Effort least = is_dear(method, scene)              ? Effort{100, 0.5}  // shows only whether a step fails
                       : method.stepper || is_small(scene) ? Effort{4000, 0.002}
                                                           : Effort{1000, 0.01};
  if (!full) return least;
  // the 25 or so runs of a bisection may take 0.5 s in total
  const long steps = std::lround(0.5 / 25 / estimated_seconds(method, scene, 1));
  if (steps <= least.steps) return least;
  return {std::min(20000L, steps), std::min(least.precision, steps < 4000 ? 0.005 : 0.001)};
}

void add_limit(const Scene& scene, const Method& method, const Effort& effort, TableSet& tables) {
  Table table = table_of<LimitRow>();
  const BaseState base = base_state_of(scene);
  const PredictedLimit predicted = predicted_limit(method, base.spectrum);
  const bool finite = predicted.missing.empty() && std::isfinite(predicted.limit);
  const Perturbation perturbation{predicted.mode};
  const MeasuredLimit measured = measured_limit(method, base, effort.steps, perturbation, effort.precision);
  std::string reason = reason_for(base, method, predicted, measured);
  for (const std::string& more : {measured.reason, saddle_note(base)})
    if (!more.empty()) reason += (reason.empty() ? "" : "; ") + more;
  LimitRow row{.scene = scene.name,
               .method = method.name,
               .state = base.at_rest ? LimitState::rest : LimitState::start,
               .prediction = kind_of(predicted),
               .measurement = measured.kind,
               .steps = effort.steps,
               .reason = reason};
  if (finite) row.predicted = predicted.limit;
  if (measured.held > 0) row.held = measured.held;
  if (measured.failed > 0) row.failed = measured.failed;
  if (measured.kind == MeasuredLimit::found) {
    row.measured = measured.limit(), row.precision = measured.precision();
    if (finite && predicted.limit > 0) row.deviation = measured.limit() / predicted.limit - 1;
    // perturbs by more than the search does, so that the way of failing shows within the run
    row.above = run_perturbed(method, base, 1.05 * measured.failed, effort.steps, {perturbation.mode, 1e-3})
                    .effective_verdict();
    if (!base.at_rest) add_errors_beside_limit(scene, method, row);
  }
  if (predicted.mode >= 0 && finite) {
    const Vibration& binding = base.spectrum.modes[predicted.mode];
    row.omega = binding.omega, row.gamma = binding.gamma;
  }
  add(table, row);
  tables.add(table);
  if (measured.kind == MeasuredLimit::found && shows_failure(method)) {
    std::optional<double> growth;
    if (row.omega)
      growth = std::pow(growth_per_step(*method.stepper, {*row.omega, *row.gamma}, failing_step(measured.limit())), 2);
    add_failure(scene, method, measured.limit(), growth, tables);
  }
  if (const Stepper* rule = stepper_of(method); rule && measured.kind != MeasuredLimit::unsupported)
    add_growth(method, *rule, base, predicted, tables);
}

std::vector<Point> stability_points(const Request& request) {
  std::vector<Point> points;
  // in a quick run, the cloth's maps represent those of scenes with one or two vibrations
  const bool all_maps = request.full || request.scenes_only || !request.methods.empty();
  for (const Scene& scene : request.scenes) {
    const auto small = all_maps || !scene.triangles.empty() ? map_scene(scene, request.full) : std::nullopt;
    for (const Method& method : methods_of(request, scene)) {
      const std::string name = fmt::format("{} on {}", method.name, scene.name);
      if (const std::string why = why_not(method); !why.empty()) {
        points.push_back({"stability: " + name, "", [=](TableSet& tables) {
                            tables.notes.push_back(fmt::format("stability leaves out {}: {}", method.name, why));
                          }});
        continue;
      }
      Request alone = request;
      alone.methods = {method};
      if (request.methods.empty() && !request.full && is_dear(method, scene)) {
        points.push_back(
            {"stability: " + name, "", [name](TableSet& tables) {
               tables.notes.push_back(fmt::format(
                   "stability leaves out {}: no linear limit, and its runs are slow; --full includes it", name));
             }});
      } else {
        points.push_back({"stability: " + name, content_of(alone, scene), [=, full = request.full](TableSet& tables) {
                            add_limit(scene, method, effort_for(method, scene, full), tables);
                          }});
      }
      const bool all = !request.methods.empty() || request.full;
      if (!small || !(all || is_mapped(method)) || scene.model.first_order()) continue;
      const auto size = map_size(method, *small, request.full);
      if (!size) {
        points.push_back({"stability: maps, " + name, "", [name](TableSet& tables) {
                            tables.notes.push_back(
                                fmt::format("stability draws no map of {}: its runs are slow", name));
                          }});
        continue;
      }
      const std::string content = content_of(alone, *small);
      for (const MapKind& kind : map_kinds())
        points.push_back({fmt::format("stability: map of step and {}, {}", kind.name, name), content,
                          [=, &kind, on_runs = request.on_runs](TableSet& tables) {
                            add_map(kind, *small, method, *size, tables, on_runs);
                          }});
    }
    if (!small && scene.model.find<Springs>())
      points.push_back({"stability: maps of " + scene.name, "",
                        [name = scene.name, dear = all_maps || !scene.triangles.empty()](TableSet& tables) {
                          tables.notes.push_back(
                              fmt::format("stability draws no map of {}: {}; --full includes them", name,
                                          dear ? "hundreds of runs take too long" : "the cloth's maps represent it"));
                        }});
  }
  return points;
}

}  // namespace crosscheck
