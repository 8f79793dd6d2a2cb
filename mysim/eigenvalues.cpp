#include "mysim/eigenvalues.h"

#include <Eigen/Eigenvalues>

#include <limits>

namespace crosscheck {
namespace {

template <class Solver>
auto values_of(const Solver& solver, Eigen::Index n) -> std::decay_t<decltype(solver.eigenvalues())> {
  if (solver.info() == Eigen::Success) return solver.eigenvalues();
  return std::decay_t<decltype(solver.eigenvalues())>::Constant(n, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Eigensystem symmetric_eigensystem(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  return {values_of(solver, symmetric.rows()), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
  return values_of(solver, symmetric.rows());
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& square) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(square, false);
  return values_of(solver, square.rows());
}

}  // namespace crosscheck
