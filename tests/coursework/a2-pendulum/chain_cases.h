#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/coursework/a2-pendulum/row_cases.h"

namespace coursework::a2 {

/// The standard chain: four particles of 1 kg, three equal springs.
inline std::vector<Case> four_cases(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    const Row row = random_row(random, 4, Members::equal);
    cases.push_back(chain_case(row, random_state(random, row)));
  }
  return cases;
}

/// The fixed particle and a free one, with gravity alone, drag alone, a spring alone; then three particles with springs
/// alone.
inline std::vector<Case> small_chain_cases(Random& random) {
  std::vector<Case> cases;
  for (int force = 0; force < 4; ++force) {
    const std::size_t n = force == 3 ? 3 : 2;
    Row row = random_row(random, n, Members::different);
    if (force != 0) row.gravity.setZero();
    if (force != 1) row.drag = 0;
    if (force < 2) row.stiffness.assign(n - 1, 0);
    cases.push_back(chain_case(row, random_state(random, row)));
  }
  return cases;
}

inline std::vector<Case> length_cases(Random& random) {
  std::vector<Case> cases;
  for (const std::size_t n : {2, 3, 5, 8}) {
    const Row row = random_row(random, n, Members::different);
    cases.push_back(chain_case(row, random_state(random, row)));
  }
  return cases;
}

/// Sum of m a over the free particles, and sum of the moments of m a about the fixed particle.
inline Found total_force_and_moment(const Case& c, const Numbers& raw) {
  const std::size_t n = static_cast<std::size_t>(c.in[0]), state = 5 + n + 2 * (n - 1);
  if (raw.size() != 6 * n) return raw;
  const auto vector = [](const Numbers& from, std::size_t at) { return Vector(from[at], from[at + 1], from[at + 2]); };
  Vector force = Vector::Zero(), moment = Vector::Zero();
  for (std::size_t i = 1; i < n; ++i) {
    const Vector push = c.in[5 + i] * vector(raw, 6 * i + 3);
    force += push;
    moment += (vector(c.in, state + 6 * i) - vector(c.in, state)).cross(push);
  }
  Numbers reduced;
  put(force, reduced), put(moment, reduced);
  return reduced;
}

/// By the third law only external forces remain: gravity, drag, and the first spring, which pulls towards the fixed
/// particle and so has no moment about it.
inline std::vector<Case> third_law_cases(Random& random) {
  std::vector<Case> cases;
  for (const std::size_t n : {3, 6}) {
    const Row row = random_row(random, n, Members::different);
    const auto state = random_state(random, row);
    Case c = chain_case(row, state);
    c.columns = 3, c.row = "total", c.column = "total", c.expected.clear();
    // sums of n forces, whose lever arms are at most n springs of 2 m
    c.tolerance = round_off(largest_acceleration) * 2 * static_cast<double>(n * n);
    const Vector d = state[1].x - state[0].x;
    Vector force = -row.stiffness[0] * (d.norm() - row.rest[0]) * d.normalized(), moment = Vector::Zero();
    for (std::size_t i = 1; i < n; ++i) {
      const Vector outside = row.mass[i] * row.gravity - row.drag * state[i].v;
      force += outside;
      moment += (state[i].x - state[0].x).cross(outside);
    }
    put(force, c.expected), put(moment, c.expected);
    cases.push_back(c);
  }
  return cases;
}

/// In equilibrium, each spring is stretched by the weight below it, divided by its stiffness. The second case displaces
/// the last particle further down. This changes only the forces on the last two particles, along the line, by the last
/// spring's stiffness times the displacement.
inline std::vector<Case> hanging_cases(Random& random) {
  const std::size_t n = 5;
  const Row row = random_row(random, n, Members::different);
  const Vector down = row.gravity.normalized();
  std::vector<Motion> state(n, {random_vector(random, 1), Vector::Zero()});
  for (std::size_t i = 1; i < n; ++i) {
    double below = 0;
    for (std::size_t j = i; j < n; ++j) below += row.mass[j];
    const double extension = below * row.gravity.norm() / row.stiffness[i - 1];
    state[i].x = state[i - 1].x + (row.rest[i - 1] + extension) * down;
  }
  Case at_rest = chain_case(row, state);
  at_rest.expected.assign(6 * n, 0);
  const double pulled = random.uniform(0.1, 0.4), force = row.stiffness[n - 2] * pulled;
  state[n - 1].x += pulled * down;
  Case released = chain_case(row, state);
  released.expected.assign(6 * n, 0);
  for (int c = 0; c < 3; ++c) {
    released.expected[6 * (n - 1) + 3 + c] = -force / row.mass[n - 1] * down[c];
    released.expected[6 * (n - 2) + 3 + c] = force / row.mass[n - 2] * down[c];
  }
  return {at_rest, released};
}

/// n equal free masses on equal springs in a line, one end fixed, one free. In mode j, particle i is displaced by
/// sin((2 j - 1) i pi / (2 n + 1)), and its acceleration is -omega_j^2 times this displacement, with
/// omega_j = 2 sqrt(k / m) sin((2 j - 1) pi / (4 n + 2)).
inline std::vector<Case> mode_cases(Random& random) {
  const std::size_t n = static_cast<std::size_t>(random.integer(4, 6));
  Row row;
  const double mass = random.uniform(1.5, 3), stiffness = random.uniform(10, 60), rest = random.uniform(0.8, 1.2);
  row.mass.assign(n + 1, mass), row.stiffness.assign(n, stiffness), row.rest.assign(n, rest);
  const Vector along = random_direction(random), anchor = random_vector(random, 1);
  std::vector<Case> cases;
  for (std::size_t j = 1; j <= n; ++j) {
    const double angle = (2. * static_cast<double>(j) - 1) * std::numbers::pi / (2. * static_cast<double>(n) + 1);
    const double omega = 2 * std::sqrt(stiffness / mass) * std::sin(angle / 2), size = random.uniform(0.1, 0.3);
    std::vector<Motion> state;
    Numbers expected;
    for (std::size_t i = 0; i <= n; ++i) {
      const double shift = size * std::sin(angle * static_cast<double>(i));
      state.push_back({anchor + (rest * static_cast<double>(i) + shift) * along, Vector::Zero()});
      put(Vector::Zero(), expected), put(-omega * omega * shift * along, expected);
    }
    Case c = chain_case(row, state);
    c.expected = expected;
    cases.push_back(c);
  }
  return cases;
}

inline std::vector<Case> chain_twice_cases(Random& random) {
  const Row row = random_row(random, 4, Members::equal);
  return {twice_case("chain.twice", chain_numbers(row), row, random)};
}

inline std::vector<Case> chain_fixed_cases(Random& random) { return fixed_cases(random, 4); }

}  // namespace coursework::a2
