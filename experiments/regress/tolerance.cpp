#include "experiments/regress/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/metrics.h"

namespace crosscheck {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

bool solves(const Method& method) { return method.implicit && method.family().in_process(); }

bool single(const Method& method, const CaseRun& case_run) {
  if (case_run.outcome.readback) return case_run.outcome.readback->precision == "single";
  return method.family().single_precision;
}

/// Rounds upwards to two digits.
double rounded_up(double tolerance) {
  if (!(tolerance > 0)) return 0;  // all values with this unit are exactly zero
  const double unit = std::pow(10, std::floor(std::log10(tolerance)) - 1);
  return std::ceil(tolerance / unit) * unit;
}

/// Gives all free particles a speed along one axis that displaces them by `size` within the run. Like rounding errors
/// that all particles share, it shifts the mean; displacements in independent directions would average out.
Scene pushed(Scene scene, double size, int axis) {
  for (int i = 0; i < scene.start.v.cols(); ++i)
    if (!scene.model.particles.pinned[i]) scene.start.v(axis, i) += size / run_over_window(scene).duration;
  return scene;
}

double motion_in(const CaseRun& case_run) {
  return case_run.trajectory.frames() > 0 ? motion_of(case_run.trajectory) : 0;
}

/// Residual (m) of one step's equation, expressed in positions. mysim's rules stop at 1e-12 of the inertial forces, or
/// where the rounding of positions hides changes of the spring forces. The lightest particle has the largest error.
double left_by_one_step(const Case& test_case, const CaseRun& case_run, double lengths) {
  const Model& model = test_case.scene.model;
  double stiffest = 0, lightest = INFINITY;
  if (const auto* springs = model.find<Springs>())
    for (const Spring& s : springs->list) stiffest = std::max(stiffest, s.k);
  for (int i = 0; i < model.particles.size(); ++i)
    if (!model.particles.pinned[i]) lightest = std::min(lightest, model.particles.mass[i]);
  const double h = case_run.outcome.step;
  return lengths * (1e-12 + 8 * eps * stiffest * h * h / lightest);
}

/// Error of a quantity, caused by the steps themselves: by solvers, and by sums over steps. With a damping rule, a
/// change of the start does not reveal this error: by the end the effect of the change has vanished, but the residual
/// of the last steps has not.
double left_by_steps(const Case& test_case, const CaseRun& case_run, const Rounding& rounding, const Quantity& q) {
  const Outcome& outcome = case_run.outcome;
  // this quantity sums impulses times distances over the steps; for a particle at rest on a sphere, all terms are
  // rounded in the same direction, so that the errors add up
  if (q.name == contact_quantity) return 8 * eps * static_cast<double>(outcome.steps) * q.size;
  if (q.unit == "m") return rounding.one_step * std::sqrt(static_cast<double>(outcome.steps));
  if (q.unit != "J" || !(outcome.step > 0)) return 0;
  const Particles& particles = test_case.scene.model.particles;
  double mass = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) mass += particles.mass[i];
  return rounding.one_step / outcome.step * std::sqrt(2 * mass * q.size);
}

}  // namespace

Rounding rounding_of(const Case& test_case, const CaseRun& case_run) {
  const double motion = motion_in(case_run), lengths = test_case.scene.size() + motion;
  if (single(test_case.method, case_run))
    return {*single_precision_bound(test_case.scene, motion, 1, case_run.outcome.steps), "single precision"};
  if (solves(test_case.method))
    return {1e-10 * std::max(1.0, lengths), "solver", left_by_one_step(test_case, case_run, lengths)};
  // round_off_bound() assumes ten thousand roundings, which accumulate like a random walk
  const double more = std::sqrt(std::max(1.0, static_cast<double>(case_run.outcome.evaluations) / 1e4));
  return {*round_off_bound(test_case.scene, motion, 1) * more, "double precision"};
}

std::vector<QuantityWithTolerance> with_tolerances(const Case& test_case) {
  const CaseRun whole = run_case(test_case), case_run = comparable_part(whole);
  const std::vector<Quantity> quantities = quantities_of(test_case, whole);
  std::vector<QuantityWithTolerance> all;
  const Rounding rounding = rounding_of(test_case, case_run);
  const double little = std::max(1e-10, rounding.size);  // m: far larger than the last digits of a number
  const auto moved_by = [&](double size, unsigned seed) {
    Case other = test_case;
    other.scene = pushed(perturbed(test_case.scene, size, seed), size, static_cast<int>(seed) - 1);
    // passes the original case, so that errors refer to its closed form even if the moved scene has none
    return quantities_of(test_case, run_case(other));
  };
  std::vector<std::vector<Quantity>> moved;
  for (const unsigned seed : {1u, 2u, 3u}) moved.push_back(moved_by(little, seed));
  const double less = 10 * rounding.size;
  const std::vector<Quantity> moved_less = less < little / 2 ? moved_by(less, 1) : std::vector<Quantity>{};
  std::map<std::string, double> scale;  // largest value by unit; bounds quantities that are zero except for rounding
  for (const Quantity& q : quantities)
    if (!q.count) scale[q.unit] = std::max(scale[q.unit], std::abs(q.value));
  const auto change_of = [&](const Quantity& q) {
    double change = 0;
    for (const auto& list : moved) {
      const Quantity* other = find(list, q.name);
      change = std::max(change, other ? std::abs(other->value - q.value) : scale[q.unit]);
    }
    return change;
  };
  const auto digits_of = [&](const Quantity& q) { return 64 * eps * std::max(scale[q.unit], q.size); };
  const auto grown = [&](const Quantity& q) { return change_of(q) > 1e3 * digits_of(q); };
  const auto saturated = [&](const Quantity& q) {
    const Quantity* other = find(moved_less, q.name);
    return other && !q.is_word() && !q.count && grown(q) && std::abs(other->value - q.value) > 0.1 * change_of(q);
  };
  // projections are not counted: if a scene starts at rest, they depend on the direction of the small displacement
  const bool chance = std::count_if(quantities.begin(), quantities.end(), [&](const Quantity& q) {
                        return !q.name.starts_with("places along") && saturated(q);
                      }) >= 3;
  for (const Quantity& q : quantities) {
    if (q.is_word() || q.count) {
      all.push_back({q, 0, q.is_word() ? "word" : "count"});
      continue;
    }
    const double change = change_of(q);
    if (q.name == time_of_failure) {
      // the change is not scaled: the growth that led to the failure may have begun as a rounding error, so that the
      // time of failure depends on the logarithm of this error
      all.push_back({q, rounded_up(change + q.error_bar),
                     fmt::format("start moved by {:.1e} m: {:.1e}; steps: {:.1e}", little, change, q.error_bar)});
      continue;
    }
    if (saturated(q) || (chance && grown(q))) {
      // quantities in s are times at which a threshold is crossed; such crossings may appear and disappear
      const bool elsewhere = chance && q.unit == "s" && change > 0.01 * scale[q.unit];
      const double within = elsewhere ? scale[q.unit] : (chance ? 10 : 3) * change;
      all.push_back({q, rounded_up(within + q.error_bar),
                     fmt::format("start moved by {:.1e} m: {:.1e}, beyond prediction", little, change)});
      continue;
    }
    const double left = left_by_steps(test_case, case_run, rounding, q);
    const double tolerance = change * rounding.size / little + digits_of(q) + left + q.error_bar;
    all.push_back({q, rounded_up(tolerance),
                   fmt::format("start moved by {:.1e} m: {:.1e}; rounding: {:.1e} m, {}{}{}", little, change,
                               rounding.size, rounding.kind, left > 0 ? fmt::format("; steps leave {:.1e}", left) : "",
                               q.error_bar > 0 ? fmt::format("; truth known to {:.1e}", q.error_bar) : "")});
  }
  return all;
}

}  // namespace crosscheck
