// One panel ready to draw: bodies and balls as triangles, spheres and rods in the frame, in single precision.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "report/pictures/camera.h"
#include "report/pictures/colour.h"

namespace crosscheck::render {

// One panel ready to draw: bodies and balls as triangles, spheres and tubes in the frame, in single precision.

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
/// that no particle has, or for values whose number does not fit.
DrawList draw_list_of(const Panel& panel, const Frame& frame, const std::optional<Scale>& scale);

// A body's particles in the frame, with the knowledge of which are fit to be drawn.

struct TransformedBody {
  const Body& body;
  const Scale* scale;              // null: nothing is coloured by value
  std::vector<Eigen::Vector3f> x;  // in the frame
  std::vector<bool> valid;         // finite and not absurdly far away

  bool is_valid(int i) const { return valid[std::size_t(i)]; }
  const Eigen::Vector3f& at(int i) const { return x[std::size_t(i)]; }
  bool coloured() const { return scale && !body.value.empty(); }

  /// Place on the scale of a particle's value; 0 if the body has no values.
  float position(int i) const { return coloured() ? scale_position(*scale, body.value[std::size_t(i)]) : 0; }

  /// Median length of those of the edges given that are sound; 0 if there are none.
  float median_length(const std::vector<std::array<int, 2>>& edges) const;
};

/// Throws std::runtime_error for an index that no particle has, or for values whose number does not fit.
TransformedBody transform_body(const Body& body, const Frame& frame, const Scale* scale);

/// Adds the body's triangles to the stage; returns the threads that are not an edge of any triangle.
std::vector<std::array<int, 2>> add_cloth(const TransformedBody& placed, DrawList& list);

}  // namespace crosscheck::render
