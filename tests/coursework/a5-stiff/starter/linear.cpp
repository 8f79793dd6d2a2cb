// A small dense system of linear equations.
#include "stiff.h"

Vector solve(Matrix a, Vector b) {
  (void)a;   // delete this line when you use it
  return b;  // yours
}
