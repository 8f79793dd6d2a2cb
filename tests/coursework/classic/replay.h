// Recomputes a probe's findings from the answers of evalF that the student's process recorded. States and questions are
// drawn again here: none are taken from that process.
#pragma once

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

/// The findings of probe/forces.h for oracles.h. `answers` is a record in the format of probe/ask.h, possibly forged;
/// empty findings if it is malformed.
probe::Findings replay(const Case& what, const Numbers& answers);

}  // namespace coursework::classic
