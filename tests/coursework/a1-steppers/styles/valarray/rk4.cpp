// With std::valarray; the slopes are multiplied by h at once, as many books do.
#include <valarray>

#include "steppers.h"

using Array = std::valarray<double>;
static Array to_array(const State& x) { return Array(x.data(), x.size()); }
static State to_state(const Array& x) { return State(std::begin(x), std::end(x)); }

State rk4_step(const Derivative& f, double t, const State& x, double h) {
  const Array start = to_array(x);
  auto change = [&](double part, const Array& by) {
    return Array(h * to_array(f(t + part * h, to_state(start + part * by))));
  };
  const Array a = h * to_array(f(t, x)), b = change(0.5, a), c = change(0.5, b), d = change(1.0, c);
  return to_state(start + a / 6.0 + b / 3.0 + c / 3.0 + d / 6.0);
}
