// Wind that varies smoothly in time, and its simplest force: the same acceleration for every particle.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

/// A smooth random signal in [-1, 1]: a sum of sines with seeded frequencies and phases.
struct Gust {
  struct Wave {
    double weight, omega, phase;  // dimensionless, rad/s, rad; the weights add up to 1
  };
  std::array<Wave, 4> waves;

  Gust(int seed, int channel);  // identical on every machine
  double at(double t) const;
};

/// w(t) = mean (1 + variation g1(t)) + side g2(t), with independent gusts g1 and g2; same unit as the mean.
struct WindSignal {
  Vec3 mean;
  struct Gusts {
    double variation;  // 1
    Vec3 side;
    int seed;
    Gust along, across;
  };
  std::optional<Gusts> gusts;  // default: steady wind

  Vec3 at(double t) const;
};

struct Wind {
  static constexpr std::string_view name = "wind";
  WindSignal acceleration;  // m/s^2
};

void add_force(const Wind& wind, const Particles& particles, const State& state, Forces& forces);

}  // namespace crosscheck
