// The run loop that both Bullet worlds share.
#pragma once

#include "mysim/run.h"

namespace crosscheck::bullet {

/// One Bullet world with its scene in it.
class World {
 public:
  virtual ~World() = default;
  virtual void step(double t, double t_next) = 0;  // advances from t to t_next, pins included
  virtual void read_state(double t, State& state) const = 0;
  virtual Readback read_back() = 0;
};

/// Steps the world over the run, reading the certificate's data back after the first step.
Outcome drive(World& world, const Scene& scene, const Run& run, Observer& observer);

}  // namespace crosscheck::bullet
