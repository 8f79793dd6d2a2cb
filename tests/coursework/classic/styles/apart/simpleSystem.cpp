#include "simpleSystem.h"

#include <GL/glut.h>

SimpleSystem::SimpleSystem() : ParticleSystem(1) { m_vVecState.push_back(Vector3f(1.0f, 0.0f, 0.0f)); }

vector<Vector3f> SimpleSystem::evalF(vector<Vector3f> state) {
  vector<Vector3f> f;
  for (size_t i = 0; i < state.size(); ++i) f.push_back(Vector3f(-state[i].y(), state[i].x(), 0.0f));
  return f;
}

void SimpleSystem::draw() {
  glPushMatrix();
  glTranslatef(m_vVecState[0].x(), m_vVecState[0].y(), m_vVecState[0].z());
  glutSolidSphere(0.075f, 10, 10);
  glPopMatrix();
}
