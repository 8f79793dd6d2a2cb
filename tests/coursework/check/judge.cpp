// Number by number, row after row.
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
    // written so that nan on either side is never within the tolerance
    if (std::isfinite(answer.got[i]) && std::abs(answer.got[i] - what.expected[i]) <= what.tolerance) continue;
    const int columns = what.columns > 0 ? what.columns : 1;
    result.not_finite = !std::isfinite(answer.got[i]);
    result.row = static_cast<int>(i) / columns;
    result.column = static_cast<int>(i) % columns;
    result.expected = what.expected[i];
    result.got = answer.got[i];
    return result;
  }
  result.right = true;
  return result;
}

}  // namespace coursework
