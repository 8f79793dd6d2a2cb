// Regular grids of particles with structural, shear and bend springs: cloth and jelly blocks.
#pragma once

#include <Eigen/Geometry>

#include <array>

#include "mysim/scene/toml.h"
#include "mysim/terms/bending.h"
#include "mysim/terms/springs.h"

namespace crosscheck {

/// Particle (i, j, l) has index i + nu (j + nv l) and starts at origin + i/(nu-1) u + j/(nv-1) v + l/(nw-1) w.
struct Grid {
  int nu, nv, nw;        // nw = 1: cloth
  Vec3 origin, u, v, w;  // m; u, v and w are the whole sides
  double mass;           // kg, total; shared equally
  struct {
    double structural, shear, bend;  // N/m; 0 for no springs, infinite for hard distances
  } stiffness;
  double dashpot;  // N s/m along each spring; 0 for no dashpots
  double bending;  // N m, rigidity of a cloth with perpendicular sides; 0 for no bending

  int size() const { return nu * nv * nw; }
};

Grid read_grid(const TomlTable& s);
Points grid_points(const Grid& grid);
/// Springs of the grid, for each particle in order: structural springs along the axes, both shear diagonals of each
/// face of the cell that starts there, and bend (skip-one) springs along the axes. All springs of one direction have
/// the same rest length, which their initial lengths equal up to rounding. The structural springs of an inextensible
/// grid are infinitely stiff.
std::vector<Spring> grid_springs(const Grid& grid);
/// For each particle, the stencils of mysim/terms/bending.h along u and v that are centred on it, and the stencil of
/// the cell that starts there.
Bending grid_bending(const Grid& grid);
/// Triangles of the cloth, or of the six faces of the block, oriented outwards.
std::vector<std::array<int, 3>> grid_triangles(const Grid& grid);

}  // namespace crosscheck
