// With std::valarray, which has the operators that std::vector lacks.
#include <valarray>

#include "steppers.h"

using Array = std::valarray<double>;
static Array to_array(const State& x) { return Array(x.data(), x.size()); }
static State to_state(const Array& x) { return State(std::begin(x), std::end(x)); }

State euler_step(const Derivative& f, double t, const State& x, double h) {
  return to_state(to_array(x) + h * to_array(f(t, x)));
}
