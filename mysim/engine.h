// The in-house engine: a stepper, the prescribed pins and the contacts, run over a scene.
#pragma once

#include "mysim/run.h"
#include "mysim/steppers/stepper.h"

namespace crosscheck {

enum class ContactRule { coulomb, sticky };  // sticky: the assignment's sphere, kept to be shown failing

/// Runs the scene. Throws Unsupported when the stepper does not take the scene's kind of equation.
Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer);

}  // namespace crosscheck
