// Relations of mechanics: free fall, momentum, energy, pins, equilibrium.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/check/compare.h"
#include "experiments/metrics.h"
#include "mysim/model/energy.h"

namespace crosscheck {
namespace {

/// Compares a value (in `unit`) with its bound at each sample.
RelationResult over_time(std::string what, std::string unit, const Trajectory& path, const std::vector<double>& bound,
                         const std::function<double(int)>& value) {
  RelationResult worst{std::move(what), std::move(unit), 0, bound[0]};
  std::optional<double> since;
  for (int i = 0; i < path.frames(); ++i) {
    const RelationResult here{worst.what, worst.unit, value(i), bound[i]};
    if (!here.holds() && !since) since = path.t[i];
    if (here.ratio() > worst.ratio()) worst = here;
  }
  worst.since = since;
  return worst;
}

void require_velocities(const Trajectory& path) {
  if (path.v.back().cols() != path.x.back().cols()) throw CannotBeAsked("it reports no velocities");
}

Vec3 start_velocity_of_the_centre(const Scene& scene) { return centre_of_mass(scene, scene.start.v); }

/// Final positions in a damped run, and the largest movement (m) in its last quarter.
struct Rest {
  Points x;
  double unsettled;
};
Rest at_rest(Subject& subject, const Scene& scene) {
  const SubjectRun& run = subject.run(scene);
  if (run.path.frames() < 9) throw CannotBeAsked("the scene has fewer than eight samples");
  Rest rest{run.path.x.back(), 0};
  for (int i = run.path.frames() * 3 / 4; i < run.path.frames(); ++i)
    rest.unsettled = std::max(rest.unsettled, largest_column(run.path.x[i] - rest.x));
  if (rest.unsettled > 1e-3 * scene.size())
    throw CannotBeAsked(
        fmt::format("it has not come to rest: in the last quarter it moved by {:.2g} m", rest.unsettled));
  // damping removes the velocities that rounding causes, so that only the rounding of positions accumulates
  const double steps = static_cast<double>(std::max(1L, run.outcome.steps));
  rest.unsettled += 10 * subject.unit_roundoff() * std::sqrt(steps) * lengths_in(scene, run.path);
  if (chooses_steps(subject.method())) rest.unsettled += subject.noise(scene).start;
  return rest;
}

double extension_of(const Spring& spring, const Points& x) {
  return (x.col(spring.a) - x.col(spring.b)).norm() - spring.rest;
}

}  // namespace

RelationResult free_fall(Subject& subject, const Scene& scene, unsigned) {
  const SubjectRun& run = subject.run(scene);
  const Trajectory& path = run.path;
  const std::vector<double> noise = subject.noise_with_unsolved(scene).x;
  const Points& start = scene.start.x;
  const Vec3 from = centre_of_mass(scene, start), v = start_velocity_of_the_centre(scene),
             g = scene.model.find<Gravity>()->acceleration;
  const auto fallen = [&](int i) { return Vec3(centre_of_mass(scene, path.x[i]) - from); };
  RelationResult relative = over_time("motion of a particle relative to the others", "m", path, noise, [&](int i) {
    return largest_column(((path.x[i] - start).colwise() - fallen(i)).eval());
  });
  // with a rule of order two, a particle falls by exactly g t^2 / 2; with a rule of order one, by g t (t + h) / 2 or g
  // t (t - h) / 2; with any other rule, by a distance in between
  const Method& method = subject.method();
  const bool known = stepper_of(method) != nullptr;
  const double h = chooses_steps(method) || (known && order_of(method) > 1) ? 0 : run.outcome.step;
  // the fall is g t^2 / 2 + g h (a t + b h) / 2. A known rule of order one has a = 1 or -1, and b = 0. For other rules
  // a and b, both between -1 and 1, are taken from the first and last sample, so that the rounding errors of these two
  // samples add to those of the others
  const int last = path.frames() - 1;
  const auto late = [&](int i) {  // in units of g h / 2
    const Vec3 off = fallen(i) - v * path.t[i] - g * (path.t[i] * path.t[i] / 2);
    return h > 0 && g.squaredNorm() > 0 ? off.dot(g) / g.squaredNorm() * 2 / h : 0;
  };
  const double at_first = last > 0 ? path.t[1] : 0, at_last = path.t[last];
  double a = last > 1 ? (late(last) - late(1)) / (at_last - at_first) : last > 0 ? late(last) / at_last : 0;
  double b = last > 1 && h > 0 ? (late(1) - a * at_first) / h : 0;
  if (known) a = a < 0 ? -1 : 1, b = 0;
  a = std::clamp(a, -1.0, 1.0), b = std::clamp(b, -1.0, 1.0);
  std::vector<double> bound = noise;
  if (!known && h > 0)
    for (double& each : bound) each += noise.back();
  RelationResult centre =
      over_time(h == 0 ? "the centre of mass against g t^2 / 2" : "the centre of mass against g t (t +- h) / 2", "m",
                path, bound, [&](int i) {
                  const double t = path.t[i];
                  return (fallen(i) - v * t - g * (t * t + (i > 0 ? h * (a * t + b * h) : 0)) / 2).norm();
                });
  return worse(std::move(relative), std::move(centre));
}

RelationResult no_force_no_motion(Subject& subject, const Scene& scene, unsigned) {
  const Trajectory& path = subject.run(scene).path;
  return over_time("motion of a net on which nothing acts", "m", path, subject.noise(scene).x,
                   [&](int i) { return largest_column(path.x[i] - scene.start.x); });
}

RelationResult momentum_kept(Subject& subject, const Scene& scene, unsigned) {
  const Trajectory& path = subject.run(scene).path;
  const Vec3 from = centre_of_mass(scene, scene.start.x), v = start_velocity_of_the_centre(scene);
  // the momentum divided by the mass is measured by positions, so that engines without velocities can be checked too
  return over_time("the centre of mass against uniform motion", "m", path, subject.noise_with_unsolved(scene).x,
                   [&](int i) { return (centre_of_mass(scene, path.x[i]) - from - v * path.t[i]).norm(); });
}

RelationResult angular_momentum_kept(Subject& subject, const Scene& scene, unsigned) {
  const Eigen::VectorXd& mass = scene.model.particles.mass;
  const auto changes_in = [&](const Trajectory& path) {
    require_velocities(path);
    std::vector<double> changes;
    Vec3 first = Vec3::Zero();
    double most = 0;
    for (int i = 0; i < path.frames(); ++i) {
      Vec3 sum = Vec3::Zero();
      for (int p = 0; p < mass.size(); ++p) sum += mass[p] * Vec3(path.x[i].col(p)).cross(Vec3(path.v[i].col(p)));
      if (i == 0) first = sum;
      changes.push_back(most = std::max(most, (sum - first).norm()));
    }
    return changes;
  };
  const Trajectory& path = subject.run(scene).path;
  const std::vector<double> whole = changes_in(path);
  double far = 0, fast = 0;
  for (int i = 0; i < path.frames(); ++i)
    far = std::max(far, largest_column(path.x[i])), fast = std::max(fast, largest_column(path.v[i]));
  // Rounding errors dx and dv change the angular momentum by m (dx cross v + x cross dv). The bound uses the largest
  // distance and the largest speed. `times`: number of halvings of the step
  const auto rounding = [&](int times) {
    Scene finer = scene;
    finer.step = std::ldexp(scene.step, -times);
    const Subject::Noise noise = subject.noise_with_unsolved(finer);
    std::vector<double> bound(noise.x.size());
    for (size_t i = 0; i < bound.size(); ++i) bound[i] = mass.sum() * (noise.x[i] * fast + noise.v[i] * far);
    return bound;
  };
  const Stepper* rule = stepper_of(subject.method());
  // Rules that consist of drifts and of kicks along central forces conserve angular momentum; other rules change it by
  // an error of their order.
  if (chooses_steps(subject.method()) || (rule && rule->symplectic))
    return over_time("change of angular momentum", "kg m^2/s", path, rounding(0), [&](int i) { return whole[i]; });
  const std::vector<double> half = changes_in(halved(subject, scene, 1));
  const int order = order_of(subject.method());
  const auto shrinks = [&](const char* at, const std::vector<double>& fine, const char* than,
                           const std::vector<double>& coarse, std::vector<double> most) {
    for (size_t i = 0; i < most.size(); ++i) most[i] += std::exp2(0.5 - order) * coarse[i];
    return over_time(
        fmt::format("change of angular momentum at {} the step; order {} allows 2^-{} times that at {} step", at, order,
                    order - 0.5, than),
        "kg m^2/s", path, most, [&](int i) { return fine[i]; });
  };
  RelationResult found = shrinks("half", half, "the whole", whole, rounding(1));
  if (found.holds()) return found;
  // At a coarse step, a damping rule has removed most of a vibration, so that the change is near its limit: in a case
  // with six particles, consecutive halvings of the step multiplied the change by 0.68, 0.59, 0.55 and 0.52.
  RelationResult finer = shrinks("a quarter of", changes_in(halved(subject, scene, 2)), "half the", half, rounding(2));
  return finer.ratio() < found.ratio() ? finer : found;
}

namespace {

/// Drift of the energy in a run, and the oscillation and rounding that can hide a drift, J.
struct Drift {
  double change, hidden;
  std::vector<double> changes, times;  // mean energy of each tenth of the run minus that of the first, J; s
};

Drift drift_of(Subject& subject, const Scene& scene, const Run& settings) {
  const SubjectRun& run = subject.run(scene, settings);
  const Trajectory& path = run.path;
  require_velocities(path);
  const int tenth = path.frames() / 10;
  if (tenth < 3) throw CannotBeAsked("the scene has fewer than thirty samples");
  std::vector<double> energy, mean, swing;
  double scale = 0;
  for (int i = 0; i < path.frames(); ++i) {
    const Energy e = energy_of(scene.model, {path.t[i], path.x[i], path.v[i]});
    energy.push_back(e.total());
    scale = std::max({scale, std::abs(e.total()), e.kinetic + e.elastic});
  }
  Drift drift{};
  for (int part = 0; part < 10; ++part) {
    const auto from = energy.begin() + part * tenth, to = from + tenth;
    double sum = 0;
    for (auto e = from; e != to; ++e) sum += *e;
    mean.push_back(sum / tenth);
    swing.push_back(*std::max_element(from, to) - *std::min_element(from, to));
    drift.changes.push_back(std::abs(mean[part] - mean[0])), drift.times.push_back(path.t[part * tenth]);
  }
  std::nth_element(swing.begin(), swing.begin() + 5, swing.end());
  const double steps = static_cast<double>(std::max(1L, run.outcome.steps));
  drift.change = drift.changes.back();
  drift.hidden = swing[5] + 10 * subject.unit_roundoff() * std::sqrt(steps) * scale;
  return drift;
}

}  // namespace

RelationResult energy_without_drift(Subject& subject, const Scene& scene, unsigned) {
  const Method& method = subject.method();
  const Run run = run_for_relations(scene);
  const Drift whole = drift_of(subject, scene, run);
  RelationResult found{"mean energy of the last tenth minus the first", "J", whole.change, whole.hidden};
  for (int part = 1; part < 10 && !found.since && !found.holds(); ++part)
    if (whole.changes[part] > found.tolerance) found.since = whole.times[part];
  if (found.holds()) return found;
  if (!method.adaptive && chooses_steps(method))
    throw CannotBeAsked("its energy drifts, and as it chooses its own steps, the order of the drift is unknown");
  // in rules that are not symplectic, the error of the energy falls with at least the rule's order; the allowance of
  // half a power covers terms of higher order. The error of an adaptive rule is roughly proportional to its tolerance
  const double part = method.adaptive ? 0.5 : std::exp2(0.5 - order_of(method));
  const auto finer = [&](int times) {
    Run fine = run;
    method.adaptive ? fine.tolerance /= std::pow(10, times) : fine.step = std::ldexp(run.step, -times);
    return drift_of(subject, scene, fine);
  };
  Drift before = whole;
  for (int times = 1; times <= 3 && !found.holds(); ++times) {
    const Drift after = finer(times);
    RelationResult falls{fmt::format("energy drift at {}; allowed: {:.2g} times the previous drift",
                                     method.adaptive ? fmt::format("10^-{} of the tolerance", times)
                                                     : fmt::format("2^-{} of the step", times),
                                     part),
                         "J", after.change, part * before.change + after.hidden};
    if (times == 1 || falls.ratio() < found.ratio()) found = std::move(falls);
    before = after;
  }
  return found;
}

RelationResult pins_on_their_path(Subject& subject, const Scene& scene, unsigned) {
  const SubjectRun& run = subject.run(scene);
  const Trajectory& path = run.path;
  const Particles& p = scene.model.particles;
  // positions of pins are recomputed or rounded in every step, so that their errors do not grow
  const double steps = static_cast<double>(std::max(1L, run.outcome.steps));
  const std::vector<double> bound(path.frames(),
                                  10 * subject.unit_roundoff() * std::sqrt(steps) * lengths_in(scene, path));
  return over_time(p.move ? "distance of pins from their path" : "distance of pins from their place", "m", path, bound,
                   [&](int i) {
                     State there = scene.start;
                     there.t = path.t[i];
                     p.place_pins(there);
                     double most = 0;
                     for (const int pin : p.pins) most = std::max(most, (path.x[i].col(pin) - there.x.col(pin)).norm());
                     return most;
                   });
}

RelationResult rest_without_damping(Subject& subject, const Scene& scene, unsigned) {
  Scene more = scene;
  constexpr double factor = 1.6;
  if (auto* drag = more.model.find<Drag>()) drag->c *= factor;
  if (auto* dashpots = more.model.find<Dashpots>())
    for (auto& d : dashpots->list) d.c *= factor;
  more.hash = hash_of(more);
  const Rest here = at_rest(subject, scene), there = at_rest(subject, more);
  return {"the shape at rest minus that with 1.6 times the damping", "m", largest_column(here.x - there.x),
          here.unsettled + there.unsettled};
}

RelationResult extension_by_stiffness(Subject& subject, const Scene& scene, unsigned) {
  const Rest rest = at_rest(subject, scene);
  const std::vector<Spring> chain = hanging_chain_of(scene);
  const Eigen::VectorXd& mass = scene.model.particles.mass;
  // in a chain, the tension of each spring divided by the mass below it is g; tensions follow the engine's own spring
  // law
  SpringLaw law = scene.model.find<Springs>()->law;
  if (subject.method().spring_law != SpringLaw::hooke) law = subject.method().spring_law;
  const double weight = scene.model.find<Gravity>()->acceleration.norm();
  std::vector<double> pull;
  double stiffest = 0;
  for (size_t i = 0; i < chain.size(); ++i) {
    const double below = mass.tail(mass.size() - 1 - static_cast<int>(i)).sum();
    const Tension tension = tension_of(chain[i], law, extension_of(chain[i], rest.x) + chain[i].rest);
    pull.push_back(tension.force / below);
    stiffest = std::max(stiffest, tension.slope / below);
  }
  RelationResult found{"tension over the mass below, minus gravity", "m/s^2", 0, 4 * stiffest * rest.unsettled};
  for (const double p : pull) found.measured = std::max(found.measured, std::abs(p - weight));
  return found;
}

RelationResult stiffness_has_effect(Subject& subject, const Scene& scene, unsigned) {
  const Rest soft = at_rest(subject, scene);
  const std::vector<Spring> chain = hanging_chain_of(scene);
  std::optional<RelationResult> worst;
  for (const Spring& spring : chain) {
    Scene stiff = scene;
    for (Spring& s : stiff.model.find<Springs>()->list)
      if (s.a == spring.a && s.b == spring.b) s.k *= 4;
    stiff.hash = hash_of(stiff);
    const Rest hard = at_rest(subject, stiff);
    const double before = extension_of(spring, soft.x), after = extension_of(spring, hard.x);
    // any effect that is larger than the remaining movement counts
    RelationResult found{
        fmt::format("extension of the spring between {} and {} with four times its stiffness, over that before",
                    spring.a, spring.b),
        "1", after / before, 1 - 2 * (soft.unsettled + hard.unsettled) / std::abs(before)};
    worst = worst ? worse(*worst, std::move(found)) : std::move(found);
  }
  return *worst;
}

}  // namespace crosscheck
