// Leapfrog in drift-kick-drift form: one force evaluation per step, at the midpoint. Drag is averaged over old and new
// velocity, v' = v + h a - h gamma (v + v') / 2, so that the step is its own inverse under h -> -h and of order 2.

#include "mysim/steppers/steppers.h"

namespace crosscheck {
namespace {

/// out = v' = v + h (a - gamma v) / (1 + h gamma/2), where `out` may be `v`. The form ((1 - h gamma/2) v + h a) / (1 +
/// h gamma/2) would round the small effect of drag to ulps of v in every step.
void kick(const Eigen::ArrayXd& gamma, const Points& v, const Points& a, double h, Points& out) {
  for (int i = 0; i < v.cols(); ++i)
    out.col(i) = v.col(i) + h / (1 + h / 2 * gamma[i]) * (a.col(i) - gamma[i] * v.col(i));
}

void kick_with_velocity_forces(System& f, State& s, const Points& by_position, double h, int passes, Workspace& w) {
  Points &old = w[1].x, &next = w[1].v, &a = w[2].v;
  old = s.v;
  for (int pass = 0; pass < passes; ++pass) {
    if (pass > 0) {
      s.v = (old + next) / 2;
      f.model().particles.place_pin_velocities(s);
    }
    a = by_position;
    f.add_velocity_acceleration(s, a);
    kick(f.drag_rate(), old, a, h, next);
  }
  s.v = next;
}

}  // namespace

void leapfrog_step(System& f, State& s, double h, int passes, Workspace& w) {
  Points& a = w[0].v;
  const double start = s.t;
  s.t = start + h / 2;
  s.x += h / 2 * s.v;
  f.position_acceleration(s, a);
  if (f.has_velocity_forces())
    kick_with_velocity_forces(f, s, a, h, passes, w);
  else
    kick(f.drag_rate(), s.v, a, h, s.v);
  s.x += h / 2 * s.v;
  s.t = start;
}

void leapfrog(System& f, State& s, double h, Workspace& w) { leapfrog_step(f, s, h, 2, w); }

KickDriftComposition leapfrog_composition() { return {{1}}; }

}  // namespace crosscheck
