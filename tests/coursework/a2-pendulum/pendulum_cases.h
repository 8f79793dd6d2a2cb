#pragma once

#include <cmath>

#include "tests/coursework/a2-pendulum/row_cases.h"

namespace coursework::a2 {

/// Gravity alone, drag alone, the spring alone, with a mass of 1 kg.
inline std::vector<Case> single_force_cases(Random& random) {
  std::vector<Case> cases;
  for (int force = 0; force < 3; ++force) {
    Row row = random_row(random, 2, Members::equal);
    if (force != 0) row.gravity.setZero();
    if (force != 1) row.drag = 0;
    if (force != 2) row.stiffness[0] = 0;
    cases.push_back(pendulum_case(row, random_state(random, row)));
  }
  return cases;
}

inline std::vector<Case> all_forces_cases(Random& random) {
  std::vector<Case> cases;
  for (int i = 0; i < 2; ++i) {
    const Row row = random_row(random, 2, Members::equal);
    cases.push_back(pendulum_case(row, random_state(random, row)));
  }
  return cases;
}

inline std::vector<Case> mass_cases(Random& random) {
  const Row row = random_row(random, 2, Members::different);
  Row heavier = row;
  heavier.mass[1] *= 3;
  const auto state = random_state(random, row);
  return {pendulum_case(row, state), pendulum_case(heavier, state)};
}

inline std::vector<Case> pendulum_twice_cases(Random& random) {
  const Row row = random_row(random, 2, Members::equal);
  return {twice_case("pendulum.twice", pendulum_numbers(row), row, random)};
}

inline std::vector<Case> pendulum_fixed_cases(Random& random) { return fixed_cases(random, 2); }

/// x, y, z of particle 1 and the energy after each step.
inline Found path_and_energy(const Case& c, const Numbers& raw) {
  if (raw.size() != c.expected.size() / 4 * 6) return raw;
  Row row;
  row.gravity = Vector(c.in[0], c.in[1], c.in[2]);
  row.mass = {1, c.in[4]}, row.stiffness = {c.in[5]}, row.rest = {c.in[6]};
  const Vector anchor(c.in[9], c.in[10], c.in[11]);
  Numbers reduced;
  for (std::size_t k = 0; k + 5 < raw.size(); k += 6) {
    const Vector x(raw[k], raw[k + 1], raw[k + 2]), v(raw[k + 3], raw[k + 4], raw[k + 5]);
    put(x, reduced);
    reduced.push_back(row.energy({{anchor, Vector::Zero()}, {x, v}}));
  }
  return reduced;
}

/// A swing in the x-y plane without drag, advanced by RK4. The expected path is that of RK4 with the energy's gradient;
/// the expected energy is the initial energy. RK4 dissipates (omega h)^6 / 72 of the spring energy in each step. The
/// tolerance is ten times the sum over all steps, because the spring's length oscillates, too.
inline std::vector<Case> swing_cases(Random& random) {
  const std::size_t steps = 120;
  Row row;
  row.gravity = Vector(0, -random.uniform(3, 10), 0);
  row.mass = {1, random.uniform(1.5, 3)};
  row.stiffness = {row.mass[1] * random.uniform(40, 60)}, row.rest = {random.uniform(0.8, 1.2)};
  const double h = 0.01, omega = std::sqrt(row.stiffness[0] / row.mass[1]), angle = random.uniform(0.6, 1);
  const Vector anchor = random_vector(random, 1);
  std::vector<Motion> state{{anchor, Vector::Zero()},
                            {anchor + row.rest[0] * Vector(std::sin(angle), -std::cos(angle), 0), Vector::Zero()}};
  Case c{"pendulum.swing", pendulum_numbers(row), {}, 4, 0, "step", "swing", 0, 1, h};
  c.in.insert(c.in.end(), {static_cast<double>(steps), h});
  put(state, c.in);
  const double energy = row.energy(state);
  c.tolerance = 10 * steps * std::pow(omega * h, 6) / 72 * row.mass[1] * row.gravity.norm() * row.rest[0];
  const auto moved = [](std::vector<Motion> from, double by, const std::vector<Motion>& rate) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i].x += by * rate[i].x, from[i].v += by * rate[i].v;
    return from;
  };
  for (std::size_t k = 0; k < steps; ++k) {
    const auto k1 = row.derivative(state), k2 = row.derivative(moved(state, h / 2, k1)),
               k3 = row.derivative(moved(state, h / 2, k2)), k4 = row.derivative(moved(state, h, k3));
    state = moved(moved(moved(moved(state, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    put(state[1].x, c.expected), c.expected.push_back(energy);
  }
  return {c};
}

}  // namespace coursework::a2
