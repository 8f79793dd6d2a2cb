#include "tests/coursework/grader/fit.h"

#include <Eigen/QR>
#include <cmath>

#include "tests/coursework/check/params.h"

namespace coursework {

Numbers coefficients(const std::vector<Numbers>& columns, const Numbers& sum, double tolerance) {
  using Eigen::MatrixXd, Eigen::VectorXd;
  const auto vector = [](const Numbers& all) {
    return Eigen::Map<const VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  };
  MatrixXd unit(sum.size(), columns.size());
  VectorXd size(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].size() != sum.size()) return {};
    const auto at = static_cast<Eigen::Index>(k);
    size[at] = vector(columns[k]).norm();
    if (!(size[at] > 0)) return {};
    unit.col(at) = vector(columns[k]) / size[at];
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr(unit);
  qr.setThreshold(1e-6);
  const VectorXd found = qr.solve(vector(sum));
  if (qr.rank() < unit.cols() || !((unit * found - vector(sum)).cwiseAbs().maxCoeff() <= tolerance)) return {};
  const VectorXd scaled = found.cwiseQuotient(size);
  return {scaled.begin(), scaled.end()};
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
