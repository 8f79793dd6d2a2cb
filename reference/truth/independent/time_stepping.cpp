// Contact as Moreau's measure differential inclusion, integrated by his midpoint rule on the independent right-hand
// side: a second route for cloths, which have too many events to locate. Calls none of mysim's contact code. J. J.
// Moreau, "Numerical aspects of the sweeping process", Comput. Methods Appl. Mech. Engrg. 177 (1999).
//
// Let x_m = x + h v / 2, and let v_f = v + h a(x_m) be the velocity without contact. A solid that contains x_m gives
// the impulse p n + q, with q along its surface. The velocity relative to the solid is w, after the step w+; p >= 0 is
// complementary to w+.n + e min(w.n, 0) >= 0. Friction obeys |q| <= mu p. If the tangential part of w+ does not vanish,
// q is opposite to it, and |q| = mu p. The new position is x+ = x_m + h v+ / 2. The order is 2 in free flight, and 1
// with contact. No particle is moved out of a solid, so it may be inside by a step's motion.

#include <Eigen/Core>

#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/run/engine.h"
#include "reference/truth/independent/integrators.h"
#include "reference/truth/independent/right_hand_side.h"

namespace crosscheck {
namespace {

class TimeSteppingWorld : public World {
 public:
  explicit TimeSteppingWorld(const Scene& scene)
      : solids_(solids_of(scene)),
        f_(without_contact(scene)),
        y_(f_.start()),
        half_(y_.size() / 2),
        before_(y_.begin() + static_cast<long>(half_), y_.end()),
        rate_(y_.size()),
        state_(scene.start) {}

  void step(double t, double t_next) override {
    const double h = t_next - t, middle = t + h / 2;
    double* v = y_.data() + half_;
    trial_ = y_;
    for (size_t k = 0; k < half_; ++k) {
      y_[k] += h / 2 * v[k];
      trial_[k] = y_[k];
      // velocity-dependent forces such as drag use the velocity at the middle
      trial_[half_ + k] = 1.5 * v[k] - 0.5 * before_[k];
    }
    f_(trial_, rate_, middle);
    for (Solid& solid : solids_) solid.move_to(middle);
    for (size_t k = 0; k < half_; k += 3) {
      const Vec3 place = Eigen::Map<const Vec3>(&y_[k]), was = Eigen::Map<const Vec3>(v + k);
      Vec3 now = was + h * Eigen::Map<const Vec3>(&rate_[half_ + k]);
      bool touches = false;
      for (const Solid& solid : solids_) {
        if (solid.height(place) > 0) continue;
        if (std::exchange(touches, true)) throw Unsupported("a particle touches two surfaces at once");
        now = solid.velocity + after_contact(solid, solid.normal(place), was - solid.velocity, now - solid.velocity);
      }
      Eigen::Map<Vec3>(before_.data() + k) = was;
      Eigen::Map<Vec3>(v + k) = now;
    }
    for (size_t k = 0; k < half_; ++k) y_[k] += h / 2 * v[k];
  }

  const State& state(double t) override {
    f_.write_state(y_, t, state_);
    return state_;
  }
  Work work() const override { return {f_.evaluations(), f_.degenerate_springs()}; }

 private:
  static Vec3 after_contact(const Solid& solid, const Vec3& n, const Vec3& was, const Vec3& free) {
    const double push = -free.dot(n) - solid.restitution * std::min(was.dot(n), 0.0);
    if (!(push > 0)) return free;
    const Vec3 along = free - free.dot(n) * n;
    const double speed = along.norm(), held = solid.friction * push;
    return (free.dot(n) + push) * n + (speed <= held ? Vec3::Zero() : Vec3(along * (1 - held / speed)));
  }

  std::vector<Solid> solids_;
  RightHandSide f_;
  StateVector y_;
  const size_t half_;           // 3 times the number of free particles
  std::vector<double> before_;  // m/s, one step ago
  StateVector rate_, trial_;
  State state_;
};

}  // namespace

Outcome run_time_stepping(const Scene& scene, const Run& run, Observer& observer) {
  TimeSteppingWorld world(scene);
  return run_loop(world, run, observer);
}

}  // namespace crosscheck
