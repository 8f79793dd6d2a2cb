// Extreme eigenvalues of sparse matrices, by the Lanczos and Arnoldi iterations of Spectra.
#pragma once

#include <Eigen/SparseCore>

#include <optional>

namespace crosscheck {

struct Eigenpair {
  double value;
  Eigen::VectorXd vector;  // normalised
};

/// Nothing without convergence to the relative `tolerance`.
std::optional<Eigenpair> largest_eigenpair(const Eigen::SparseMatrix<double>& symmetric, double tolerance);

/// The eigenpair nearest to `shift` of a symmetric matrix whose eigenvalues are all above `shift`.
std::optional<Eigenpair> eigenpair_above(const Eigen::SparseMatrix<double>& symmetric, double shift, double tolerance);

/// Those of largest modulus of a general matrix; a conjugate pair counts as two.
std::optional<Eigen::VectorXcd> largest_eigenvalues(const Eigen::SparseMatrix<double>& square, int count,
                                                    double tolerance);

}  // namespace crosscheck
