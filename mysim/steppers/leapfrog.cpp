// Leapfrog in its drift-kick-drift form: one force evaluation a step, at the middle. Drag is averaged over old and new
// velocity, v' = v + h a - h gamma (v + v') / 2, so that the step stays its own inverse under h -> -h and of order 2.
#include "mysim/steppers/stepper.h"

namespace crosscheck {

void leapfrog(System& f, State& s, double h, Workspace& w) {
  // drift to the middle
  w.stage.t = s.t + h / 2;
  w.stage.x = s.x + h / 2 * s.v;
  w.stage.v = s.v;

  // kick with the force there
  f.undragged_acceleration(w.stage, w.k1.v);
  const Eigen::ArrayXd& gamma = f.drag_rate();
  for (int i = 0; i < s.v.cols(); ++i) {
    const double half = h / 2 * gamma[i];
    s.v.col(i) = ((1 - half) * s.v.col(i) + h * w.k1.v.col(i)) / (1 + half);
  }

  // drift to the end
  s.x = w.stage.x + h / 2 * s.v;
}

}  // namespace crosscheck
