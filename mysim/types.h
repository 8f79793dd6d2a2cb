// The few types that every room shares: a vector, a set of points, and the state of a scene.
#pragma once

#include <Eigen/Core>

namespace crosscheck {

using Vec3 = Eigen::Vector3d;
using Points = Eigen::Matrix3Xd;  // N (3 x n): one column per particle

/// What changes with time. A first-order scene (x' = f(x, t)) has no velocities: v is then 3 x 0.
struct State {
  double t = 0;  // s
  Points x;      // N (3 x n), m
  Points v;      // N (3 x n), m/s; or 3 x 0
};

}  // namespace crosscheck
