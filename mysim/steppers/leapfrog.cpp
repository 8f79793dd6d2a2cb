// Leapfrog in its drift-kick-drift form: one force evaluation a step, at the middle. Drag is averaged over old and new
// velocity, v' = v + h a - h gamma (v + v') / 2, so that the step stays its own inverse under h -> -h and of order 2.

#include "mysim/steppers/steppers.h"

namespace crosscheck {
namespace {

/// v' = v + h (a - gamma v) / (1 + h gamma/2), for each particle. Written as ((1 - h gamma/2) v + h a) / (1 + h
/// gamma/2) it would round the little that drag takes as a part of v, by the same amount in every step.
void kick(const Eigen::ArrayXd& gamma, const Points& v, const Points& a, double h, Points& out) {
  for (int i = 0; i < v.cols(); ++i) {
    out.col(i) = v.col(i) + h / (1 + h / 2 * gamma[i]) * (a.col(i) - gamma[i] * v.col(i));
  }
}

}  // namespace

void leapfrog_step(System& f, State& s, double h, int passes, Workspace& w) {
  State& middle = w[0];
  Points &a = w[1].v, &position_only = w[1].x, &v = w[2].v;

  // drift to the middle
  middle.t = s.t + h / 2;
  middle.x = s.x + h / 2 * s.v;
  middle.v = s.v;

  // kick with the force there
  f.position_acceleration(middle, a);
  if (f.has_velocity_forces()) {
    position_only = a;
    for (int pass = 0; pass < passes; ++pass) {
      if (pass > 0) {
        a = position_only;
        middle.v = (s.v + v) / 2;
        f.model().particles.place_pin_velocities(middle);
      }
      f.add_velocity_acceleration(middle, a);
      kick(f.drag_rate(), s.v, a, h, v);
    }
    s.v = v;
  } else {
    kick(f.drag_rate(), s.v, a, h, s.v);
  }

  // drift to the end
  s.x = middle.x + h / 2 * s.v;
}

void leapfrog(System& f, State& s, double h, Workspace& w) { leapfrog_step(f, s, h, 2, w); }

KickDriftComposition leapfrog_composition() { return {{1}}; }

}  // namespace crosscheck
