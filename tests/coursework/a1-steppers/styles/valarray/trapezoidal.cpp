// With std::valarray, which has the operators that std::vector lacks.
#include <valarray>

#include "steppers.h"

using Array = std::valarray<double>;
static Array to_array(const State& x) { return Array(x.data(), x.size()); }
static State to_state(const Array& x) { return State(std::begin(x), std::end(x)); }

State trapezoidal_step(const Derivative& f, double t, const State& x, double h) {
  const Array start = to_array(x), f0 = to_array(f(t, x));
  const Array f1 = to_array(f(t + h, to_state(start + h * f0)));
  const Array mean = (f0 + f1) / 2.0;
  return to_state(start + h * mean);
}
