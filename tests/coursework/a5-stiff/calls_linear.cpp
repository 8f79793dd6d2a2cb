// Calls of solve. Their input is n, `a` (n x n, by rows), `b` (n).
//   linear.solve       the components of x
//   linear.singular    1 if std::domain_error is thrown, 0 if something is returned
#include <stdexcept>

#include "calls.h"
#include "stiff.h"

namespace coursework {

bool answer_linear(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "linear.solve" && call != "linear.singular") return false;
  const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(in[0]);
  Matrix a;
  auto at = in.begin() + 1;
  for (std::ptrdiff_t row = 0; row < n; ++row, at += n) a.emplace_back(at, at + n);
  const Vector b(at, at + n);
  if (call == "linear.solve") {
    out = solve(a, b);
    return true;
  }
  try {
    solve(a, b);
    out = {0};
  } catch (const std::domain_error&) {
    out = {1};
  }
  return true;
}

}  // namespace coursework
