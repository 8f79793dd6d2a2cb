// For hand-outs of assignments whose tests compare and draw the answers themselves, without extracting features.
#include "calls.h"

namespace coursework {

Found compared(const Case&, const Numbers& answered) { return answered; }

std::string asked_and_came(const Texts&, const Case&, const Numbers&) { return ""; }

bool motion_of(const std::string&, Case&, Numbers&) { return false; }

}  // namespace coursework
