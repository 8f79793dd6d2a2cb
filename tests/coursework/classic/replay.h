// Finds again what a probe found, from what the student's process says that evalF answered. States and questions are
// drawn here once more: nothing of them is taken from that process.
#pragma once

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

/// The findings of probe/forces.h, which oracles.h reads. `answers` is what probe/ask.h records; empty where it cannot
/// be that, whoever wrote it.
probe::Findings replay(const Case& what, const Numbers& answers);

}  // namespace coursework::classic
