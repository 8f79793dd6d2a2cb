// Sphere and rod as surfaces of revolution.
#include "report/pictures/draw_list.h"

#include <cmath>
#include <numbers>

namespace crosscheck::render {
namespace {

/// Rows of `around` + 1 corners joined to a skin.
void join_rows(Mesh& mesh, int rows, int around) {
  const auto at = [&](int row, int i) { return unsigned(row * (around + 1) + i); };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int i = 0; i < around; ++i) {
      for (const unsigned corner : {at(row, i), at(row, i + 1), at(row + 1, i + 1)}) mesh.index.push_back(corner);
      for (const unsigned corner : {at(row, i), at(row + 1, i + 1), at(row + 1, i)}) mesh.index.push_back(corner);
    }
  }
}

/// A circle of normals at the latitude given (-pi/2 .. pi/2), carrying `end`.
void add_row(Mesh& mesh, double latitude, int around, float end) {
  for (int i = 0; i <= around; ++i) {
    const double angle = 2 * std::numbers::pi * (i % around) / around;
    mesh.corner.emplace_back(float(std::cos(latitude) * std::cos(angle)), float(std::cos(latitude) * std::sin(angle)),
                             float(std::sin(latitude)), end);
  }
}

}  // namespace

Mesh sphere_mesh(int around) {
  Mesh mesh;
  const int stacks = around / 2;
  for (int row = 0; row <= stacks; ++row) add_row(mesh, std::numbers::pi * (double(row) / stacks - 0.5), around, 0);
  join_rows(mesh, stacks + 1, around);
  return mesh;
}

Mesh capsule_mesh(int around, int rings) {
  Mesh mesh;
  for (int end = 0; end < 2; ++end) {
    for (int ring = 0; ring <= rings; ++ring) {
      const double quarter = 0.5 * std::numbers::pi * ring / rings;
      add_row(mesh, end == 0 ? quarter - 0.5 * std::numbers::pi : quarter, around, float(end));
    }
  }
  join_rows(mesh, 2 * rings + 2, around);
  return mesh;
}

}  // namespace crosscheck::render
