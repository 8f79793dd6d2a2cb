#pragma once

#include <map>
#include <utility>

#include "particlesystem.h"

class ClothSystem : public ParticleSystem {
 public:
  ClothSystem();
  std::vector<Vector3f> evalF(std::vector<Vector3f> state) override;
  void draw(GLProgram&) override;
  void toggleWind() { wind = !wind; }

 private:
  bool wind = false;
};
