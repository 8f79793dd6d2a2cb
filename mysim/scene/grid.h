// Regular grids of particles with structural, shear and bend springs: cloth, and jelly blocks.
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
  Vec3 origin, u, v, w;  // m; u, v and w span the whole sides
  double mass;           // kg, of the whole grid, shared equally
  struct {
    double structural, shear, bend;  // N/m; 0: family absent; infinite: hard distances
  } stiffness;
  double dashpot;  // N s/m along every spring; 0: none
  double bending;  // N m, rigidity of a cloth with perpendicular sides; 0: none

  int size() const { return nu * nv * nw; }
};

Grid read_grid(const TomlTable& s);
Points grid_points(const Grid& grid);
/// Springs in the order of the particles: for each one, structural springs along the axes, both shear diagonals of each
/// face of the cell that starts there, and bend (skip-one) springs along the axes. Rest lengths are the distances of
/// the grid, the same number for all springs of one direction, to which the initial positions are rounded; stiffness is
/// infinite for the structural family of an inextensible grid.
std::vector<Spring> grid_springs(const Grid& grid);
/// The stencils of mysim/terms/bending.h: for each particle, the stencils along u and v that are centred on it, and the
/// stencil of the cell that starts there.
Bending grid_bending(const Grid& grid);
/// The triangles of the cloth, or of the six faces of the block, oriented outwards.
std::vector<std::array<int, 3>> grid_triangles(const Grid& grid);

}  // namespace crosscheck
