// Eigenvalues of dense matrices, by Eigen, whose templates take half a minute to compile. They are nan if its iteration
// fails.
#pragma once

#include <Eigen/Core>

namespace crosscheck {

/// Eigensystem of a symmetric n x n matrix: values in rising order, vectors (columns) of length 1.
struct Eigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Eigensystem symmetric_eigensystem(const Eigen::MatrixXd& symmetric);

/// Eigenvalues of a symmetric matrix, in rising order.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

/// Eigenvalues of a general square matrix, unordered.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& square);

}  // namespace crosscheck
