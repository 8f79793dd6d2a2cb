#include "mysim/steppers/steppers.h"

namespace crosscheck {

void rk4(System& f, State& s, double h, Workspace& w) {
  rk4_step([&](State& stage, State& rate) { f.derivative(stage, rate); }, s, h, {&w[0], &w[1], &w[2], &w[3]}, w[4]);
}

}  // namespace crosscheck
