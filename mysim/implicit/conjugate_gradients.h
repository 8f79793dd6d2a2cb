// Conjugate gradients for a symmetric matrix that is never formed, on N (3 x n) columns, with a preconditioner.
#pragma once

#include <cmath>
#include <utility>

#include "mysim/types.h"

namespace crosscheck {

struct CgResult {
  int iterations = 0;
  bool converged = false;
  bool negative_curvature = false;  // a direction p with p . A p <= 0 was met: the matrix is not positive definite
};

/// Working memory, kept between solves.
struct CgMemory {
  Points r, z, p, q;
};

/// Solves A x = b from x = 0 until |b - A x| <= tolerance |b|. apply(p, q): q = A p. precondition(r, z): z = M^-1 r
/// with M symmetric positive definite. Stops at once at negative curvature, with the x reached so far.
template <class Apply, class Precondition>
CgResult conjugate_gradients(Apply apply, Precondition precondition, const Points& b, double tolerance,
                             int most_iterations, Points& x, CgMemory& m) {
  CgResult result;
  x.setZero(3, b.cols());
  m.r = b;
  const double goal = tolerance * b.norm();
  precondition(m.r, m.z);
  m.p = m.z;
  double rz = dot(m.r, m.z);
  while (!(result.converged = m.r.norm() <= goal) && result.iterations < most_iterations) {
    apply(m.p, m.q);
    const double curvature = dot(m.p, m.q);
    ++result.iterations;
    if (!(curvature > 0)) {
      result.negative_curvature = true;
      break;
    }
    const double length = rz / curvature;
    x += length * m.p;
    m.r -= length * m.q;
    precondition(m.r, m.z);
    const double before = std::exchange(rz, dot(m.r, m.z));
    m.p = m.z + rz / before * m.p;
  }
  return result;
}

}  // namespace crosscheck
