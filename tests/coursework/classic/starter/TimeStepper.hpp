// The time steppers. They use only the state and evalF of a system.
#ifndef TIMESTEPPER_H
#define TIMESTEPPER_H

#include <vecmath.h>

#include <vector>

#include "particleSystem.h"

class TimeStepper {
 public:
  virtual ~TimeStepper() {}
  virtual void takeStep(ParticleSystem* particleSystem, float stepSize) = 0;
};

class ForwardEuler : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};

class Trapzoidal : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};

/// Not part of the assignment: the grader provides it.
class RK4 : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};

#endif
