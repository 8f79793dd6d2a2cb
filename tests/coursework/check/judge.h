#pragma once

#include "case.h"

namespace coursework {

struct Judged {
  bool right = false;
  How how = How::answered;
  bool wrong_size = false;    // the answer has more or fewer numbers than expected
  bool not_finite = false;    // the first number that differs is nan or infinite
  int row = -1, column = -1;  // position of the first number that differs, or -1
  double expected = 0, got = 0;
  double of = 0;  // denominator, if the number is a fraction
};

/// An answer is right if it has as many numbers as expected, each finite and within the tolerance. A fraction is right
/// if its numerator equals the expected one: 999 instead of 1000 out of 1000 is an error.
Judged judge(const Case& what, const Answer& answer);

}  // namespace coursework
