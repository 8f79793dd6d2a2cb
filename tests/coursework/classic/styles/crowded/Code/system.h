// All systems and all steppers in one header, which each source includes only once.
#pragma once

#include <vecmath.h>

#include <string>
#include <vector>

int windDirection();

class ParticleSystem {
 public:
  typedef std::vector<Vector3f> State;
  ParticleSystem(int n = 0) : m_numParticles(n), time(0) {}
  virtual State evalF(State state, float t) = 0;
  State getState() { return m_vVecState; }
  // overwrites the existing entries
  void setState(State s) {
    for (size_t i = 0; i < m_vVecState.size(); i++) m_vVecState[i] = s[i];
  }
  virtual void draw() = 0;
  int m_numParticles;
  float time;

 protected:
  State m_vVecState;
};

class TimeStepper {
 public:
  virtual void takeStep(ParticleSystem* particleSystem, float stepSize) = 0;
};
class ForwardEuler : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};
class Trapezoidal : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};
class RK4 : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};

class SimpleSystem : public ParticleSystem {
 public:
  SimpleSystem() : ParticleSystem(1) { m_vVecState.push_back(Vector3f(1, 0, 0)); }
  State evalF(State state, float t);
  void draw();
};

class PendulumSystem : public ParticleSystem {
 public:
  PendulumSystem(int numParticles = 4);
  State evalF(State state, float t);
  void draw();
};

/// A cloth with a flag for wind, which is not initialised.
class ClothSystem : public ParticleSystem {
 public:
  ClothSystem(int total);
  State evalF(State state, float t);
  void draw();
  bool windy;

 private:
  int side;
};
