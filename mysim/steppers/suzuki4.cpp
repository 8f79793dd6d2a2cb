// Suzuki's fourth-order composition (M. Suzuki, Phys. Lett. A 146, 1990): five leapfrogs of lengths p, p, 1 - 4p, p, p
// with p = 1 / (4 - 4^(1/3)). The third goes backwards in time; symmetry cancels the error terms of order 3.

#include <cmath>

#include "mysim/steppers/steppers.h"

namespace crosscheck {

KickDriftComposition suzuki4_composition() {
  const double p = 1 / (4 - std::cbrt(4.0));
  return {{p, p, 1 - 4 * p, p, p}};
}

void suzuki4(System& f, State& s, double h, Workspace& w) {
  const double start = s.t;
  // with four passes, velocity-dependent forces break the symmetry by O(h^5), no more than the rule errs per step
  constexpr int passes = 4;
  double done = 0;
  for (const double part : suzuki4_composition().fractions) {
    leapfrog_step(f, s, part * h, passes, w);
    done += part;
    s.t = start + done * h;
    f.model().particles.place_pins(s);
  }
}

}  // namespace crosscheck
