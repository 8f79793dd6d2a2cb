// For the hand-outs of assignments whose right answers are numbers themselves.
#include "calls.h"

namespace coursework {

Numbers compared(const Case&, const Numbers& answered) { return answered; }

}  // namespace coursework
