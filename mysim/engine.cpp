// One step reads: stepper, pins, contacts, observers.
#include "mysim/engine.h"

#include <fmt/format.h>

#include "mysim/clock.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

/// Lets the sphere act on every particle that was at x_n; true when one of them touched.
bool resolve_contacts(const Sphere& sphere, ContactRule rule, const Particles& particles, const Points& x_n, State& s) {
  bool touched = false;
  for (int i = 0; i < particles.size(); ++i) {
    if (particles.pinned[i]) continue;
    const auto resolve = rule == ContactRule::sticky ? resolve_contact_sticky : resolve_contact;
    touched |= resolve(sphere, x_n.col(i), s.x.col(i), s.v.col(i)) > 0;
  }
  return touched;
}

}  // namespace

Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer) {
  const Model& model = scene.model;
  if (model.first_order() && !stepper.first_order)
    throw Unsupported("the scene is a first-order system x' = f(x, t), and this rule needs positions and velocities");

  const StepPlan steps = plan(run);
  System f(model);
  State s = scene.start, proposed = s;
  Points x_n = s.x;
  Workspace workspace(s);
  const Sphere* sphere = model.find<Sphere>();
  const bool every_step = observer.every_step();
  CpuClock clock;
  Outcome out;
  out.step = steps.h;
  out.verdict = observer.observe(s, true);

  for (int sample = 0; sample < steps.samples && out.verdict == Verdict::ok; ++sample) {
    clock.start();
    for (int step = 1; step <= steps.steps_per_sample && out.verdict == Verdict::ok; ++step) {
      if (sphere) x_n = s.x;
      stepper.step(f, s, steps.h, workspace);
      s.t = steps.time(sample, step);
      model.particles.place_pins(s);
      bool touched = false;
      if (sphere) {
        if (every_step) proposed = s;
        touched = resolve_contacts(*sphere, contact, model.particles, x_n, s);
      }
      ++out.steps;
      if (every_step) {
        clock.stop();
        if (touched) observer.contact(proposed, s);
        out.verdict = observer.observe(s, step == steps.steps_per_sample);
        clock.start();
      }
    }
    clock.stop();
    if (!every_step) out.verdict = observer.observe(s, true);
  }

  out.end = s.t;
  out.cpu_seconds = clock.seconds();
  out.evaluations = f.evaluations();
  out.coincident = f.coincident();
  if (out.verdict != Verdict::ok) out.reason = fmt::format("the run failed at t = {:.4g} s", out.end);
  return out;
}

}  // namespace crosscheck
