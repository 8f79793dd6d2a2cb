#include "TimeStepper.hpp"

void ForwardEuler::takeStep(ParticleSystem* particleSystem, float stepSize) {
  // yours
}

void Trapzoidal::takeStep(ParticleSystem* particleSystem, float stepSize) {
  // yours
}
