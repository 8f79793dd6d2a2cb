// One step reads: stepper, pins, contacts.
#include "mysim/engine.h"

#include "mysim/errors.h"
#include "mysim/march.h"

namespace crosscheck {
namespace {

class MysimWorld : public World {
 public:
  MysimWorld(const Stepper& stepper, ContactRule rule, const Scene& scene, double h)
      : stepper_(stepper),
        rule_(rule),
        particles_(scene.model.particles),
        sphere_(scene.model.find<Sphere>()),
        h_(h),
        f_(scene.model),
        s_(scene.start),
        proposed_(scene.start),
        workspace_(scene.start),
        x_n_(scene.start.x) {}

  void step(double, double t_next) override {
    if (sphere_) x_n_ = s_.x;
    stepper_.step(f_, s_, h_, workspace_);
    s_.t = t_next;
    particles_.place_pins(s_);
    if (sphere_) resolve_contacts();
  }

  const State& state(double) override { return s_; }

  void tell_contact(Observer& observer) override {
    if (touched_) observer.contact(proposed_, s_);
  }

  const System& right_hand_side() const { return f_; }

 private:
  /// Lets the sphere act on the whole step of every free particle.
  void resolve_contacts() {
    proposed_ = s_;
    touched_ = false;
    const auto resolve = rule_ == ContactRule::sticky ? resolve_contact_sticky : resolve_contact;
    for (int i = 0; i < particles_.size(); ++i)
      if (!particles_.pinned[i]) touched_ |= resolve(*sphere_, x_n_.col(i), s_.x.col(i), s_.v.col(i)) > 0;
  }

  const Stepper& stepper_;
  ContactRule rule_;
  const Particles& particles_;
  const Sphere* sphere_;
  double h_;
  System f_;
  State s_, proposed_;
  Workspace workspace_;
  Points x_n_;
  bool touched_ = false;
};

}  // namespace

Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer) {
  if (scene.model.first_order() && !stepper.first_order)
    throw Unsupported("the scene is a first-order system x' = f(x, t), and this rule needs positions and velocities");
  MysimWorld world(stepper, contact, scene, plan(run).h);
  Outcome out = march(world, run, observer);
  out.evaluations = world.right_hand_side().evaluations();
  out.coincident = world.right_hand_side().coincident();
  return out;
}

}  // namespace crosscheck
