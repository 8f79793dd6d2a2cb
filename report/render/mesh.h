// The two shapes that are drawn many times: a unit sphere and a rod with round ends.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace crosscheck::render {

struct Mesh {
  std::vector<Eigen::Vector4f> corner;  // sphere: unit normal, 0; rod: unit normal in the rod's axes, end (0 or 1)
  std::vector<unsigned> index;          // three per triangle, counter-clockwise from outside
};

/// A sphere of `around` slices and around / 2 stacks: its chords dip 1 - cos(pi / around) of the radius below the
/// surface.
Mesh sphere_mesh(int around);

/// A rod along its third axis with `around` sides and round ends of `rings` rings each.
Mesh rod_mesh(int around, int rings);

}  // namespace crosscheck::render
