#ifndef CLOTHSYSTEM_H
#define CLOTHSYSTEM_H

#include "Force.h"
#include "particleSystem.h"

class ClothSystem : public ParticleSystem {
 public:
  ClothSystem(int width, int height, float spacing);
  vector<Vector3f> evalF(vector<Vector3f> state) override { return mechanics.derivative(state); }
  void draw() {}

 private:
  Mechanics mechanics;
};

#endif
