// A wind that comes and goes: the same acceleration for every particle, a smooth function of time alone.
#pragma once

#include <array>
#include <optional>

#include "mysim/forces.h"
#include "mysim/particles.h"
#include "mysim/section.h"

namespace crosscheck {

/// A smooth random signal: sum of a few sines with seeded frequencies and phases, between -1 and 1.
struct Gust {
  struct Wave {
    double weight, omega, phase;  // 1, rad/s, rad; the weights add up to 1
  };
  std::array<Wave, 4> waves;

  Gust(int seed, int channel);  // the same on every machine
  double at(double t) const;
};

/// a(t) = mean (1 + variation g1(t)) + side g2(t), with g1 and g2 independent gusts.
struct Wind {
  static constexpr std::string_view name = "wind";
  Vec3 mean;  // m/s^2
  struct Gusts {
    double variation;  // 1
    Vec3 side;         // m/s^2
    int seed;
    Gust along, across;
  };
  std::optional<Gusts> gusts;  // none: a steady wind
};

Wind read_wind(const Section& s);
Vec3 acceleration_at(const Wind& wind, double t);  // m/s^2
void add_force(const Wind& wind, const Particles& particles, const State& state, Forces& forces);

}  // namespace crosscheck
