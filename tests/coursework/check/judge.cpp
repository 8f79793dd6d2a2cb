#include "judge.h"

#include <cmath>

namespace coursework {

Judged judge(const Case& what, const Answer& answer) {
  Judged result;
  result.how = answer.how;
  if (answer.how != How::answered) return result;
  if (answer.got.size() != what.expected.size()) {
    result.wrong_size = true;
    result.expected = static_cast<double>(what.expected.size());
    result.got = static_cast<double>(answer.got.size());
    return result;
  }
  for (std::size_t i = 0; i < what.expected.size(); ++i) {
    const double of = i < answer.of.size() ? answer.of[i] : 0;
    const double tolerance = of > 0 ? 0.5 / of : what.tolerance;
    // this form also rejects nan on either side
    if (std::isfinite(answer.got[i]) && std::abs(answer.got[i] - what.expected[i]) <= tolerance) continue;
    const int columns = what.columns > 0 ? what.columns : 1;
    result.not_finite = !std::isfinite(answer.got[i]);
    result.row = static_cast<int>(i) / columns;
    result.column = static_cast<int>(i) % columns;
    result.expected = what.expected[i];
    result.got = answer.got[i];
    result.of = of;
    return result;
  }
  result.right = true;
  return result;
}

}  // namespace coursework
