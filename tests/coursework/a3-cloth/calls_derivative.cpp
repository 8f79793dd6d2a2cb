// Calls of part 5. A cloth is encoded as the number of particles, masses, number of pins, pins, springs, triangles,
// gravity, drag and wind; a state as its positions, then its velocities.
#include "calls_read.h"
#include "states.h"

namespace coursework {
namespace {

Cloth read_cloth(Reader& in) {
  Cloth cloth;
  cloth.mass = in.numbers(in.integer());
  for (int left = in.integer(); left > 0; --left) cloth.pins.push_back(in.integer());
  cloth.springs = read_springs(in);
  cloth.triangles = read_triangles(in);
  cloth.gravity = in.vector<Vec3>();
  cloth.drag = in.number();
  cloth.wind = read_wind(in);
  return cloth;
}

void need(const State& rate, const State& state) {
  if (rate.x.size() != state.x.size() || rate.v.size() != state.v.size())
    throw Unusable("rates", {rate.x.size(), state.x.size()});
}

void put_rates(Numbers& out, const std::vector<State>& rates) {
  for (std::size_t i = 0; i < rates[0].x.size(); ++i)
    for (const State& rate : rates) {
      put(out, rate.x[i]);
      put(out, rate.v[i]);
    }
}

State moved(State state, const State& rate, double h) {
  need(rate, state);
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    state.x[i] += h * rate.x[i];
    state.v[i] += h * rate.v[i];
  }
  return state;
}

/// The explicit trapezoidal rule of assignment 1.
State trapezoidal(const Cloth& cloth, const State& state, double t, double h) {
  const State first = derivative(cloth, state, t);
  const State second = derivative(cloth, moved(state, first, h), t + h);
  return moved(moved(state, first, h / 2), second, h / 2);
}

}  // namespace

/// derivative (cloth, state, t): x' and v' of each particle.
/// derivative_again (cloth, state, other, t): x' and v' at `state`, at `other`, and again at `state`.
/// cloth_path (cloth, state, h, steps, watched): position of the watched particle after each step.
/// cloth_end (cloth, state, h, steps): positions of all particles after the last step.
bool answer_derivative(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "derivative" && call != "derivative_again" && call != "cloth_path" && call != "cloth_end") return false;
  Reader reader(in);
  const Cloth cloth = read_cloth(reader);
  State state = read_state<State>(reader, cloth.mass.size());
  if (call == "derivative") {
    const State rate = derivative(cloth, state, reader.number());
    need(rate, state);
    put_rates(out, {rate});
    return true;
  }
  if (call == "derivative_again") {
    const State other = read_state<State>(reader, cloth.mass.size());
    const double t = reader.number();
    const State before = derivative(cloth, state, t);
    const State between = derivative(cloth, other, t);
    const State after = derivative(cloth, state, t);
    for (const State* rate : {&before, &between, &after}) need(*rate, state);
    put_rates(out, {before, between, after});
    return true;
  }
  const double h = reader.number();
  const int steps = reader.integer();
  const int watched = call == "cloth_path" ? reader.integer() : -1;
  for (int n = 0; n < steps; ++n) {
    state = trapezoidal(cloth, state, n * h, h);
    if (watched >= 0) put(out, state.x.at(watched));
  }
  if (watched < 0) put(out, state.x);
  return true;
}

}  // namespace coursework
