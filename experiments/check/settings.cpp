// Relations between runs of one scene: with other steps, with more iterations, in two parts, or repeated.
#include <fmt/format.h>

#include <cmath>

#include "experiments/check/compare.h"
#include "experiments/check/transformations.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

/// Throws CannotBeAsked if the method chooses its steps, and RunFailed if it ignores the requested step.
void require_own_step(const Method& method) {
  if (chooses_steps(method)) throw CannotBeAsked("it chooses its own steps");
  if (method.identify && method.identify().kind == FoundRule::ignores_step)
    throw RunFailed(
        "the requested step has no effect; an engine that chooses its own steps must say \"adaptive\" in run.json", 0,
        Verdict::ok);
}

/// Requires `fine` to be at most the fraction `part` of `coarse`, plus twice the noise. Compares only while `coarse` is
/// at most a hundredth of the scene's lengths: beyond that, the phase error of a vibration hides any power of the step.
RelationResult shrinking(std::string what, const Scene& scene, const Trajectory& path,
                         const std::vector<double>& coarse, const std::vector<double>& fine, double part,
                         const std::vector<double>& noise) {
  const double most = 0.01 * lengths_in(scene, path);
  if (!(noise[1] <= most))
    throw CannotBeAsked(
        fmt::format("at the finest step rounding alone may grow to {:.2g} m before the first sample", noise[1]));
  if (coarse[1] > most)
    throw CannotBeAsked(
        fmt::format("the first halving of the step changes {:.2g} m before the first sample", coarse[1]));
  RelationResult worst{std::move(what), "m", 0, 2 * noise[0]};
  std::optional<double> since;
  for (int i = 1; i < path.frames() && coarse[i] <= most; ++i) {
    const RelationResult here{worst.what, "m", fine[i], part * coarse[i] + 2 * noise[i]};
    if (!here.holds() && !since) since = path.t[i];
    if (here.ratio() > worst.ratio()) worst = here;
  }
  worst.since = since;
  return worst;
}

}  // namespace

const Trajectory& halved(Subject& subject, const Scene& scene, int times) {
  Run run = run_for_relations(scene);
  run.step = std::ldexp(run.step, -times);
  return subject.run(scene, run).path;
}

std::vector<double> noise_at(Subject& subject, Scene scene, int times) {
  scene.step = std::ldexp(scene.step, -times);
  return subject.noise_with_unsolved(scene).x;
}

RelationResult half_the_step(Subject& subject, const Scene& scene, unsigned) {
  require_own_step(subject.method());
  const Trajectory& one = halved(subject, scene, 0);
  const int order = order_of(subject.method());
  // if the error is C h^p, the second difference is 2^-p times the first; the allowance of half a power covers terms of
  // higher order
  const auto difference = [&](int times) {
    return distances(halved(subject, scene, times), halved(subject, scene, times + 1));
  };
  const std::string allowed = fmt::format("order {} allows 2^-{} times that between", order, order - 0.5);
  RelationResult found =
      shrinking(fmt::format("difference between steps of h/2 and h/4; {} h and h/2", allowed), scene, one,
                difference(0), difference(1), std::exp2(0.5 - order), noise_at(subject, scene, 2));
  if (found.holds()) return found;
  // terms of higher order may cancel the first difference at one step, but not also at the next one
  RelationResult finer =
      shrinking(fmt::format("difference between steps of h/4 and h/8; {} h/2 and h/4", allowed), scene, one,
                difference(1), difference(2), std::exp2(0.5 - order), noise_at(subject, scene, 3));
  return finer.ratio() < found.ratio() ? finer : found;
}

RelationResult one_answer(Subject& subject, const Scene& scene, unsigned) {
  require_own_step(subject.method());
  const auto noise = noise_at(subject, scene, 3);
  const Trajectory &one = halved(subject, scene, 0), &two = halved(subject, scene, 1),
                   &four = halved(subject, scene, 2), &eight = halved(subject, scene, 3);
  // at order one, two halvings of the step reduce the difference to a quarter; if it falls below half, the results have
  // a limit
  RelationResult found = shrinking("difference between steps of h/4 and h/8; allowed: half of that between h and h/2",
                                   scene, one, distances(one, two), distances(four, eight), 0.5, noise);
  if (!found.holds()) {  // gives a finer step a chance, as half_the_step() does
    RelationResult finer =
        shrinking("difference between steps of h/8 and h/16; allowed: half of that between h/2 and h/4", scene, one,
                  distances(two, four), distances(eight, halved(subject, scene, 4)), 0.5, noise_at(subject, scene, 4));
    if (finer.ratio() < found.ratio()) found = std::move(finer);
  }
  const auto more = subject.with_iterations(2);
  if (!more) return found;
  // results with n and with 2n iterations have a common limit if their difference shrinks with the step
  Subject other(*more);
  return worse(found, shrinking("difference between n and 2n iterations at h/2; allowed: 0.71 times that at h", scene,
                                one, distances(one, halved(other, scene, 0)), distances(two, halved(other, scene, 1)),
                                std::sqrt(0.5), noise));
}

RelationResult stop_and_go_on(Subject& subject, const Scene& scene, unsigned) {
  const Run run = run_for_relations(scene);
  const Trajectory& whole = subject.run(scene, run).path;
  const int middle = run.samples / 2;
  if (middle < 1) throw CannotBeAsked("the scene has no sample between its start and its end");
  if (whole.v[middle].cols() != scene.start.v.cols())
    throw CannotBeAsked("it reports no velocities, without which it cannot be resumed");
  // a run that is at rest up to rounding does not show whether it continues correctly
  double moved = 0;
  for (int i = middle; i <= run.samples; ++i) moved = std::max(moved, largest_column(whole.x[i] - whole.x[middle]));
  if (moved <= 2 * subject.noise(scene).start) throw CannotBeAsked("it comes to rest in the first half of the run");
  Scene later = scene;
  later.start.x = whole.x[middle], later.start.v = whole.v[middle];
  later.duration = scene.duration * (run.samples - middle) / run.samples, later.samples = run.samples - middle;
  const Trajectory& rest = subject.run(later).path;
  Trajectory second_half;
  for (int i = middle; i <= run.samples; ++i) {
    second_half.t.push_back(whole.t[i]);
    second_half.x.push_back(whole.x[i]);
  }
  // a rule whose state contains more than positions and velocities must restart, which causes an error of its order
  std::vector<double> bound = subject.noise(scene).x;
  if (!chooses_steps(subject.method())) bound = sum_of(std::move(bound), distances(whole, halved(subject, scene, 1)));
  bound.erase(bound.begin(), bound.begin() + middle);
  return farthest("distance between the second half and a run from the middle", second_half, rest, bound,
                  lengths_in(scene, whole));
}

RelationResult same_call_twice(Subject& subject, const Scene& scene, unsigned seed) {
  const Run run = run_for_relations(scene);
  const Trajectory first = subject.fresh_run(scene, run).path;
  // a different call in between, which must not affect the next one
  const Scene other = placed(scene, {Eigen::Matrix3d::Identity(), 0.01 * scene.size() * seeded_turn(seed).col(0)});
  subject.fresh_run(other, run);
  const Trajectory second = subject.fresh_run(scene, run).path;
  RelationResult found{"two calls with the same arguments, bit for bit", "m", 0, 0};
  for (int i = 0; i < first.frames(); ++i) {
    if (first.x[i] == second.x[i] && first.v[i] == second.v[i]) continue;
    if (!found.since) found.since = first.t[i];
    found.measured = std::max({found.measured, largest_column(first.x[i] - second.x[i]), 0x1p-1074});
  }
  return found;
}

}  // namespace crosscheck
