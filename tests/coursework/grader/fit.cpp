// Least squares by successive orthogonalisation of the columns.
#include "tests/coursework/grader/fit.h"

#include <algorithm>
#include <cmath>

#include "tests/coursework/check/params.h"

namespace coursework {
namespace {

double dot(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

Numbers coefficients(const std::vector<Numbers>& columns, const Numbers& sum, double tolerance) {
  const std::size_t n = columns.size();
  std::vector<Numbers> q, r(n, Numbers(n, 0.0));
  for (std::size_t k = 0; k < n; ++k) {
    if (columns[k].size() != sum.size()) return {};
    Numbers rest = columns[k];
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t j = 0; j < k; ++j) {
        const double part = dot(q[j], rest);
        r[j][k] += part;
        for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= part * q[j][i];
      }
    const double size = std::sqrt(dot(rest, rest));
    if (!(size > 1e-6 * std::sqrt(dot(columns[k], columns[k])))) return {};
    for (double& value : rest) value /= size;
    r[k][k] = size, q.push_back(rest);
  }
  Numbers found(n), rest = sum;
  for (std::size_t k = n; k-- > 0;) {
    found[k] = dot(q[k], sum);
    for (std::size_t j = k + 1; j < n; ++j) found[k] -= r[k][j] * found[j];
    found[k] /= r[k][k];
  }
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (std::size_t k = 0; k < n; ++k) rest[i] -= found[k] * columns[k][i];
  for (const double value : rest)
    if (!(std::abs(value) <= tolerance)) return {};
  return found;
}

std::string sum_text(const std::vector<NamedTerm>& terms, const Numbers& coefficients, double tolerance) {
  std::string text;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double value = coefficients[k];
    if (std::abs(value) <= tolerance) continue;
    const std::string factor = named_number(std::abs(value), tolerance, {}, {});
    text += text.empty() ? (value < 0 ? "-" : "") : value < 0 ? " - " : " + ";
    text += factor == "1" ? terms[k].name : factor + " " + terms[k].name;
  }
  return text.empty() ? "0" : text;
}

}  // namespace coursework
