// The steppers of the newer family; used where a submission does not bring its own header.
#ifndef TIMESTEPPER_H
#define TIMESTEPPER_H

#include "particlesystem.h"

class TimeStepper {
 public:
  virtual ~TimeStepper() {}
  virtual void takeStep(ParticleSystem* particleSystem, float stepSize) = 0;
};

class ForwardEuler : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize) override;
};

class Trapezoidal : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize) override;
};

/// Not asked of anybody: the grader brings it.
class RK4 : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize) override;
};

#endif
