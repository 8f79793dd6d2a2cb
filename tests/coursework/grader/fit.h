// Fits sums of named terms to a student's numbers.
#pragma once

#include <string>
#include <vector>

#include "tests/coursework/check/case.h"

namespace coursework {

struct NamedTerm {
  std::string name;  // "h k1"
  double right = 0;  // the term's coefficient in the correct sum
};

/// Coefficients of the linear combination of the columns that equals `sum`, by least squares. Empty if no combination
/// is within `tolerance`, or if it is not unique.
Numbers coefficients(const std::vector<Numbers>& columns, const Numbers& sum, double tolerance);

/// Text such as "x + h (1/2 k1)"; omits terms with zero coefficients.
std::string sum_text(const std::vector<NamedTerm>& terms, const Numbers& coefficients, double tolerance);

}  // namespace coursework
