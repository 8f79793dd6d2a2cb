// Eigenvalues of dense matrices by Eigen, whose templates take half a minute to compile. All values are nan if the
// iteration fails.
#pragma once

#include <Eigen/Core>

namespace crosscheck {

/// Eigensystem of a symmetric n x n matrix: eigenvalues ascending, eigenvectors (columns) of unit length.
struct Eigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Eigensystem symmetric_eigensystem(const Eigen::MatrixXd& symmetric);

/// Eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

/// Eigenvalues of a general square matrix, unordered.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& square);

}  // namespace crosscheck
