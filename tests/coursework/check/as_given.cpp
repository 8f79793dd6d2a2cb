// For the hand-outs of assignments whose right answers, and curves, are the numbers of their tests.
#include "calls.h"

namespace coursework {

Found compared(const Case&, const Numbers& answered) { return answered; }

bool motion_of(const std::string&, Case&, Numbers&) { return false; }

}  // namespace coursework
