// Limits from polynomials. For the trapezoidal rule, |R|^2 - 1 is a cubic in h if the solution oscillates; otherwise
// the limit is h |lambda| = 2. For RK4, Newton's method on |R|^2 - 1 with a numerical slope finds the limit.
#include <cmath>
#include <complex>

#include "stiff.h"

static double fast(double w, double g) { return (g + std::sqrt(g * g - 4 * w * w)) / 2; }

static double excess(double w, double g, double h) {
  const std::complex<double> z(-h * g / 2, h * std::sqrt(w * w - g * g / 4));
  return std::norm(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))) - 1;
}

double largest_stable_step(Rule rule, double w, double g) {
  if (rule == Rule::implicit_euler || (w == 0 && g == 0)) return INFINITY;
  const bool swings = g < 2 * w;
  switch (rule) {
    case Rule::explicit_euler:
      return swings ? g / (w * w) : 2 / fast(w, g);
    case Rule::trapezoidal: {
      if (!swings) return 2 / fast(w, g);
      double low = 0, high = 4 / w;
      for (int i = 0; i < 200; ++i) {
        const double h = (low + high) / 2;
        (-g + h * g * g / 2 - h * h * g * w * w / 2 + h * h * h * w * w * w * w / 4 < 0 ? low : high) = h;
      }
      return g == 0 ? 0 : low;
    }
    case Rule::rk4: {
      // -2.785... is the real root of 24 + 12 z + 4 z^2 + z^3
      if (!swings) return 2.785293563405282 / fast(w, g);
      // the iteration starts above the limit
      double h = 3.2 / w;
      for (int i = 0; i < 100; ++i) {
        const double e = 1e-6 * h, slope = (excess(w, g, h + e) - excess(w, g, h - e)) / (2 * e);
        h -= excess(w, g, h) / slope;
      }
      return h;
    }
    case Rule::symplectic_euler:
      // g h + (w h)^2 / 2 = 2, without the cancellation of the usual formula
      return 4 / (g + std::hypot(g, 2 * w));
    default:
      return w > 0 ? 2 / w : INFINITY;
  }
}
