// The few types that every room shares: a vector, a set of points, and the state of a scene.
#pragma once

#include <Eigen/Core>

namespace Eigen::internal {

/// Three numbers are summed as (x + y) + z, which Eigen does where it has SIMD instructions for them, and not
/// elsewhere: so the same bits in builds that have none.
template <class Function, class Evaluator>
struct redux_novec_unroller<Function, Evaluator, 0, 3> {
  using Scalar = typename Evaluator::Scalar;
  static Scalar run(const Evaluator& of, const Function& function) {
    return function(redux_novec_unroller<Function, Evaluator, 0, 2>::run(of, function),
                    redux_novec_unroller<Function, Evaluator, 2, 1>::run(of, function));
  }
};

}  // namespace Eigen::internal

namespace crosscheck {

using Vec3 = Eigen::Vector3d;
using Points = Eigen::Matrix3Xd;  // N (3 x n): one column per particle

/// Length of the longest column; 0 when there is none.
inline double largest_column(const Points& p) { return p.cols() > 0 ? p.colwise().norm().maxCoeff() : 0; }
/// Sum of the products of all entries.
inline double dot(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

/// The state that changes with time. A first-order scene (x' = f(x, t)) has no velocities: v is then 3 x 0.
struct State {
  double t = 0;  // s
  Points x;      // N (3 x n), m
  Points v;      // N (3 x n), m/s; or 3 x 0
};

}  // namespace crosscheck
