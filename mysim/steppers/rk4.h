// The classic fourth-order Runge-Kutta rule, for any right-hand side.
#pragma once

#include "mysim/types.h"

namespace crosscheck {

/// Advances s.x and s.v from s.t by h. derivative(stage, rate) writes dX/dt; k holds the four rates.
template <class Derivative>
void rk4_step(Derivative derivative, State& s, double h, State* const (&k)[4], State& stage) {
  auto at = [&](double c, const State& rate) -> State& {
    stage.t = s.t + c * h;
    stage.x = s.x + c * h * rate.x;
    stage.v = s.v + c * h * rate.v;
    return stage;
  };
  auto& [k1, k2, k3, k4] = k;
  derivative(s, *k1);
  derivative(at(0.5, *k1), *k2);
  derivative(at(0.5, *k2), *k3);
  derivative(at(1, *k3), *k4);
  s.x += h / 6 * (k1->x + 2 * k2->x + 2 * k3->x + k4->x);
  s.v += h / 6 * (k1->v + 2 * k2->v + 2 * k3->v + k4->v);
}

}  // namespace crosscheck
