// A scene stepped by the pair of Dormand and Prince under error control.
#pragma once

#include "mysim/contacts.h"
#include "mysim/march.h"
#include "mysim/steppers/dopri5.h"

namespace crosscheck {

/// Steps are chosen so that the root mean square of (estimated error of a step) / (R (scene size + |x|)), and likewise
/// of velocities with the largest speed so far for the scene's size, stays at or below 1, with R = run.tolerance. The
/// states that are asked for lie on the interpolant. Beside a sphere no step goes beyond the next state asked for,
/// since contact acts on whole steps; it may take several to get there, and each may touch.
class AdaptiveWorld : public World {
 public:
  AdaptiveWorld(const Scene& scene, const Run& run, ContactRule contact);
  void step(double t, double t_next) override;
  /// On the interpolant; looked at outside the clock, so that only the steps cost.
  const State& state(double t) override;
  void tell_contact(Observer& observer) override {
    if (lost_) observer.contact(*lost_);
  }

  const System& right_hand_side() const { return f_; }
  long accepted() const { return accepted_; }

 private:
  double error_ratio();
  void advance(double limit);

  const Scene& scene_;
  System f_;
  Contacts contacts_;
  DormandPrince pair_;
  double tolerance_, h_, last_h_ = 0;
  double fastest_;            // m/s, largest speed of an accepted state
  double last_ratio_ = 1e-4;  // of the step before, for the controller
  State before_, s_, seen_;   // start and end of the last accepted step; what was asked for
  long accepted_ = 0;
  std::optional<double> lost_;  // J, in contacts on the way to the last state asked for
};

}  // namespace crosscheck
