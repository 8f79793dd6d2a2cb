// Compares an answer with the expected one. C++17, standard library only.
#pragma once

#include "case.h"

namespace coursework {

struct Judged {
  bool right = false;
  How how = How::answered;
  bool wrong_size = false;    // the count of numbers differs from the expected one
  bool not_finite = false;    // the first number that differs is nan or infinite
  int row = -1, column = -1;  // position of the first number that differs; -1: none
  double expected = 0, got = 0;
  double of = 0;  // denominator, if the number is a share
};

/// Right if there are as many numbers as expected, each finite and within the tolerance. A share is right if its count
/// equals the expected one: one missing out of a thousand is an error.
Judged judge(const Case& what, const Answer& answer);

}  // namespace coursework
