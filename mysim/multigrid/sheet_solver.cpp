#include "mysim/multigrid/sheet_solver.h"

#include <algorithm>
#include <cmath>

namespace crosscheck::multigrid {
namespace {

constexpr int most_iterations = 500;
// smaller ones are solved as fast, or faster, spring by spring
constexpr int fewest_rows = 12, fewest_columns = 20;

}  // namespace

SheetSolver::SheetSolver(const Weave& weave, const std::vector<int>& pins)
    : matrix_(weave, pins),
      u_(matrix_.layout().field<double>()),
      r_(matrix_.layout().field<double>()),
      p_(matrix_.layout().field<double>()),
      q_(matrix_.layout().field<double>()) {}

CgResult SheetSolver::solve(const Eigen::ArrayXd& inertia, const Points& x, Curvature curvature, const Points& b,
                            double tolerance, Points& u) {
  const Functions& f = matrix_.functions();
  matrix_.set(inertia, x, curvature);
  const Matrix<double>& a = matrix_.exact();
  const double size = b.norm();
  CgResult result;
  u.setZero(3, b.cols());
  if ((result.converged = size == 0)) return result;

  // b / |b|: numbers near 1 are far from both ends of what single precision can hold
  matrix_.layout().put(b, 1 / size, r_);
  for (Lines<double>* field : {&u_, &p_, &q_}) std::fill_n(field->data(), field->size(), 0);
  f.narrow(r_.data(), matrix_.b().data(), static_cast<long>(r_.size()));
  double left = 1, rz = 0, keep = 0;
  while (!(result.converged = std::sqrt(left) <= tolerance) && result.iterations < most_iterations) {
    matrix_.cycle();
    double products[2];
    f.overlaps(a, r_.data(), q_.data(), matrix_.u().data(), products);
    ++result.iterations;
    // the preconditioner is rounded in single precision, so that it is not quite the same matrix in each iteration:
    // beta = z.(r - r_before) / (z.r)_before (Polak and Ribiere's) holds directions conjugate all the same
    keep = result.iterations > 1 ? -keep * products[1] / rz : 0;
    rz = products[0];
    f.turn(a, matrix_.u().data(), keep, p_.data());
    const double curved = f.product(a, p_.data(), q_.data());
    if (!(curved > 0)) {
      result.negative_curvature = true;
      break;
    }
    keep = rz / curved;
    left = f.advance(a, keep, p_.data(), q_.data(), u_.data(), r_.data(), matrix_.b().data());
  }
  matrix_.layout().get(u_, size, u);
  return result;
}

std::unique_ptr<SheetSolver> sheet_solver_of(const Model& model) {
  const auto* springs = model.find<Springs>();
  if (!springs || model.find<Dashpots>()) return nullptr;
  const auto weave = strip::weave_of(*springs, model.particles.size());
  if (!weave || weave->rows < fewest_rows || weave->columns < fewest_columns) return nullptr;
  return std::make_unique<SheetSolver>(*weave, model.particles.pins);
}

}  // namespace crosscheck::multigrid
