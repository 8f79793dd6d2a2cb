#include "System.h"

#include <GL/glut.h>

#include <cmath>
#include <iostream>

using namespace std;

void ForwardEuler::takeStep(ParticleSystem* s, float h) {
  ParticleSystem::State x = s->getState(), f = s->evalF(x, s->time);
  for (size_t i = 0; i < x.size(); i++) x[i] += f[i] * h;
  s->setState(x);
  s->time += h;
}

void Trapezoidal::takeStep(ParticleSystem* s, float h) {
  ParticleSystem::State x = s->getState(), f0 = s->evalF(x, s->time), y = x;
  for (size_t i = 0; i < x.size(); i++) y[i] = x[i] + f0[i] * h;
  ParticleSystem::State f1 = s->evalF(y, s->time + h);
  for (size_t i = 0; i < x.size(); i++) x[i] += (f0[i] + f1[i]) * h / 2;
  s->setState(x);
  s->time += h;
}

ParticleSystem::State SimpleSystem::evalF(State state, float) {
  State f;
  for (const Vector3f& x : state) f.push_back(Vector3f(-x[1], x[0], 0));
  return f;
}
void SimpleSystem::draw() { glutSolidCube(1); }

PendulumSystem::PendulumSystem(int n) : ParticleSystem(n) {
  for (int i = 0; i < n; i++) m_vVecState.push_back(Vector3f(0, -i, 0)), m_vVecState.push_back(Vector3f());
}
ParticleSystem::State PendulumSystem::evalF(State state, float) {
  State f(state.size());
  for (int i = 1; i < m_numParticles; i++) {
    Vector3f pull = state[2 * i].pulledTo(state[2 * i - 2], 0.8f);
    if (i + 1 < m_numParticles) pull += state[2 * i].pulledTo(state[2 * i + 2], 0.8f);
    f[2 * i] = state[2 * i + 1];
    f[2 * i + 1] = 120 * pull + Vector3f(0, -9.8f, 0) - state[2 * i + 1];
  }
  cerr << "pendulum " << f.size() << endl;
  return f;
}
void PendulumSystem::draw() { glutSolidSphere(0.1, 10, 10); }

ClothSystem::ClothSystem(int total) : ParticleSystem(total), side(int(sqrt(double(total)) + 0.5)) {
  for (int i = 0; i < total; i++)
    m_vVecState.push_back(Vector3f(i % side, -(i / side), 0)), m_vVecState.push_back(Vector3f());
}
ParticleSystem::State ClothSystem::evalF(State state, float) {
  State f(state.size());
  for (int i = 0; i < side; i++)
    for (int j = 0; j < side; j++) {
      Vector3f sum = Vector3f(0, -9.8f, 0) - 0.7f * state[2 * (i * side + j) + 1];
      if (windy) sum += Vector3f(0, 0, rand() % 10 * windDirection());
      for (int u = max(0, i - 2); u <= min(side - 1, i + 2); u++)
        for (int v = max(0, j - 2); v <= min(side - 1, j + 2); v++) {
          int d = (u - i) * (u - i) + (v - j) * (v - j);
          if (d == 1 || d == 2 || d == 4)
            sum += 90 * state[2 * (i * side + j)].pulledTo(state[2 * (u * side + v)], sqrt(float(d)));
        }
      f[2 * (i * side + j)] = state[2 * (i * side + j) + 1];
      f[2 * (i * side + j) + 1] = sum;
    }
  for (int j = 0; j < side; j += side - 1) f[2 * j] = f[2 * j + 1] = Vector3f();
  return f;
}
void ClothSystem::draw() {
  gluCylinder(gluNewQuadric(), 1, 1, 1, 8, 8);
  glutSolidDodecahedron();
}
