// The table of quantities, and how each is taken from a run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/metrics.h"
#include "experiments/regress/rows.h"

namespace crosscheck {
namespace {

/// Of the numbers whose differences quantities are: places, energies, and a spring's length over that at rest. Where
/// nothing moves, what is zero but for rounding is bounded by the energy of a motion through the scene in its window.
double size_of_unit(const std::string& unit, const Scene& scene, const Answered& answered) {
  double most = unit == "1" ? 1 : 0;
  if (unit == "m")
    for (const Points& x : answered.trajectory.x) most = std::max(most, x.cwiseAbs().maxCoeff());
  if (unit == "J" && !answered.ledger.empty()) {
    const double speed = scene.size() / scene.window;
    most = scene.model.particles.mass.sum() * speed * speed;
    for (const LedgerRow& row : answered.ledger)
      most = std::max({most, row.energy.kinetic, row.energy.elastic, std::abs(row.energy.gravitational)});
  }
  return most;
}

/// Counts that rounding cannot change: of rules at a fixed step, without an equation inside that is solved to a
/// tolerance.
void counts(const Seen& seen, Quantities& out) {
  const Stepper* rule = seen.question.method.stepper;
  if (!rule || rule->adaptive || rule->evaluations == 0) return;
  out.push_back({"steps", "1", static_cast<double>(seen.answered.outcome.steps), {}, true});
  out.push_back({"force evaluations", "1", static_cast<double>(seen.answered.outcome.evaluations), {}, true});
}

/// Largest RMS distance from the closed form, where the scene has one. What a converged truth says of a method is
/// said by its places already.
void error_against_truth(const Seen& seen, Quantities& out) {
  const Scene& scene = seen.scene();
  const auto truth = exact_truth(scene);
  if (!truth) return;
  out.push_back({error_quantity, "m", largest_rms_distance(seen.path(), truth->trajectory, scene.window)});
  out.back().bar = truth->bar;
}

/// What the engine says that it is set to. Six digits: single precision rounds what it is told.
void settings(const Seen& seen, Quantities& out) {
  if (!seen.answered.outcome.readback) return;
  const Readback& told = *seen.answered.outcome.readback;
  const auto add = [&out](const std::string& name, const std::string& word) {
    if (!word.empty()) out.push_back({setting_prefix + name, "word", 0, word});
  };
  add("precision", told.precision);
  if (told.may_sleep) add("sleeping", *told.may_sleep ? "on" : "off");
  if (told.margin) add("margin", fmt::format("{:.6g} m", *told.margin));
  for (const auto& [name, value] : told.settings) add(name, value);
}

constexpr void (*table[])(const Seen&, Quantities&) = {settings,
                                                       offsets,
                                                       places,
                                                       energies,
                                                       peak_stretch,
                                                       shape,
                                                       sag,
                                                       period,
                                                       settle_time,
                                                       counts,
                                                       leaving_angle,
                                                       smallest_clearance,
                                                       rebound_height,
                                                       error_against_truth,
                                                       order_of_error,
                                                       change_at_half_the_step,
                                                       largest_stable_step};

/// Of a run that failed: what it did before.
constexpr void (*table_of_failed[])(const Seen&, Quantities&) = {offsets, places};

/// Whether the motion itself failed, at a time that is the same in each run.
bool failed_in_time(Verdict verdict) {
  return verdict != Verdict::ok && verdict != Verdict::unsupported && verdict != Verdict::timeout &&
         verdict != Verdict::crash;
}

}  // namespace

std::vector<Quantity> quantities_of(const Question& question, const Answered& answered) {
  Quantities all{{"verdict", "word", 0, std::string(name_of(answered.outcome.verdict))}};
  const auto size = [&question](Quantities& list, const Answered& by) {
    for (Quantity& q : list)
      if (!q.count && !q.is_word()) q.size = size_of_unit(q.unit, question.scene, by);
  };
  if (answered.outcome.verdict == Verdict::ok) {
    for (const auto add : table) add({question, answered}, all);
    size(all, answered);
  } else if (failed_in_time(answered.outcome.verdict)) {
    const Answered half = as_compared(answered);
    settings({question, half}, all);
    if (half.trajectory.frames() > 1)
      for (const auto add : table_of_failed) add({question, half}, all);
    size(all, half);
    all.push_back({time_of_failure, "s", answered.outcome.end});
    // a threshold may be passed at the next sample, where failures are looked for, or a step later
    const Run run = run_over_window(question.scene);
    all.back().bar = run.duration / run.samples + 2 * answered.outcome.step;
  }
  return all;
}

}  // namespace crosscheck
