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
  // one step from the last stored state before s
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  const size_t i = static_cast<size_t>(std::max<std::ptrdiff_t>(after - s_.begin() - 1, 0));
  State state = states_[i];
  const double cut = strip_.load > 0 ? strip_.load_at : strip_.length;
  advance(strip_, s_[i], s - s_[i], s_[i] < cut ? strip_.load : 0, state);
  return {state[2], state[3], state[0]};
}

namespace {

using HangingState = std::array<double, 4>;

/// The hinges pull the strip, so it rises from its middle towards them by less than a right angle.
constexpr double most_angle = std::numbers::pi / 2;

/// Integrates half of a hanging strip, in units of the half's length: theta'' = pull sin theta - weight s cos theta,
/// with theta'(0) = curvature. Returns the initial state and the state after each step. Stops after the first state
/// whose angle is negative or exceeds a right angle.
std::vector<HangingState> hanging_states(double pull, double weight, double curvature) {
  boost::numeric::odeint::runge_kutta4<HangingState> rule;
  HangingState state{0, curvature, 0, 0};
  std::vector<HangingState> all{state};
  for (int i = 0; i < steps; ++i) {
    rule.do_step(
        [&](const HangingState& y, HangingState& rate, double s) {
          rate = {y[1], pull * std::sin(y[0]) - weight * s * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])};
        },
        state, static_cast<double>(i) / steps, 1. / steps);
    all.push_back(state);
    if (state[0] < 0 || state[0] > most_angle) break;
  }
  return all;
}

/// The smallest theta'(0) > 0 at which the moment at the hinge vanishes. With theta'(0) = 0 the strip bends down. With
/// weight / 2, which is the value for a level beam without pull, it bends up.
double hanging_curvature(double pull, double weight) {
  const auto left = [&](double curvature) {
    const HangingState end = hanging_states(pull, weight, curvature).back();
    return end[0] > most_angle ? 1 : end[0] < 0 ? -1 : end[1];
  };
  double low = 0, high = 0;
  const double most = 0.51 * weight;
  while (high < most && left(high) < 0) low = high, high += 0.02 * most;
  return root_between(low, high, left);
}

}  // namespace

HangingStrip::HangingStrip(double length, double span, double weight, double rigidity) : half_(length / 2) {
  assert(0 < span && span < length && weight > 0 && rigidity >= 0);
  // sinh(u) / u = length / span with u = span / (2 H / w). The root lies below the upper end of the interval, at which
  // sinh(u) / u, about e^u / (2 u), is larger.
  const double ratio = length / span;
  const double u =
      root_between(1e-8, 4 + 2 * std::log(ratio + 1), [&](double at) { return std::sinh(at) / at - ratio; });
  const double catenary = span / (2 * u);
  if (rigidity == 0) {
    catenary_ = catenary;
    return;
  }
  const double unit = half_ * half_ / rigidity, carried = weight * half_ * unit;
  const auto too_wide = [&](double pull) {
    return hanging_states(pull, carried, hanging_curvature(pull, carried)).back()[2] - span / length;
  };
  assert(too_wide(0) < 0);
  const double pull = root_between(0, 3 * weight * catenary * unit, too_wide);
  states_ = hanging_states(pull, carried, hanging_curvature(pull, carried));
}

HangingStrip::Place HangingStrip::at(double s) const {
  const double from_middle = std::abs(s), side = s < 0 ? -1 : 1;
  if (states_.empty())
    return {side * catenary_ * std::asinh(from_middle / catenary_), std::hypot(catenary_, from_middle) - catenary_};
  // continues from the preceding stored state along a straight line, at the curve's angle halfway to s; the error is of
  // third order in the step
  const double at = from_middle / half_ * steps;
  const size_t i = std::min<size_t>(static_cast<size_t>(at), states_.size() - 1);
  const double ds = (at - static_cast<double>(i)) / steps;
  const auto& [angle, curvature, x, height] = states_[i];
  const double between = angle + curvature * ds / 2;
  return {side * half_ * (x + ds * std::cos(between)), half_ * (height + ds * std::sin(between))};
}

double vibration_of_clamped_strip(const ClampedStrip& strip, double density, int mode) {
  // the roots lie near odd multiples of pi / 2; division by cosh keeps the function of order 1
  const double near = (mode + 0.5) * std::numbers::pi;
  const double beta = root_between(near - 0.4, near + 0.4, [](double b) { return std::cos(b) + 1 / std::cosh(b); });
  return beta * beta / (2 * std::numbers::pi) * std::sqrt(strip.rigidity / (density * std::pow(strip.length, 4)));
}

}  // namespace crosscheck
