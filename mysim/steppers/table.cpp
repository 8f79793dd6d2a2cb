// The table of steppers.
#include "mysim/steppers/stepper.h"

namespace crosscheck {

std::span<const Stepper> steppers() {
  static constexpr Stepper table[] = {
      {"explicit-euler", explicit_euler, 1, 1, true, false,
       "forward Euler; unstable without drag at any step, shown as the warning it is"},
      {"trapezoidal", trapezoidal, 2, 2, true, false, "explicit trapezoidal rule (Heun); unstable without drag"},
      {"rk4", rk4, 4, 4, true, false, "classic Runge-Kutta; stable on springs for h omega < 2.83"},
      {"symplectic-euler", symplectic_euler, 1, 1, false, true,
       "kick, then drift; stable for h omega < 2; the rule of Bullet's explicit deformable world"},
      {"leapfrog", leapfrog, 2, 1, false, true,
       "half drift, kick, half drift; stable for h omega < 2; the best value for one evaluation a step"},
  };
  return table;
}

}  // namespace crosscheck
