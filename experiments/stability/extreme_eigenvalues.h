// Extreme eigenvalues of sparse matrices, by the Lanczos and Arnoldi iterations of Spectra.
#pragma once

#include <Eigen/SparseCore>

#include <optional>

namespace crosscheck {

struct Eigenpair {
  double value;
  Eigen::VectorXd vector;  // normalised
};

/// Returns nullopt if the iteration does not converge to the relative `tolerance`.
std::optional<Eigenpair> largest_eigenpair(const Eigen::SparseMatrix<double>& symmetric, double tolerance);

/// The smallest eigenvalue of a symmetric matrix and its eigenvector, found as the eigenpair nearest to `shift`. All
/// eigenvalues must be above `shift`.
std::optional<Eigenpair> eigenpair_above(const Eigen::SparseMatrix<double>& symmetric, double shift, double tolerance);

/// The `count` eigenvalues of largest modulus of a general matrix; a conjugate pair counts as two.
std::optional<Eigen::VectorXcd> largest_eigenvalues(const Eigen::SparseMatrix<double>& square, int count,
                                                    double tolerance);

}  // namespace crosscheck
