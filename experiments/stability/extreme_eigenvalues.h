// The outermost eigenvalues of sparse matrices, by the Lanczos and Arnoldi iterations of Spectra.
#pragma once

#include <Eigen/SparseCore>

#include <optional>

namespace crosscheck {

struct Eigenpair {
  double value;
  Eigen::VectorXd vector;  // of length 1
};

/// Of a symmetric matrix, each to `tolerance` (relative); nothing where the iteration did not converge.
std::optional<Eigenpair> largest_eigenpair(const Eigen::SparseMatrix<double>& symmetric, double tolerance);

/// The eigenvalue nearest to `shift` of a symmetric matrix with all of them above it.
std::optional<Eigenpair> eigenpair_above(const Eigen::SparseMatrix<double>& symmetric, double shift, double tolerance);

/// Of any square matrix, the `count` of largest modulus; a pair of conjugates counts as two.
std::optional<Eigen::VectorXcd> largest_eigenvalues(const Eigen::SparseMatrix<double>& square, int count,
                                                    double tolerance);

}  // namespace crosscheck
