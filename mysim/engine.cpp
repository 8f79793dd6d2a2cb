// One step reads: stepper, pins, contacts.
#include "mysim/engine.h"

#include "mysim/adaptive.h"
#include "mysim/errors.h"
#include "mysim/march_adaptively.h"
#include "mysim/strip/sheet_world.h"

namespace crosscheck {
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
  void tell_contact(Observer& observer) override {
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
  return march_adaptively(world, run, observer, scene.model.find<Spheres>() != nullptr);
}

}  // namespace

Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution) {
  require_supported(stepper, scene.model);
  if (stepper.adaptive) return simulate_adaptively(contact, scene, run, observer);
  if (const auto sheet = strip::sheet_world(stepper, contact, scene, plan(run).h, execution, observer)) {
    Outcome out = march(*sheet, run, observer);
    out.evaluations = sheet->evaluations();
    out.coincident = sheet->coincident();
    if (run.timed) out.cpu_seconds += sheet->other_seconds();
    return out;
  }
  FixedStepWorld world(stepper, contact, scene, plan(run).h);
  Outcome out = march(world, run, observer);
  out.evaluations = world.right_hand_side().evaluations();
  out.coincident = world.right_hand_side().coincident();
  if (execution.precision == Precision::single)
    out.remark = "computed in double precision: single is for regular cloths of 33 columns or more";
  return out;
}

}  // namespace crosscheck
