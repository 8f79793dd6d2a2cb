// A body's particles in the frame, with the knowledge of which are fit to be drawn.
#pragma once

#include <array>
#include <vector>

#include "report/render/stage.h"

namespace crosscheck::render {

struct PlacedBody {
  const Body& body;
  const Scale* scale;              // null: nothing is coloured by value
  std::vector<Eigen::Vector3f> x;  // in the frame
  std::vector<bool> sound;         // finite and not absurdly far away

  bool is_sound(int i) const { return sound[std::size_t(i)]; }
  const Eigen::Vector3f& at(int i) const { return x[std::size_t(i)]; }
  bool coloured() const { return scale && !body.value.empty(); }

  /// Place on the scale of a particle's value; 0 if the body has no values.
  float position(int i) const { return coloured() ? scale_position(*scale, body.value[std::size_t(i)]) : 0; }

  /// Median length of those of the edges given that are sound; 0 if there are none.
  float median_length(const std::vector<std::array<int, 2>>& edges) const;
};

/// Throws std::runtime_error for an index that no particle has, or for values whose number does not fit.
PlacedBody place_body(const Body& body, const Frame& frame, const Scale* scale);

/// Adds the body's triangles to the stage; returns the threads that are not an edge of any triangle.
std::vector<std::array<int, 2>> add_cloth(const PlacedBody& placed, Stage& stage);

}  // namespace crosscheck::render
