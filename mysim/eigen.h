// Eigen, with the same summation order in all builds.
#pragma once

#include <Eigen/Core>

namespace Eigen::internal {

/// Sums three numbers as (x + y) + z, with the same bits as Eigen's SIMD code. Eigen without SIMD uses another order.
template <class Function, class Evaluator>
struct redux_novec_unroller<Function, Evaluator, 0, 3> {
  using Scalar = typename Evaluator::Scalar;
  static Scalar run(const Evaluator& of, const Function& function) {
    return function(redux_novec_unroller<Function, Evaluator, 0, 2>::run(of, function),
                    redux_novec_unroller<Function, Evaluator, 2, 1>::run(of, function));
  }
};

}  // namespace Eigen::internal
