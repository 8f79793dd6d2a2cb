#include "pendulumSystem.h"

PendulumSystem::PendulumSystem(int numParticles, float stiffness, bool holdFirst) {
  for (int i = 0; i < numParticles; ++i) m_vVecState.push_back(Vector3f(0.0f, -0.4f * i, 0.1f * i));
  m_vVecState.resize(2 * numParticles, Vector3f(0.0f));
  mechanics.add(new Weight(Vector3f(0, -9.8f, 0)));
  mechanics.add(new Viscosity(0.4f));
  // each link consists of two springs of half the stiffness
  for (int i = 1; i < numParticles; ++i)
    for (int half = 0; half < 2; ++half) mechanics.add(new Hooke(i - half, i - 1 + half, 25 * stiffness, 0.3f));
  mechanics.hold(holdFirst ? 0 : numParticles - 1);
}
