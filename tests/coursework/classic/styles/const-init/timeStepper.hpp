#ifndef TIME_STEPPER
#define TIME_STEPPER
#include "particlesystem.h"

class TimeStepper
{
public:
    virtual void takeStep(ParticleSystem* particleSystem, float stepSize) const = 0;
};

class ForwardEuler : public TimeStepper
{
    void takeStep(ParticleSystem* particleSystem, float stepSize) const;
};

class Trapzoidal : public TimeStepper
{
    void takeStep(ParticleSystem* particleSystem, float stepSize) const;
};
#endif
