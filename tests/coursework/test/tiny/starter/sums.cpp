#include "tiny.h"

std::vector<double> sums(const std::vector<double>& numbers) {
  return numbers;  // yours
}
