#include "pendulumSystem.h"

#include <GL/glut.h>

PendulumSystem::PendulumSystem(int numParticles) : ParticleSystem(numParticles) {
  for (int i = 0; i < numParticles; ++i) {
    // yours: the initial position and velocity of particle i
    m_vVecState.push_back(Vector3f(0.0f, -0.5f * i, 0.0f));
    m_vVecState.push_back(Vector3f(0.0f));
  }
}

// positions are at even indices of the state, velocities at odd ones
vector<Vector3f> PendulumSystem::evalF(vector<Vector3f> state) {
  vector<Vector3f> f(state.size());
  // yours
  return f;
}

void PendulumSystem::draw() {
  for (int i = 0; i < m_numParticles; ++i) {
    const Vector3f at = m_vVecState[2 * i];
    glPushMatrix();
    glTranslatef(at.x(), at.y(), at.z());
    glutSolidSphere(0.075f, 10, 10);
    glPopMatrix();
  }
}
