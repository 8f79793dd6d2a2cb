// Random networks of springs, with a choice of other ingredients.
#pragma once

#include <Eigen/Geometry>

#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {

struct Network {
  Model model;
  State state;
};

/// Six particles at random places, at least 0.3 m apart, all connected to each other, with random masses.
inline Network random_network(unsigned seed, SpringLaw law = SpringLaw::hooke) {
  Random random(seed);
  const int n = 6;
  Network net;
  Particles& p = net.model.particles;
  p.mass.resize(n);
  p.pinned.assign(n, 0);
  net.state.x.resize(3, n);
  net.state.v.resize(3, n);
  for (int i = 0; i < n; ++i) {
    p.mass[i] = random.between(0.1, 2);
    net.state.v.col(i) = random.vector();
    double nearest = 0;
    while (nearest < 0.3) {
      net.state.x.col(i) = random.vector();
      nearest = INFINITY;
      for (int j = 0; j < i; ++j) nearest = std::min(nearest, (net.state.x.col(i) - net.state.x.col(j)).norm());
    }
  }
  Springs springs{{}, law};
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      springs.list.push_back({a, b, random.between(1, 100), random.between(0, 2), Family::single});
  net.model.terms.emplace_back(springs);
  net.model.terms.emplace_back(Gravity{10 * random.vector()});
  return net;
}

inline WindSignal gusty(int seed) {
  return {{3, 0, 1}, WindSignal::Gusts{0.8, {0, 2, 0}, seed, Gust(seed, 1), Gust(seed, 2)}};
}

inline Dashpots random_dashpots(unsigned seed, const Network& net) {
  Random random(seed + 1000);
  Dashpots dashpots;
  for (const Spring& s : net.model.find<Springs>()->list) dashpots.list.push_back({s.a, s.b, random.between(0.1, 2)});
  return dashpots;
}

/// Bending stencils: two with three particles each, one with the four particles of a cell, and one with five.
inline Bending random_bending(unsigned seed) {
  Random random(seed + 4000);
  const auto k = [&] { return random.between(1, 5); };
  return {{{3, {0, 1, 2}, {1, -2, 1}, k()},
           {3, {4, 2, 0}, {0.5, 1, -1.5}, k()},
           {4, {1, 2, 4, 5}, {1, -1, -1, 1}, k()},
           {5, {0, 1, 2, 3, 5}, {1, 1, -4, 1, 1}, k()}},
          0};
}

inline Aerodynamics random_air(unsigned seed) {
  return {1.2, 1.5, gusty(static_cast<int>(seed)), {{0, 1, 2}, {2, 3, 4}, {1, 4, 5}, {5, 3, 0}}};
}

inline void pin(Network& net, std::vector<int> pins, std::optional<Motion> motion) {
  Particles& p = net.model.particles;
  p.pins = std::move(pins);
  p.pin_home.resize(3, static_cast<int>(p.pins.size()));
  for (size_t i = 0; i < p.pins.size(); ++i) {
    p.pinned[p.pins[i]] = 1;
    p.pin_home.col(static_cast<int>(i)) = net.state.x.col(p.pins[i]);
  }
  p.move = motion;
  p.place_pins(net.state);
}

/// A random network with bending, drag, dashpots and gusts; the first and the fourth particle are moved.
inline Network busy_network(unsigned seed, SpringLaw law = SpringLaw::hooke) {
  Network net = random_network(seed, law);
  Random random(seed + 2000);
  Eigen::VectorXd c(net.model.particles.size());
  for (double& each : c) each = random.between(0.1, 3);
  const Dashpots dashpots = random_dashpots(seed, net);
  net.model.terms.emplace_back(random_bending(seed));
  net.model.terms.emplace_back(dashpots);
  net.model.terms.emplace_back(Drag{c});
  net.model.terms.emplace_back(Wind{gusty(static_cast<int>(seed))});
  net.state.t = random.between(0, 2);
  pin(net, {0, 3}, Motion{0.2 * random.vector(), 0.7, 0.5});
  return net;
}

/// A scene that starts in the network's state, at t = 0.
inline Scene scene_of(const Network& net) {
  Scene scene{};
  scene.name = "network";
  scene.model = net.model;
  scene.start = net.state;
  scene.start.t = 0;
  scene.model.particles.place_pins(scene.start);
  scene.duration = 1, scene.samples = 10, scene.step = 1e-3, scene.window = 1, scene.tolerance = 1e-3;
  return scene;
}

template <class T>
Points force_of(const T& term, const Network& net) {
  Forces forces{Points::Zero(3, net.model.particles.size())};
  add_force(term, net.model.particles, net.state, forces);
  return forces.f;
}
template <class T>
Points force_of(const Model& model, const State& state) {
  return force_of(*model.find<T>(), Network{model, state});
}

inline Eigen::Matrix3d random_turn(Random& random) {
  const double angle = random.between(0, 6);
  return Eigen::AngleAxisd(angle, random.vector().normalized()).toRotationMatrix();
}

}  // namespace crosscheck::testing_tools
