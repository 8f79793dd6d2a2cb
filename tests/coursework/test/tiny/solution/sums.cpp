#include "tiny.h"

std::vector<double> sums(const std::vector<double>& numbers) {
  std::vector<double> result;
  double sum = 0;
  for (double x : numbers) {
    sum += twice(x) / 2;
    result.push_back(sum);
  }
  return result;
}
