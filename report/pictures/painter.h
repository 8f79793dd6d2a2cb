// Draws one panel after another into a floating-point image, in one pass or as the mean of many.
#pragma once

#include <memory>
#include <vector>

#include "report/pictures/draw_list.h"
#include "report/pictures/gl.h"

namespace crosscheck::render {

class Painter {
 public:
  /// For panels of this size in pixels; the diverging or the sequential colour map for cloth with values.
  Painter(const Gl& gl, int width, int height, Quality quality, bool diverging);
  ~Painter();

  /// Linear light, 4 floats per pixel (the last is not used), rows from bottom to top.
  std::vector<float> paint(const DrawList& list, const Frame& frame);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace crosscheck::render
