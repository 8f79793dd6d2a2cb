// Eigen, with one order of sums in all builds.
#pragma once

#include <Eigen/Core>

namespace Eigen::internal {

/// Sums three numbers as (x + y) + z. Eigen does so with SIMD instructions only, and this gives the same bits without.
template <class Function, class Evaluator>
struct redux_novec_unroller<Function, Evaluator, 0, 3> {
  using Scalar = typename Evaluator::Scalar;
  static Scalar run(const Evaluator& of, const Function& function) {
    return function(redux_novec_unroller<Function, Evaluator, 0, 2>::run(of, function),
                    redux_novec_unroller<Function, Evaluator, 2, 1>::run(of, function));
  }
};

}  // namespace Eigen::internal
