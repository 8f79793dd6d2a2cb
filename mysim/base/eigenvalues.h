// Eigenvalues of dense matrices, by Eigen. Other files call these: Eigen's templates take half a minute to
// compile. Where its iteration fails, the values are nan.
#pragma once

#include <Eigen/Core>

namespace crosscheck {

/// Of a symmetric n x n matrix: values in rising order, vectors (columns) of length 1.
struct Eigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Eigensystem symmetric_eigensystem(const Eigen::MatrixXd& symmetric);

/// In rising order.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

/// Of any square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& square);

}  // namespace crosscheck
