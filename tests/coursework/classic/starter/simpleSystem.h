// One point that runs around the origin: x' = (-y, x, 0).
#ifndef SIMPLESYSTEM_H
#define SIMPLESYSTEM_H

#include "particleSystem.h"

class SimpleSystem : public ParticleSystem {
 public:
  SimpleSystem();
  vector<Vector3f> evalF(vector<Vector3f> state);
  void draw();
};

#endif
