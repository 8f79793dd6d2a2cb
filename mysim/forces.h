// Where the terms add their forces.
#pragma once

#include "mysim/types.h"

namespace crosscheck {

struct Forces {
  Points f;             // N (3 x n)
  long coincident = 0;  // springs met at zero length: their direction is undefined, they get zero force

  void clear() {
    f.setZero();
    coincident = 0;
  }
};

}  // namespace crosscheck
