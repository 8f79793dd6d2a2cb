// The spring forces of assignment 3. Do not change this file: the grader uses its own copy.
#pragma once

#include <vector>

#include "vec3.h"

struct Spring {
  int a = 0, b = 0;
  double k = 0;     // N/m
  double rest = 0;  // m
};

/// Sum of all spring forces on each particle, N.
inline std::vector<Vec3> spring_forces(const std::vector<Spring>& springs, const std::vector<Vec3>& x) {
  std::vector<Vec3> f(x.size());
  for (const Spring& s : springs) {
    const Vec3 d = x[s.a] - x[s.b];
    const double l = length(d);
    if (l == 0) continue;
    const Vec3 on_a = (-s.k * (l - s.rest) / l) * d;
    f[s.a] += on_a;
    f[s.b] -= on_a;
  }
  return f;
}
