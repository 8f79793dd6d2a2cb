#include "reference/truth/exact/elastica.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cassert>
#include <cmath>
#include <numbers>

namespace crosscheck {
namespace {

constexpr int steps = 4000;

template <class Function>
double root_between(double low, double high, Function f) {
  std::uintmax_t iterations = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(52), iterations);
  return (a + b) / 2;
}

}  // namespace

Elastica::Elastica(const ClampedStrip& strip) : strip_(strip) {
  assert(strip.rigidity > 0 && strip.length > 0 && strip.load_at <= strip.length);
  const double hung = strip.weight * strip.length + strip.load,
               level = (strip.weight * strip.length * strip.length / 2 + strip.load * strip.load_at) / strip.rigidity,
               most = 1.001 * std::min(level, std::sqrt(2 * hung / strip.rigidity));
  const auto left = [&](double curvature) { return integrate(curvature, false); };
  double low = most, high = most;
  while (low > 0 && left(low) > 0) high = low, low -= 0.02 * most;
  integrate(low < high ? root_between(low, high, left) : 0, true);
}

void Elastica::advance(const ClampedStrip& strip, double s, double ds, double carried, State& state) {
  boost::numeric::odeint::runge_kutta4<State> rule;
  rule.do_step(
      [&](const State& y, State& rate, double at) {
        rate = {y[1], -(strip.weight * (strip.length - at) + carried) / strip.rigidity * std::cos(y[0]), std::cos(y[0]),
                std::sin(y[0])};
      },
      state, s, ds);
}

double Elastica::integrate(double curvature, bool keep) {
  State state{0, curvature, 0, 0};
  if (keep) s_ = {0}, states_ = {state};
  const double cut = strip_.load > 0 ? strip_.load_at : strip_.length;
  for (const auto& [from, to] : {std::pair{0., cut}, std::pair{cut, strip_.length}}) {
    const int count = static_cast<int>(std::ceil(steps * (to - from) / strip_.length));
    for (int i = 0; i < count; ++i) {
      const double s = from + (to - from) * i / count, ds = (to - from) / count;
      advance(strip_, s, ds, to <= cut ? strip_.load : 0, state);
      if (keep) s_.push_back(i + 1 == count ? to : s + ds), states_.push_back(state);
    }
  }
  return state[1];
}

Elastica::Place Elastica::at(double s) const {
  // one step from the last place before
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  const size_t i = static_cast<size_t>(std::max<std::ptrdiff_t>(after - s_.begin() - 1, 0));
  State state = states_[i];
  const double cut = strip_.load > 0 ? strip_.load_at : strip_.length;
  advance(strip_, s_[i], s - s_[i], s_[i] < cut ? strip_.load : 0, state);
  return {state[2], state[3], state[0]};
}

double vibration_of_clamped_strip(const ClampedStrip& strip, double density, int mode) {
  // the roots lie near odd multiples of pi / 2; divided by cosh, the function stays of the order of 1
  const double near = (mode + 0.5) * std::numbers::pi;
  const double beta = root_between(near - 0.4, near + 0.4, [](double b) { return std::cos(b) + 1 / std::cosh(b); });
  return beta * beta / (2 * std::numbers::pi) * std::sqrt(strip.rigidity / (density * std::pow(strip.length, 4)));
}

}  // namespace crosscheck
