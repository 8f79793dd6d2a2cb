// Regular grids of particles with structural, shear and bend springs: cloth.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "mysim/section.h"
#include "mysim/terms/springs.h"

namespace crosscheck {

/// Particle (i, j) has index i + j nu and starts at origin + i/(nu-1) u + j/(nv-1) v.
struct Grid {
  int nu, nv;
  Vec3 origin, u, v;  // m; u and v are the whole sides
  double mass;        // kg, of the whole grid, shared equally
  struct {
    double structural, shear, bend;  // N/m; 0: the family is absent
  } stiffness;
};

Grid read_grid(const Section& s);
Points grid_points(const Grid& grid);
/// Springs in the order of the particles: for each one, structural along u and v, both shear diagonals of the cell that
/// starts there, bend (skip one) along u and v. Rest lengths are the distances at the start.
std::vector<Spring> grid_springs(const Grid& grid, const Points& x);
std::vector<std::array<int, 3>> grid_triangles(const Grid& grid);

}  // namespace crosscheck
