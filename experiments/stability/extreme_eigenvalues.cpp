// The only file that uses Spectra's solvers.
#include "experiments/stability/extreme_eigenvalues.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/MatOp/SparseGenMatProd.h>
#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsShiftSolver.h>
#include <Spectra/SymEigsSolver.h>

namespace crosscheck {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr int most_restarts = 2000;

int subspace(const Sparse& m, int wanted) { return std::min(static_cast<int>(m.rows()), wanted); }

template <class Solver>
bool solved(Solver& solver, Spectra::SortRule which, double tolerance) {
  solver.init();
  solver.compute(which, most_restarts, tolerance);
  return solver.info() == Spectra::CompInfo::Successful;
}

}  // namespace

std::optional<Eigenpair> largest_eigenpair(const Sparse& symmetric, double tolerance) {
  Spectra::SparseSymMatProd<double> product(symmetric);
  Spectra::SymEigsSolver<Spectra::SparseSymMatProd<double>> solver(product, 1, subspace(symmetric, 40));
  if (!solved(solver, Spectra::SortRule::LargestAlge, tolerance)) return std::nullopt;
  return Eigenpair{solver.eigenvalues()[0], solver.eigenvectors().col(0)};
}

std::optional<Eigenpair> eigenpair_above(const Sparse& symmetric, double shift, double tolerance) {
  Spectra::SparseSymShiftSolve<double> inverse(symmetric);
  Spectra::SymEigsShiftSolver<Spectra::SparseSymShiftSolve<double>> solver(inverse, 1, subspace(symmetric, 20), shift);
  if (!solved(solver, Spectra::SortRule::LargestMagn, tolerance)) return std::nullopt;
  return Eigenpair{solver.eigenvalues()[0], solver.eigenvectors().col(0)};
}

std::optional<Eigen::VectorXcd> largest_eigenvalues(const Sparse& square, int count, double tolerance) {
  Spectra::SparseGenMatProd<double> product(square);
  Spectra::GenEigsSolver<Spectra::SparseGenMatProd<double>> solver(product, count, subspace(square, 60));
  if (!solved(solver, Spectra::SortRule::LargestMagn, tolerance)) return std::nullopt;
  return solver.eigenvalues();
}

}  // namespace crosscheck
