// Finds again what a probe found, from what the student's process says that evalF answered. States and questions are
// drawn here once more: nothing of them is taken from that process.
#pragma once

#include "tests/coursework/check/case.h"

namespace coursework::classic {

/// The numbers of probe/forces.h that oracles.h reads. `answers` is what probe/ask.h records; empty where it cannot be
/// that, whoever wrote it.
Numbers replay(const Case& what, const Numbers& answers);

}  // namespace coursework::classic
