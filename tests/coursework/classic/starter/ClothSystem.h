// A square cloth of at least 8 x 8 particles.
#ifndef CLOTHSYSTEM_H
#define CLOTHSYSTEM_H

#include "particleSystem.h"

class ClothSystem : public ParticleSystem {
 public:
  ClothSystem();
  vector<Vector3f> evalF(vector<Vector3f> state);
  void draw();
};

#endif
