// The steppers of the newer version of the course, for submissions without this header.
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

/// Not part of the assignment: the grader provides it.
class RK4 : public TimeStepper {
  void takeStep(ParticleSystem* particleSystem, float stepSize) override;
};

#endif
