// The time steppers. A stepper knows of a system only its state and evalF.
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

/// Not asked of anybody: the grader brings it.
class RK4 : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize);
};

#endif
