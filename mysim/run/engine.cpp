#include "mysim/run/engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>

#include "mysim/base/errors.h"
#include "mysim/base/hash.h"
#include "mysim/run/cloth_grid_world.h"
#include "mysim/run/run.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"

namespace crosscheck {

namespace {

int stride_of(const Observer& observer, const TimeGrid& grid, World& world) {
  if (observer.every_step()) return 1;
  return observer.between_samples() ? verdict_stride(grid, static_cast<int>(world.state(0).x.cols()))
                                    : grid.steps_per_sample;
}

}  // namespace

TimeGrid RunLoop::grid_of(World& world, const Run& run, const Observer& observer) {
  TimeGrid grid = time_grid(run);
  if (!world.chooses_steps()) return grid;
  const int stride = stride_of(observer, grid, world);  // the world covers this interval with steps of its own
  grid.steps_per_sample /= stride, grid.h = run.duration / run.samples / grid.steps_per_sample;
  return grid;
}

RunLoop::RunLoop(World& world, const Run& run, Observer& observer)
    : world_(world),
      observer_(observer),
      run_(run),
      every_step_(observer.every_step()),
      grid_(grid_of(world, run, observer)),
      stride_(stride_of(observer, grid_, world)),
      chooses_steps_(world.chooses_steps()),
      clock_(run.timed) {
  assert(grid_.h > 0 && grid_.steps_per_sample >= 1 && grid_.samples >= 1);
  out_.step = grid_.h;
  out_.verdict = observer.observe(world.state(0), true);
  clock_.start();
}

bool RunLoop::step() {
  if (ended()) return false;
  const double t = grid_.time(sample_, step_), t_next = grid_.time(sample_, ++step_);
  try {
    world_.step(t, t_next);
  } catch (const SolverFailure& failure) {
    out_.verdict = Verdict::solver;
    out_.reason = failure.what();
    return true;
  }
  out_.end = t_next;
  const bool first = out_.steps++ == 0, sampled = step_ == grid_.steps_per_sample, seen = step_ % stride_ == 0;
  if (!seen && !first) return true;

  // a world with adaptive steps interpolates most states; an interval in which it takes no step is not timed
  const long evaluations = chooses_steps_ ? world_.work().evaluations : 0;
  if (!chooses_steps_ || evaluations > evaluations_) clock_.stop();
  evaluations_ = evaluations;
  if (first && (out_.readback = world_.read_back())) out_.readback->step = grid_.h;
  if (every_step_) world_.report_contact(observer_);
  if (seen) out_.verdict = observer_.observe(world_.state(t_next), sampled);
  if (sampled) ++sample_, step_ = 0;
  clock_.start();
  return true;
}

Outcome RunLoop::outcome() {
  clock_.stop();
  Outcome out = out_;
  const World::Work work = world_.work();
  out.evaluations = work.evaluations;
  out.degenerate_springs = work.degenerate_springs;
  out.cpu_seconds = clock_.seconds() + (run_.timed ? work.worker_seconds : 0);
  if (work.steps) {
    out.steps = *work.steps;
    out.step = out.steps > 0 ? out.end / static_cast<double>(out.steps) : 0;
    out.tolerance = run_.tolerance;
  }
  if (out.verdict != Verdict::ok)
    out.reason = fmt::format("the run failed at t = {:.4g} s{}{}", out.end, out.reason.empty() ? "" : ": ", out.reason);
  return out;
}

Outcome run_loop(World& world, const Run& run, Observer& observer) {
  RunLoop loop(world, run, observer);
  while (loop.step()) {
  }
  return loop.outcome();
}

namespace {

/// Applies any rule to any scene; defines the results that every faster world must reproduce.
class SteppedWorld : public World {
 public:
  SteppedWorld(const Stepper& stepper, ContactRule rule, const Scene& scene, double h)
      : stepper_(stepper),
        particles_(scene.model.particles),
        contacts_(scene.model, rule),
        h_(h),
        f_(scene.model),
        s_(scene.start),
        workspace_(scene.start) {}

  void step(double, double t_next) override {
    if (contacts_.any()) contacts_.begin(s_);
    stepper_.step(f_, s_, h_, workspace_);  // see steppers/leapfrog.cpp and its neighbours
    s_.t = t_next;
    // no rule moves fixed pins, whose velocity and acceleration are zero
    if (particles_.move) particles_.place_pins(s_);
    if (contacts_.any()) contacts_.resolve(s_);
  }

  const State& state(double) override { return s_; }
  void report_contact(Observer& observer) override {
    if (contacts_.lost()) observer.contact(*contacts_.lost());
  }
  Work work() const override { return {f_.evaluations(), f_.degenerate_springs()}; }

 private:
  const Stepper& stepper_;
  const Particles& particles_;
  Contacts contacts_;
  double h_;
  System f_;
  State s_;
  Workspace workspace_;
};

/// A scene stepped by the Dormand-Prince pair under error control.
///
/// Steps are chosen so that the root mean square of (estimated error of a step) / (R (scene size + |x|)) stays at or
/// below 1, with R = run.tolerance. The same applies to velocities, with the largest speed so far instead of the
/// scene's size. Requested states are interpolated. With contact surfaces, no step passes the next requested state,
/// because contact acts on whole steps.
class AdaptiveWorld : public World {
 public:
  AdaptiveWorld(const Scene& scene, const Run& run, ContactRule contact);
  void step(double t, double t_next) override;
  /// Interpolates outside the clock, so that only steps are timed.
  const State& state(double t) override;
  void report_contact(Observer& observer) override {
    if (lost_) observer.contact(*lost_);
  }
  Work work() const override { return {f_.evaluations(), f_.degenerate_springs(), accepted_}; }
  bool chooses_steps() const override { return !contacts_.any(); }

 private:
  double error_ratio();
  void advance(double limit);

  const Scene& scene_;
  System f_;
  Contacts contacts_;
  DormandPrince pair_;
  double tolerance_, h_, last_h_ = 0;
  double shortest_;           // s; shorter steps are lost in the rounding of time
  double fastest_;            // m/s, largest speed in accepted states
  double last_ratio_ = 1e-4;  // error ratio of the previous step, for the controller
  State before_, s_, seen_;   // start and end of the last accepted step; requested state
  long accepted_ = 0;
  std::optional<double> lost_;  // J, in contacts since the previous requested state
};

// Step-size control (E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, II.4; PI
// control: volume II, IV.2).

AdaptiveWorld::AdaptiveWorld(const Scene& scene, const Run& run, ContactRule contact)
    : scene_(scene),
      f_(scene.model),
      contacts_(scene.model, contact),
      pair_(scene.start),
      tolerance_(run.tolerance),
      // without contact, run.step is only the interval between observed states, so the first step is scene.step
      h_(std::min(contacts_.any() ? run.step : scene.step, run.duration)),
      shortest_(1e-14 * run.duration),
      fastest_(largest_column(scene.start.v)),
      before_(scene.start),
      s_(scene.start),
      seen_(scene.start) {}

double AdaptiveWorld::error_ratio() {
  const State &error = pair_.error(), &next = pair_.next();
  const auto part = [&](const Points& e, const Points& from, const Points& to, double scale) {
    double sum = 0;
    for (int i = 0; i < e.cols(); ++i) {
      const double allowed = tolerance_ * (scale + std::max(from.col(i).norm(), to.col(i).norm()));
      sum += e.col(i).squaredNorm() / (allowed * allowed);
    }
    return e.cols() > 0 ? sum / static_cast<double>(e.cols()) : 0;
  };
  // the speed after one step with the initial forces is for scenes that start at rest
  const double speed = std::max({fastest_, pair_.first_step_speed(), 1e-300});
  return std::sqrt(std::max(part(error.x, s_.x, next.x, scene_.size()), part(error.v, s_.v, next.v, speed)));
}

/// Takes one accepted step that ends at `limit` at the latest.
void AdaptiveWorld::advance(double limit) {
  constexpr double safety = 0.9, most = 5, least = 0.2, integral = 0.04, proportional = 0.2 - 0.75 * integral;
  contacts_.begin(s_);
  double room = most;
  for (;;) {
    // a step that would leave a tiny remainder before the limit is extended to the limit
    const double h = s_.t + 1.01 * h_ >= limit ? limit - s_.t : h_;
    if (!(h > shortest_)) throw SolverFailure(fmt::format("the step fell below round-off at t = {:.4g} s", s_.t));
    pair_.attempt(f_, s_, h);
    const double ratio = error_ratio();
    if (ratio <= 1) {
      before_ = s_;
      s_ = pair_.next();
      fastest_ = std::max(fastest_, largest_column(s_.v));
      s_.t = h == h_ ? before_.t + h : limit;
      last_h_ = h;
      const double kept = std::max(ratio, 1e-10);
      const double factor = safety * std::pow(kept, -proportional) * std::pow(last_ratio_, integral);
      // a step cut at the limit is no reason to shorten the next one
      h_ = std::max(h == h_ ? 0.0 : h_, h * std::clamp(factor, least, room));
      last_ratio_ = std::max(ratio, 1e-4);
      ++accepted_;
      return;
    }
    h_ = h * (std::isfinite(ratio) ? std::max(least, safety * std::pow(ratio, -0.2)) : 0.1);
    room = 1;  // no growth right after a rejection
  }
}

void AdaptiveWorld::step(double, double t_next) {
  const Particles& particles = scene_.model.particles;
  constexpr double far = 1e300;
  lost_.reset();
  while (s_.t < t_next) {
    if (accepted_ > 0) pair_.accept();
    advance(contacts_.any() ? t_next : far);
    if (contacts_.any()) {
      particles.place_pins(s_);
      if (!contacts_.resolve(s_)) continue;
      pair_.forget();
      lost_ = lost_.value_or(0) + *contacts_.lost();
    }
  }
}

const State& AdaptiveWorld::state(double t) {
  if (contacts_.any() || accepted_ == 0) return s_;
  pair_.interpolate(before_, last_h_, (t - before_.t) / last_h_, seen_);
  seen_.t = t;
  if (!scene_.model.first_order()) scene_.model.particles.place_pins(seen_);
  return seen_;
}

void require_supported(const Stepper& stepper, const Model& model) {
  if (model.first_order() && !stepper.first_order)
    throw Unsupported("the scene is a first-order system x' = f(x, t), but this rule needs positions and velocities");
  if (model.find<Constraints>() && !stepper.hard_constraints)
    throw Unsupported("the scene has hard distances, but this rule supports only forces");
}

/// Returns a remark if particles lie on a surface with restitution at the end of a run with steps of h (s), otherwise
/// an empty string. In each step, contact on whole steps reverses a part of the speed that the step added. A particle
/// at rest under an acceleration a (m/s^2) therefore keeps hopping by about a h^2. With explicit Euler, which adds
/// energy in each flight, the height is at least 9 a h^2.
std::string hops_at_rest(const Scene& scene, State s, double h) {
  std::vector<Surface> surfaces = surfaces_of(scene.model);
  std::erase_if(surfaces, [](const Surface& surface) { return !(surface.restitution > 0 && surface.restitution < 1); });
  if (surfaces.empty() || scene.model.first_order()) return "";
  System f(scene.model);
  Points a(3, s.x.cols());
  f.acceleration(s, a);
  int hopping = 0;
  double highest = 0;  // m
  for (const Surface& surface : surfaces) {
    const Vec3 origin = surface.origin_at(s.t), u = surface.velocity_at(s.t);
    for (int i = 0; i < s.x.cols(); ++i) {
      const Vec3 d = s.x.col(i) - origin, n = surface.normal(d);
      const double pressed = -a.col(i).dot(n), hop = pressed * h * h;
      if (scene.model.particles.pinned[i] || !(pressed > 0) || surface.gap(d) > 10 * hop ||
          std::abs((s.v.col(i) - u).dot(n)) > 5 * pressed * h)
        continue;
      ++hopping, highest = std::max(highest, hop);
    }
  }
  if (hopping == 0) return "";
  return fmt::format(
      "{} {} on a surface with restitution and {} never quite at rest: contact on whole steps makes them hop by about "
      "{:.2g} m, in proportion to the square of the step",
      hopping, hopping == 1 ? "particle lies" : "particles lie", hopping == 1 ? "is" : "are", highest);
}

}  // namespace

std::unique_ptr<World> make_world(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run,
                                  const Observer& observer, const Execution& execution) {
  require_supported(stepper, scene.model);
  if (stepper.adaptive) return std::make_unique<AdaptiveWorld>(scene, run, contact);
  const double h = time_grid(run).h;
  if (auto cloth = simd::make_cloth_grid_world(stepper, contact, scene, h, execution, observer)) return cloth;
  return std::make_unique<SteppedWorld>(stepper, contact, scene, h);
}

Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution) {
  const auto world = make_world(stepper, contact, scene, run, observer, execution);
  Outcome out = run_loop(*world, run, observer);
  if (contact == ContactRule::coulomb && !stepper.adaptive && out.verdict == Verdict::ok)
    out.remark = hops_at_rest(scene, world->state(out.end), out.step);
  if (execution.path == ExecutionPath::single_precision && !world->work().single_precision)
    out.remark = fmt::format(
        "computed in double precision: single precision requires a regular cloth of {} columns or more "
        "without bending, dashpots and aerodynamics; with contact, also symplectic-euler or leapfrog without +sticky",
        simd::fewest_columns);
  return out;
}

std::string fingerprint(const State& state) {
  Fnv1a hash;
  for (const Points* points : {&state.x, &state.v})
    for (const double value : points->reshaped())
      for (int i = 0; i < 8; ++i) hash.add(static_cast<unsigned char>(std::bit_cast<std::uint64_t>(value) >> (8 * i)));
  return fmt::format("{:016x}", hash.value());
}

}  // namespace crosscheck
