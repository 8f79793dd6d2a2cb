#include "ClothSystem.h"

#include <GL/glut.h>

ClothSystem::ClothSystem() {
  // yours: create the particles, row by row, and the springs between them; so far there is only one particle at rest
  m_vVecState.push_back(Vector3f(0.0f));
  m_vVecState.push_back(Vector3f(0.0f));
}

vector<Vector3f> ClothSystem::evalF(vector<Vector3f> state) {
  vector<Vector3f> f(state.size());
  // yours
  return f;
}

void ClothSystem::draw() {
  // yours: draw lines between neighbours
}
