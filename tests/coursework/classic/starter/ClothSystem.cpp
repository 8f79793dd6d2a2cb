#include "ClothSystem.h"

#include <GL/glut.h>

ClothSystem::ClothSystem() {
  // yours: the particles, row after row, and the springs between them; one particle at rest stands for them so far
  m_vVecState.push_back(Vector3f(0.0f));
  m_vVecState.push_back(Vector3f(0.0f));
}

vector<Vector3f> ClothSystem::evalF(vector<Vector3f> state) {
  vector<Vector3f> f(state.size());
  // yours
  return f;
}

void ClothSystem::draw() {
  // yours: lines between neighbours
}
