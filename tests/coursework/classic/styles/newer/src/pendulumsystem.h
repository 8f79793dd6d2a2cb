#pragma once

#include <utility>

#include "particlesystem.h"

class PendulumSystem : public ParticleSystem {
 public:
  PendulumSystem();
  std::vector<Vector3f> evalF(std::vector<Vector3f> state) override;
  void draw(GLProgram&) override;
};
