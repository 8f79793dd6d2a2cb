// Prescribed motion of pins and spheres.
#pragma once

#include "mysim/types.h"

namespace crosscheck {

/// Prescribed motion, of all pins together or of a sphere: displacement d(t) = amplitude r(t) sin(2 pi frequency t),
/// where the ramp r rises from 0 to 1 in the first `ramp` seconds as 6 s^5 - 15 s^4 + 10 s^3 (twice continuously
/// differentiable).
struct Motion {
  Vec3 amplitude;    // m
  double frequency;  // Hz
  double ramp;       // s
};

/// A bound of |d'(t)|, m/s: |amplitude| (omega + 15/8 / ramp), 15/8 being the ramp's steepest slope.
double top_speed(const Motion& motion);
Vec3 displacement_at(const Motion& motion, double t);  // m
Vec3 velocity_at(const Motion& motion, double t);      // m/s, the derivative of displacement_at

}  // namespace crosscheck
