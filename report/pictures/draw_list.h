// Content of a panel as triangles and rods in the camera's frame, in single precision.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "report/pictures/camera.h"
#include "report/pictures/colour.h"

namespace crosscheck::render {

/// `rim`: distances to the three edges in half widths of a thread; large for an edge without a thread.
struct ClothVertex {
  Eigen::Vector3f x, normal, rim;
  float value;  // position on the scale, 0..1
};

/// A rod with round ends, which is a ball if both ends coincide.
struct Rod {
  Eigen::Vector3f a;
  float radius;
  Eigen::Vector3f b;
  Colour colour;  // linear
};

struct DrawList {
  std::vector<ClothVertex> cloth;     // corners of all surfaces
  std::vector<unsigned> cloth_index;  // three per triangle
  bool coloured = false;              // true if the cloth is coloured by values
  float lift = 0;                     // depth to which flat triangles may dip into a ball (draw_list.cpp)
  std::vector<Rod> balls, beads, rods, trail;
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  // centre of a sphere around everything that casts a shadow
  float radius = 0.5f;
};

/// Makes the list of a panel. Omits bodies that are not finite or extend absurdly far.
DrawList draw_list_of(const Panel& panel, const Frame& frame, const std::optional<Scale>& scale);

struct RodMesh {
  std::vector<Eigen::Vector4f> corner;  // unit normal in the rod's axes; end (0 or 1)
  std::vector<unsigned> index;          // three per triangle, counter-clockwise from outside
};

/// A rod along its third axis with `around` sides, and `rings` rings on each round end. With around / 4 rings, the
/// chords of a ball dip below its surface by 1 - cos(pi / around) of its radius.
RodMesh rod_mesh(int around, int rings);

}  // namespace crosscheck::render
