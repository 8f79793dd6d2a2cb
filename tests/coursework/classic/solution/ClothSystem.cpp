#include "ClothSystem.h"

#include <GL/glut.h>

#include <cmath>

namespace {

const int rows = 9, columns = 8;
const float spacing = 0.25f;                                     // m
const float mass = 0.1f;                                         // kg, of a particle
const float gravity = 9.8f;                                      // m/s^2
const float drag = 0.08f;                                        // N s/m
const float structural = 60.0f, shear = 30.0f, flexion = 20.0f;  // N/m

int indexOf(int row, int column) { return row * columns + column; }

}  // namespace

ClothSystem::ClothSystem() : ParticleSystem(rows * columns) {
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      m_vVecState.push_back(Vector3f(spacing * column, 1.0f - spacing * row, 0.0f));
      m_vVecState.push_back(Vector3f(0.0f));
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      connect(row, column, 0, 1, structural);
      connect(row, column, 1, 0, structural);
      connect(row, column, 1, 1, shear);
      connect(row, column, 1, -1, shear);
      connect(row, column, 0, 2, flexion);
      connect(row, column, 2, 0, flexion);
    }
}

void ClothSystem::connect(int row, int column, int downward, int sideward, float k) {
  const int r = row + downward, c = column + sideward;
  if (r >= rows || c < 0 || c >= columns) return;
  const float rest = spacing * std::sqrt(float(downward * downward + sideward * sideward));
  const Spring spring = {indexOf(row, column), indexOf(r, c), k, rest};
  m_springs.push_back(spring);
}

vector<Vector3f> ClothSystem::evalF(vector<Vector3f> state) {
  const int n = rows * columns;
  vector<Vector3f> force(n);
  for (int i = 0; i < n; ++i) {
    force[i] += Vector3f(0.0f, -mass * gravity, 0.0f);
    force[i] -= drag * state[2 * i + 1];
  }
  for (size_t s = 0; s < m_springs.size(); ++s) {
    const Spring& spring = m_springs[s];
    const Vector3f d = state[2 * spring.b] - state[2 * spring.a];
    const Vector3f pull = spring.k * (d.abs() - spring.rest) * d.normalized();
    force[spring.a] += pull;
    force[spring.b] -= pull;
  }
  force[indexOf(0, 0)] = Vector3f(0.0f);
  force[indexOf(0, columns - 1)] = Vector3f(0.0f);
  vector<Vector3f> f(state.size());
  for (int i = 0; i < n; ++i) {
    f[2 * i] = state[2 * i + 1];
    f[2 * i + 1] = force[i] / mass;
  }
  return f;
}

void ClothSystem::draw() {
  glBegin(GL_LINES);
  for (size_t s = 0; s < m_springs.size(); ++s) {
    glVertex3fv(m_vVecState[2 * m_springs[s].a]);
    glVertex3fv(m_vVecState[2 * m_springs[s].b]);
  }
  glEnd();
}
