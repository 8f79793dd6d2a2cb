// Particles one below the other on springs; the first one is fixed. With two it is a pendulum, with more a chain.
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
