// Particles that hang on springs, one below the other; the first one is fixed. Two form a pendulum, more form a chain.
#ifndef PENDULUMSYSTEM_H
#define PENDULUMSYSTEM_H

#include "particleSystem.h"

class PendulumSystem : public ParticleSystem {
 public:
  PendulumSystem(int numParticles);
  vector<Vector3f> evalF(vector<Vector3f> state);
  void draw();
};

#endif
