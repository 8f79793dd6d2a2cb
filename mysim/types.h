// Types shared by all modules: a vector, a set of points, and the state of a scene.
#pragma once

#include "mysim/eigen.h"

namespace crosscheck {

using Vec3 = Eigen::Vector3d;
using Points = Eigen::Matrix3Xd;  // 3 x n: one column per particle

/// Length of the longest column; 0 without columns.
inline double largest_column(const Points& p) { return p.cols() > 0 ? p.colwise().norm().maxCoeff() : 0; }
/// Sum of the products of corresponding entries.
inline double dot(const Points& a, const Points& b) { return a.cwiseProduct(b).sum(); }

/// State of a scene. A first-order scene (x' = f(x, t)) has no velocities.
struct State {
  double t = 0;  // s
  Points x;      // 3 x n, m
  Points v;      // 3 x n, m/s; or 3 x 0
};

}  // namespace crosscheck
