#include "pendulumSystem.h"

#include <GL/glut.h>

namespace {

const float mass = 0.5f;        // kg
const float gravity = 9.8f;     // m/s^2
const float drag = 0.3f;        // N s/m
const float stiffness = 40.0f;  // N/m
const float length = 0.6f;      // m, rest length of a spring

}  // namespace

PendulumSystem::PendulumSystem(int numParticles) : ParticleSystem(numParticles) {
  for (int i = 0; i < numParticles; ++i) {
    m_vVecState.push_back(Vector3f(0.8f * length * i, -0.6f * length * i, 0.0f));
    m_vVecState.push_back(Vector3f(0.0f));
  }
}

// positions are at even indices of the state, velocities at odd ones
vector<Vector3f> PendulumSystem::evalF(vector<Vector3f> state) {
  const int n = m_numParticles;
  vector<Vector3f> force(n);
  for (int i = 0; i < n; ++i) {
    force[i] += Vector3f(0.0f, -mass * gravity, 0.0f);
    force[i] -= drag * state[2 * i + 1];
  }
  for (int i = 0; i + 1 < n; ++i) {
    const Vector3f d = state[2 * i + 2] - state[2 * i];
    const Vector3f pull = stiffness * (d.abs() - length) * d.normalized();
    force[i] += pull;
    force[i + 1] -= pull;
  }
  force[0] = Vector3f(0.0f);
  vector<Vector3f> f(state.size());
  for (int i = 0; i < n; ++i) {
    f[2 * i] = state[2 * i + 1];
    f[2 * i + 1] = force[i] / mass;
  }
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
