// Sums of named terms, fitted to a student's numbers.
#pragma once

#include <string>
#include <vector>

#include "tests/coursework/check/case.h"

namespace coursework {

struct NamedTerm {
  std::string name;  // "h k1"
  double right = 0;  // its coefficient in the right sum
};

/// The coefficients of the sum of these columns that is `sum`, by least squares; empty where no sum of them is it to
/// within `tolerance`, or where several are.
Numbers coefficients(const std::vector<Numbers>& columns, const Numbers& sum, double tolerance);

/// "x + h (1/2 k1)": terms whose coefficient is 0 are left out.
std::string sum_text(const std::vector<NamedTerm>& terms, const Numbers& coefficients, double tolerance);

}  // namespace coursework
