#pragma once

#include "particlesystem.h"

class SimpleSystem : public ParticleSystem {
 public:
  SimpleSystem();
  std::vector<Vector3f> evalF(std::vector<Vector3f> state) override;
  void draw(GLProgram&) override;
};
