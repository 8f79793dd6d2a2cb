// The table of amplification matrices. With g = drag + dashpot, every rule is applied to u' = v,
// v' = push - w2 u - g v; rows stand for what a step adds to u and to v, as multiples of (u, v, 1).
#include <cmath>

#include "reference/exact/discrete.h"

namespace crosscheck {
namespace {

using Row = Eigen::RowVector3d;

const Row v(0, 1, 0);

Eigen::Matrix3d system_of(const Mode& m) {
  Eigen::Matrix3d a;
  a << 0, 1, 0, -m.w2, -(m.drag + m.dashpot), m.push, 0, 0, 0;
  return a;
}

Increment rows(const Row& u_gains, const Row& v_gains) {
  Increment e = Increment::Zero();
  e.row(0) = u_gains;
  e.row(1) = v_gains;
  return e;
}

/// Runge-Kutta rules multiply by the Taylor polynomial of exp(h A) of their order, up to order 4.
template <int order>
Increment taylor(const Eigen::Matrix3d& a, double h) {
  Increment sum = Increment::Zero(), term = Increment::Identity();
  for (int i = 1; i <= order; ++i) {
    term = term * a * (h / i);
    sum += term;
  }
  return sum;
}
template <int order>
Increment taylor_of_mode(const Mode& m, double h) {
  return taylor<order>(system_of(m), h);
}

/// v += h a(u, v), then u += h v.
Increment symplectic_euler(const Mode& m, double h) {
  const Row gain = h * system_of(m).row(1);
  return rows(h * (v + gain), gain);
}

/// u_m = u + h v / 2; the kick takes drag at the mean of old and new velocity; dashpots act at v in the first pass and
/// at the mean with what the pass before gave in the later ones; u' = u_m + h v' / 2.
template <int passes>
Increment leapfrog(const Mode& m, double h) {
  const Row force(-m.w2, -m.w2 * h / 2, m.push);
  Row gain = Row::Zero();
  for (int pass = 0; pass < passes; ++pass)
    gain = h * (force - m.dashpot * (v + gain / 2) - m.drag * v) / (1 + h * m.drag / 2);
  return rows(h * v + h / 2 * gain, gain);
}

/// One after the other: (I + then)(I + first) - I.
Increment composed(const Increment& first, const Increment& then) { return first + then + then * first; }

/// Leapfrogs of p h, p h, (1 - 4 p) h, p h, p h, p = 1 / (4 - 4^(1/3)).
Increment suzuki4(const Mode& m, double h) {
  const double p = 1 / (4 - std::cbrt(4.0));
  const Increment outer = leapfrog<4>(m, p * h), pair = composed(outer, outer);
  return composed(composed(pair, leapfrog<4>(m, (1 - 4 * p) * h)), pair);
}

/// v' = v + h (push - w2 u' - g v'), u' = u + h v', solved for what v gains.
Increment implicit_euler(const Mode& m, double h) {
  const double g = m.drag + m.dashpot;
  const Row gain = h * Row(-m.w2, -g - h * m.w2, m.push) / (1 + h * g + h * h * m.w2);
  return rows(h * (v + gain), gain);
}

/// The middle is an implicit Euler step of h / 2, and the end lies as far beyond it.
Increment implicit_midpoint(const Mode& m, double h) { return 2 * implicit_euler(m, h / 2); }

/// A free step with implicit drag, the dashpot's share of it, then the spring's correction of the position, u measured
/// from the unstretched length. Without a dashpot this is implicit Euler.
Increment xpbd(const Mode& m, double h) {
  const Row flown = h * Row(0, -(m.drag + m.dashpot), m.push) / (1 + h * (m.drag + m.dashpot));
  const double s = h * h * m.w2 / (1 + h * m.drag);
  const Row correction = -s / (1 + s) * (Row(1, 0, 0) + h * (v + flown));
  return rows(h * (v + flown) + correction, flown + correction / h);
}

}  // namespace

std::span<const DiscreteRule> discrete_rules() {
  static constexpr DiscreteRule table[] = {
      {"explicit-euler", taylor_of_mode<1>, taylor<1>},
      {"trapezoidal", taylor_of_mode<2>, taylor<2>},
      {"rk4", taylor_of_mode<4>, taylor<4>},
      {"symplectic-euler", symplectic_euler, nullptr},
      {"leapfrog", leapfrog<2>, nullptr},
      {"suzuki4", suzuki4, nullptr},
      {"implicit-euler", implicit_euler, nullptr},
      {"implicit-midpoint", implicit_midpoint, nullptr},
      {"xpbd", xpbd, nullptr, true},
  };
  return table;
}

Increment repeated(Increment e, long n) {
  Increment power = Increment::Zero();
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) power = composed(power, e);
    e = composed(e, e);
  }
  return power;
}

}  // namespace crosscheck
