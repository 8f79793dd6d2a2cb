// Seeded pendulums and chains, and the calls that both parts share.
#pragma once

#include "tests/coursework/a2-pendulum/energy.h"

namespace coursework::a2 {

inline Numbers pendulum_numbers(const Row& row) {
  Numbers in;
  put(row.gravity, in);
  in.insert(in.end(), {row.drag, row.mass[1], row.stiffness[0], row.rest[0]});
  return in;
}

inline Numbers chain_numbers(const Row& row) {
  Numbers in{static_cast<double>(row.size())};
  put(row.gravity, in);
  in.push_back(row.drag);
  for (const auto& some : {row.mass, row.stiffness, row.rest}) in.insert(in.end(), some.begin(), some.end());
  return in;
}

/// Bound on accelerations (m/s^2): forces below 200 N over masses above 0.2 kg.
inline constexpr double largest_acceleration = 1000;

/// n particles with all forces. Either all masses are 1 kg and all springs equal, or all are different.
enum class Members { equal, different };
inline Row random_row(Random& random, std::size_t n, Members members) {
  Row row;
  row.gravity = random.uniform(2, 10) * random_direction(random);
  row.drag = random.uniform(0.3, 1);
  row.mass.assign(n, 1), row.stiffness.assign(n - 1, random.uniform(10, 60)), row.rest.assign(n - 1, 0.6);
  for (std::size_t i = 0; members == Members::different && i < n; ++i) {
    row.mass[i] = random.integer(0, 1) ? random.uniform(0.2, 0.7) : random.uniform(1.5, 4);
    if (i + 1 < n) row.stiffness[i] = random.uniform(10, 60), row.rest[i] = random.uniform(0.4, 0.9);
  }
  return row;
}

/// Random positions and velocities, with springs between half and twice their rest length; the fixed particle does not
/// move.
inline std::vector<Motion> random_state(Random& random, const Row& row) {
  std::vector<Motion> state{{random_vector(random, 1), Vector::Zero()}};
  for (std::size_t i = 1; i < row.size(); ++i) {
    const double stretch = random.integer(0, 1) ? random.uniform(0.5, 0.8) : random.uniform(1.3, 2);
    const Vector x = state[i - 1].x + stretch * row.rest[i - 1] * random_direction(random);
    state.push_back({x, random.uniform(1, 2) * random_direction(random)});
  }
  return state;
}

/// Case of one derivative. `head` holds the numbers before the state: gravity, drag, masses and springs.
inline Case derivative_case(const char* call, Numbers head, const Row& row, const std::vector<Motion>& state) {
  Case c{call, head, {}, 6, round_off(largest_acceleration), "particle", "rate"};
  put(state, c.in);
  put(row.derivative(state), c.expected);
  return c;
}
inline Case pendulum_case(const Row& row, const std::vector<Motion>& state) {
  return derivative_case("pendulum", pendulum_numbers(row), row, state);
}
inline Case chain_case(const Row& row, const std::vector<Motion>& state) {
  return derivative_case("chain", chain_numbers(row), row, state);
}

/// Case that asks for the derivative at A, at B and again at A, and for the argument A after the calls.
inline Case twice_case(const char* call, Numbers head, const Row& row, Random& random) {
  const int numbers = 6 * static_cast<int>(row.size());
  Case c{call, head, {}, numbers, round_off(largest_acceleration), "try", "rates"};
  const std::vector<Motion> a = random_state(random, row), b = random_state(random, row);
  put(a, c.in), put(b, c.in);
  for (const auto& state : {a, b, a}) put(row.derivative(state), c.expected);
  put(a, c.expected);
  return c;
}

/// States that give the fixed particle a velocity: its rates must still be zero.
inline std::vector<Case> fixed_cases(Random& random, std::size_t n) {
  const Row row = random_row(random, n, Members::equal);
  auto state = random_state(random, row);
  state[0].v = random.uniform(1, 2) * random_direction(random);
  return {n == 2 ? pendulum_case(row, state) : chain_case(row, state)};
}

}  // namespace coursework::a2
