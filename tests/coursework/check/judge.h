// Compares an answer with what is right. C++17, standard library only.
#pragma once

#include "case.h"

namespace coursework {

struct Judged {
  bool right = false;
  How how = How::answered;
  bool wrong_size = false;    // another count of numbers than expected
  bool not_finite = false;    // the first number that differs is nan or infinite
  int row = -1, column = -1;  // of the first number that differs; -1: none
  double expected = 0, got = 0;
  double of = 0;  // where the number is a share: how many all are
};

/// Right when every number is finite and within the tolerance, and there are as many as expected. A share is right when
/// it is that of the same count: one less of a thousand is one less.
Judged judge(const Case& what, const Answer& answer);

}  // namespace coursework
