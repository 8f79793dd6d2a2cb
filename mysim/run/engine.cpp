// The run loop (samples, steps, observers, clock); one fixed step: stepper, pins, contacts; and step control.
#include "mysim/run/engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "mysim/run/cloth_grid_world.h"
#include "mysim/run/run.h"

namespace crosscheck {

Outcome run_loop(World& world, const Run& run, Observer& observer) {
  const TimeGrid steps = time_grid(run);
  const bool every_step = observer.every_step();
  auto* pairs = steps.steps_per_sample < 2 ? nullptr : dynamic_cast<StatePairObserver*>(&observer);
  // how many steps before a sample, modulo the distance of pairs
  const auto left = [&](int step) { return (steps.steps_per_sample - step) % StatePairObserver::steps_between_pairs; };
  CpuClock clock(run.timed);
  Outcome out;
  out.step = steps.h;
  out.verdict = observer.observe(world.state(0), true);

  for (int sample = 0; sample < steps.samples && out.verdict == Verdict::ok; ++sample) {
    if (pairs && !pairs->closely() && left(0) == 2) pairs->earlier(world.state(steps.time(sample, 0)));
    clock.start();
    for (int step = 1; step <= steps.steps_per_sample && out.verdict == Verdict::ok; ++step) {
      const double t = steps.time(sample, step);
      try {
        world.step(steps.time(sample, step - 1), t);
      } catch (const SolverFailure& failure) {
        out.verdict = Verdict::solver;
        out.reason = failure.what();
        break;
      }
      out.end = t;
      const bool first = out.steps++ == 0, sampled = step == steps.steps_per_sample;
      const bool between = pairs && !sampled, closely = between && pairs->closely(),
                 earlier = between && !closely && left(step) == 2,
                 later = closely || (between && step >= 2 && left(step) == 0);
      if (!every_step && !sampled && !first && !earlier && !later) continue;

      clock.stop();
      if (first && (out.readback = world.read_back())) out.readback->step = steps.h;
      if (every_step) world.report_contact(observer);
      if (every_step || sampled) out.verdict = observer.observe(world.state(t), sampled);
      if (earlier) pairs->earlier(world.state(t));
      if (later && out.verdict == Verdict::ok) out.verdict = pairs->later(world.state(t));
      clock.start();
    }
    clock.stop();
  }

  out.cpu_seconds = clock.seconds();
  if (out.verdict != Verdict::ok)
    out.reason = fmt::format("the run failed at t = {:.4g} s{}{}", out.end, out.reason.empty() ? "" : ": ", out.reason);
  return out;
}

namespace {

class FixedStepWorld : public World {
 public:
  FixedStepWorld(const Stepper& stepper, ContactRule rule, const Scene& scene, double h)
      : stepper_(stepper),
        particles_(scene.model.particles),
        contacts_(scene.model, rule),
        h_(h),
        f_(scene.model),
        s_(scene.start),
        workspace_(scene.start) {}

  void step(double, double t_next) override {
    contacts_.begin(s_);
    stepper_.step(f_, s_, h_, workspace_);
    s_.t = t_next;
    particles_.place_pins(s_);
    contacts_.resolve(s_);
  }

  const State& state(double) override { return s_; }
  void report_contact(Observer& observer) override {
    if (contacts_.lost()) observer.contact(*contacts_.lost());
  }
  const System& right_hand_side() const { return f_; }

 private:
  const Stepper& stepper_;
  const Particles& particles_;
  Contacts contacts_;
  double h_;
  System f_;
  State s_;
  Workspace workspace_;
};

void require_supported(const Stepper& stepper, const Model& model) {
  if (model.first_order() && !stepper.first_order)
    throw Unsupported("the scene is a first-order system x' = f(x, t), and this rule needs positions and velocities");
  if (model.find<Constraints>() && !stepper.hard_constraints)
    throw Unsupported("the scene has hard distances, and this rule knows forces only");
}

Outcome simulate_adaptively(ContactRule contact, const Scene& scene, const Run& run, Observer& observer) {
  AdaptiveWorld world(scene, run, contact);
  return run_adaptive_loop(world, run, observer, scene.model.find<Spheres>() != nullptr);
}

}  // namespace

Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution) {
  require_supported(stepper, scene.model);
  if (stepper.adaptive) return simulate_adaptively(contact, scene, run, observer);
  if (const auto cloth = simd::make_cloth_grid_world(stepper, contact, scene, time_grid(run).h, execution, observer)) {
    Outcome out = run_loop(*cloth, run, observer);
    out.evaluations = cloth->evaluations();
    out.degenerate_springs = cloth->degenerate_springs();
    if (run.timed) out.cpu_seconds += cloth->worker_seconds();
    return out;
  }
  FixedStepWorld world(stepper, contact, scene, time_grid(run).h);
  Outcome out = run_loop(world, run, observer);
  out.evaluations = world.right_hand_side().evaluations();
  out.degenerate_springs = world.right_hand_side().degenerate_springs();
  if (execution.precision == Precision::single)
    out.remark = "computed in double precision: single is for regular cloths of 33 columns or more";
  return out;
}

// Step control (E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, II.4; proportional
// and integral parts as in II of the same, IV.2).

AdaptiveWorld::AdaptiveWorld(const Scene& scene, const Run& run, ContactRule contact)
    : scene_(scene),
      f_(scene.model),
      contacts_(scene.model, contact),
      pair_(scene.start),
      tolerance_(run.tolerance),
      h_(std::min(run.step, run.duration)),
      fastest_(largest_column(scene.start.v)),
      before_(scene.start),
      s_(scene.start),
      seen_(scene.start) {}

/// Root mean square over the particles of estimated over allowed error.
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
  // from rest: the speed that the forces at the start give in the step
  const double speed = std::max({fastest_, pair_.first_step_speed(), 1e-300});
  return std::sqrt(std::max(part(error.x, s_.x, next.x, scene_.size()), part(error.v, s_.v, next.v, speed)));
}

/// One accepted step that ends at `limit` at the latest.
void AdaptiveWorld::advance(double limit) {
  constexpr double safety = 0.9, most = 5, least = 0.2, integral = 0.04, proportional = 0.2 - 0.75 * integral;
  contacts_.begin(s_);
  double room = most;
  for (;;) {
    // a step that would leave a sliver before the limit takes the whole way
    const double h = s_.t + 1.01 * h_ >= limit ? limit - s_.t : h_;
    if (!(h > 1e-14 * std::max(1.0, s_.t)))
      throw SolverFailure(fmt::format("the step fell below round-off at t = {:.4g} s", s_.t));
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
      // a step cut short to end at the limit says nothing against the one that was planned
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

}  // namespace crosscheck
