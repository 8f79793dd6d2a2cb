// One panel ready to draw: bodies and balls as triangles, spheres and rods in the frame, in single precision.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "report/pictures/camera.h"
#include "report/pictures/colour.h"

namespace crosscheck::render {

/// Corner of a cloth triangle. `rim` are the distances to the three edges in half widths of a thread; far if no thread.
struct ClothVertex {
  Eigen::Vector3f x, normal, rim;
  float value;     // place on the scale, 0..1
  float no_value;  // 1 where the value is not finite
};

struct Sphere {
  Eigen::Vector3f centre;
  float radius;
  Colour colour;  // linear
};

/// A solid rod with round ends.
struct Capsule {
  Eigen::Vector3f a;
  float radius;
  Eigen::Vector3f b;
  Colour colour;  // linear
};

struct DrawList {
  std::vector<ClothVertex> cloth;     // corners of the triangles of all surfaces
  std::vector<unsigned> cloth_index;  // three per triangle
  bool coloured = false;              // the cloth carries values
  float lift = 0;                     // how far a flat triangle may dip into a ball it follows; see draw_list.cpp
  std::vector<Sphere> balls, beads;
  std::vector<Capsule> rods, trail;
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();  // of a sphere around all that throws a shadow
  float radius = 0.5f;
};

/// Leaves out whatever has a vertex that is not finite or absurdly far away. Throws std::runtime_error for an index
/// that no particle has, or for values of the wrong number.
DrawList draw_list_of(const Panel& panel, const Frame& frame, const std::optional<Scale>& scale);

}  // namespace crosscheck::render
