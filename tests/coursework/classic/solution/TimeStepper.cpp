#include "TimeStepper.hpp"

void ForwardEuler::takeStep(ParticleSystem* particleSystem, float stepSize) {
  vector<Vector3f> x = particleSystem->getState();
  const vector<Vector3f> f = particleSystem->evalF(x);
  for (size_t i = 0; i < x.size(); ++i) x[i] += stepSize * f[i];
  particleSystem->setState(x);
}

void Trapzoidal::takeStep(ParticleSystem* particleSystem, float stepSize) {
  const float h = stepSize;
  const vector<Vector3f> x = particleSystem->getState();
  const vector<Vector3f> f0 = particleSystem->evalF(x);
  vector<Vector3f> ahead = x;
  for (size_t i = 0; i < x.size(); ++i) ahead[i] = x[i] + h * f0[i];
  const vector<Vector3f> f1 = particleSystem->evalF(ahead);
  vector<Vector3f> next = x;
  for (size_t i = 0; i < x.size(); ++i) next[i] = x[i] + h / 2.0f * (f0[i] + f1[i]);
  particleSystem->setState(next);
}
