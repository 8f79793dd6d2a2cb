#ifndef PENDULUMSYSTEM_H
#define PENDULUMSYSTEM_H

#include "Force.h"
#include "particleSystem.h"

class PendulumSystem : public ParticleSystem {
 public:
  PendulumSystem(int numParticles, float stiffness, bool holdFirst);
  vector<Vector3f> evalF(vector<Vector3f> state) { return mechanics.derivative(state); }
  void draw() {}

 private:
  Mechanics mechanics;
};

#endif
