// The in-house engine: a stepper, the prescribed pins and the contacts, run over a scene.
#pragma once

#include "mysim/contacts.h"
#include "mysim/steppers/stepper.h"

namespace crosscheck {

/// How mysim computes: on regular cloths reproducible (the same bits with AVX2 and AVX-512), as fast as the machine
/// can, or in single precision; plain is the general engine, whatever the scene.
enum class Precision { reproducible, fastest, single, plain };

struct Execution {
  Precision precision = Precision::reproducible;
  int threads = 1;  // at most: small cloths are stepped by fewer; the same bits, however many
};

/// Runs the scene, at run.step or, where the stepper is adaptive, to run.tolerance. Throws Unsupported with the reason
/// when the stepper does not take the scene.
Outcome simulate(const Stepper& stepper, ContactRule contact, const Scene& scene, const Run& run, Observer& observer,
                 const Execution& execution = {});

}  // namespace crosscheck
