// Base class of all systems. You need not change it.
#ifndef PARTICLESYSTEM_H
#define PARTICLESYSTEM_H

#include <vecmath.h>

#include <vector>

using namespace std;

class ParticleSystem {
 public:
  ParticleSystem(int numParticles = 0);
  virtual ~ParticleSystem() {}

  int m_numParticles;

  /// The derivative of `state`: X' = f(X).
  virtual vector<Vector3f> evalF(vector<Vector3f> state) = 0;

  vector<Vector3f> getState() { return m_vVecState; }
  void setState(const vector<Vector3f>& newState) { m_vVecState = newState; }

  virtual void draw() = 0;

 protected:
  vector<Vector3f> m_vVecState;
};

#endif
