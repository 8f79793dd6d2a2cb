#include "tiny.h"

double twice(double x) {
  return x;  // yours
}
