// Tests of gravity, drag and one spring.
#pragma once

#include "tests/coursework/a2-pendulum/energy.h"

namespace coursework::a2 {

/// Particles with seeded masses and seeded vectors g, none of which is along an axis.
inline std::vector<Case> gravity_cases(Random& random) {
  Case c{"gravity", {5}, {}, 3, round_off(100), "particle", "force"};
  for (int i = 0; i < 5; ++i) {
    const double mass = random.uniform(2, 6);
    const Vector g = random.uniform(1, 12) * random_direction(random);
    c.in.push_back(mass), put(g, c.in), put(mass * g, c.expected);
  }
  return {c};
}

/// Drag on moving particles; the last one is at rest.
inline std::vector<Case> drag_cases(Random& random) {
  Case c{"drag", {5}, {}, 3, round_off(100), "particle", "force"};
  for (int i = 0; i < 5; ++i) {
    const double drag = random.uniform(0.2, 0.8);
    const Vector v = (i == 4 ? 0 : random.uniform(2, 6)) * random_direction(random);
    c.in.push_back(drag), put(v, c.in), put(-drag * v, c.expected);
  }
  return {c};
}

inline void add_spring(double stiffness, double rest, const Vector& a, const Vector& b, Case& c) {
  c.in.insert(c.in.end(), {stiffness, rest});
  put(a, c.in), put(b, c.in);
}

/// Springs along the x axis: stretched, then shortened. The force is the product of stiffness and stretch.
inline std::vector<Case> straight_spring_cases(Random& random) {
  std::vector<Case> cases;
  for (const double sign : {1., -1.}) {
    Case c{"spring", {3}, {}, 3, round_off(1000), "end", "force"};
    for (int i = 0; i < 3; ++i) {
      const double stiffness = random.uniform(5, 60), rest = random.uniform(1.2, 2);
      const double stretch = sign * random.uniform(0.2, 0.8), at = random.uniform(-2, 2);
      const double side = random.integer(0, 1) ? 1 : -1;
      add_spring(stiffness, rest, {at + side * (rest + stretch), 0, 0}, {at, 0, 0}, c);
      put({-side * stiffness * stretch, 0, 0}, c.expected);
      put({side * stiffness * stretch, 0, 0}, c.expected);
    }
    cases.push_back(c);
  }
  return cases;
}

/// Springs in any direction. The expected forces on both ends are minus the gradient of the energy.
inline std::vector<Case> spring_cases(Random& random) {
  Case c{"spring", {6}, {}, 3, round_off(1000), "end", "force"};
  for (int i = 0; i < 6; ++i) {
    Row row;
    row.mass = {1, 1}, row.stiffness = {random.uniform(5, 60)}, row.rest = {random.uniform(1.2, 2)};
    const double stretch = (i % 2 ? 1 : -1) * random.uniform(0.2, 0.8);
    const Vector a = random_vector(random, 2), b = a + (row.rest[0] + stretch) * random_direction(random);
    const Vector still = Vector::Zero();
    add_spring(row.stiffness[0], row.rest[0], a, b, c);
    for (const Vector& slope : row.gradient({{a, still}, {b, still}})) put(-slope, c.expected);
  }
  return {c};
}

/// Special springs: unstretched; with rest length zero (the force is stiffness times distance); with coincident ends;
/// and with ends that are a fraction of a millimetre apart, near the origin.
inline std::vector<Case> special_spring_cases(Random& random) {
  Case at_rest{"spring", {2}, Numbers(12), 3, 0, "end", "force"};
  Case no_rest{"spring", {2}, {}, 3, round_off(1000), "end", "force"};
  Case meeting{"spring", {2}, Numbers(12), 3, round_off(1000), "end", "force"};
  Case near{"spring", {2}, {}, 3, round_off(1000), "end", "force"};
  for (int i = 0; i < 2; ++i) {
    const double stiffness = random.uniform(5, 60), rest = random.uniform(1, 2);
    const Vector a = random_vector(random, 2), along = random_direction(random);
    add_spring(stiffness, rest, a, a + rest * along, at_rest);
    const Vector d = random.uniform(0.5, 2) * along;
    add_spring(stiffness, 0, a, a - d, no_rest);
    put(-stiffness * d, no_rest.expected), put(stiffness * d, no_rest.expected);
    add_spring(stiffness, rest, a, a, meeting);
    const double apart = random.uniform(2e-4, 6e-4);
    add_spring(stiffness, rest, apart * a, apart * (a - along), near);
    put(-stiffness * (apart - rest) * along, near.expected), put(stiffness * (apart - rest) * along, near.expected);
  }
  at_rest.tolerance = round_off(1000);
  return {at_rest, no_rest, meeting, near};
}

}  // namespace coursework::a2
