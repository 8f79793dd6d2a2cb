// Forces on flat arrays: springs and dashpots, air on triangles, and what keeps hard distances.
#include <Eigen/Cholesky>
#include <cmath>

#include "mysim/errors.h"
#include "reference/independent/right_hand_side.h"

namespace crosscheck {

/// What a spring and a dashpot do to their ends: a factor times the vector from one to the other.
void RightHandSide::pull(const Pair& p) {
  const double* a = &x_[3 * p.a];
  const double* b = &x_[3 * p.b];
  const double apart[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double square = apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2];
  if (square == 0) {
    coincident_ += p.rest > 0;
    return;
  }
  double factor = 0;  // N/m, towards each other
  if (p.k > 0)
    factor = link_law_ ? p.k * (1 - 2 * p.rest * p.rest / (square + p.rest * p.rest))
                       : p.k * (1 - p.rest / std::sqrt(square));
  if (p.damping > 0) {
    double parting = 0;  // half the rate of change of the square
    for (int axis = 0; axis < 3; ++axis) parting += apart[axis] * (v_[3 * p.b + axis] - v_[3 * p.a + axis]);
    factor += p.damping * parting / square;
  }
  for (int axis = 0; axis < 3; ++axis) {
    f_[3 * p.a + axis] += factor * apart[axis];
    f_[3 * p.b + axis] -= factor * apart[axis];
  }
}

/// Pressure of the air on the triangles, a third on each corner.
void RightHandSide::blow(double t) {
  for (const Signal& air : airs_) {
    double wind[3];
    air.at(t, wind);
    for (size_t c = 0; c < corners_.size(); c += 3) {
      const int corner[3] = {3 * corners_[c], 3 * corners_[c + 1], 3 * corners_[c + 2]};
      double p[3], q[3], past[3];
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = x_[corner[1] + axis] - x_[corner[0] + axis];
        q[axis] = x_[corner[2] + axis] - x_[corner[0] + axis];
        past[axis] = wind[axis] - (v_[corner[0] + axis] + v_[corner[1] + axis] + v_[corner[2] + axis]) / 3;
      }
      // twice the area, along the normal
      const double twice[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
      const double size = std::hypot(twice[0], twice[1], twice[2]), speed = std::hypot(past[0], past[1], past[2]);
      if (size == 0) continue;
      const double through = past[0] * twice[0] + past[1] * twice[1] + past[2] * twice[2];
      // 1/2 rho C |u| (u . n) (area n) / 3, with area n = twice / 2 and n = twice / size
      const double factor = air_ * speed * through / (12 * size);
      for (int each : corner)
        for (int axis = 0; axis < 3; ++axis) f_[each + axis] += factor * twice[axis];
    }
  }
}

/// Adds the forces along the rods that make d . a + |u|^2 = 0 for each, with d and u the difference of its ends'
/// positions and velocities.
void RightHandSide::keep_lengths() {
  const auto count = static_cast<int>(rods_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd missing(count);
  auto apart = [&](const Rod& r) { return Vec3(Vec3::Map(&x_[3 * r.a]) - Vec3::Map(&x_[3 * r.b])); };
  auto yields = [&](int i) { return fixed_[i] ? 0 : 1 / mass_[i]; };  // 1/kg
  for (int i = 0; i < count; ++i) {
    const Rod& r = rods_[i];
    const Vec3 d = apart(r);
    const Vec3 u = Vec3::Map(&v_[3 * r.a]) - Vec3::Map(&v_[3 * r.b]);
    const Vec3 a = yields(r.a) * Vec3::Map(&f_[3 * r.a]) - yields(r.b) * Vec3::Map(&f_[3 * r.b]);
    missing[i] = -d.dot(a) - u.squaredNorm();
    for (int j = 0; j <= i; ++j) {
      const Rod& s = rods_[j];
      // what a unit of force along s does to the difference of the ends of r
      const double met = yields(r.a) * ((r.a == s.a) - (r.a == s.b)) - yields(r.b) * ((r.b == s.a) - (r.b == s.b));
      if (met != 0) matrix(i, j) = met * d.dot(apart(s));
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  // a dependent rod leaves a pivot at round-off: 1e-12 of the largest, and the factor holds its root
  const auto pivots = factor.matrixLLT().diagonal();
  if (factor.info() != Eigen::Success || !(pivots.minCoeff() > 1e-6 * pivots.maxCoeff()))
    throw Unsupported("its hard distances depend on each other: their forces are not unique");
  const Eigen::VectorXd force = factor.solve(missing);
  for (int i = 0; i < count; ++i) {
    const Vec3 along = force[i] * apart(rods_[i]);
    Vec3::Map(&f_[3 * rods_[i].a]) += along;
    Vec3::Map(&f_[3 * rods_[i].b]) -= along;
  }
}

}  // namespace crosscheck
