// Draws all panels of a picture into one image, without letters, keeping the painter for the next picture.

#include <memory>
#include <tuple>

#include "report/pictures/colour.h"
#include "report/pictures/context.h"
#include "report/pictures/layout.h"
#include "report/pictures/painter.h"

namespace crosscheck::render {
namespace {

/// Puts a panel's linear floats (rows from the bottom) into the image (rows from the top).
void put(const std::vector<float>& pixels, const Layout& layout, int left, int top, Image& image) {
  const SrgbEncoder encode;
  for (int y = 0; y < layout.panel_height; ++y) {
    const float* from = &pixels[4 * std::size_t(layout.panel_height - 1 - y) * std::size_t(layout.panel_width)];
    unsigned char* to = &image.rgb[3 * (std::size_t(top + y) * std::size_t(image.width) + std::size_t(left))];
    for (int x = 0; x < layout.panel_width; ++x) {
      for (int channel = 0; channel < 3; ++channel) to[3 * x + channel] = encode(from[4 * x + channel]);
    }
  }
}

}  // namespace

Image blank(int width, int height) {
  Image image{width, height, {}};
  image.rgb.reserve(3 * std::size_t(width) * std::size_t(height));
  for (int i = 0; i < width * height; ++i) {
    for (const unsigned shift : {16u, 8u, 0u}) image.rgb.push_back(static_cast<unsigned char>(background_hex >> shift));
  }
  return image;
}

struct OffscreenRenderer::Parts {
  std::unique_ptr<Context> context;
  std::unique_ptr<Painter> painter;  // dies before the context
  std::tuple<int, int, Quality, bool> painter_for;

  Painter& painter_of(const Picture& picture, const Layout& layout) {
    const bool diverging = picture.scale && picture.scale->diverging;
    const std::tuple wanted(layout.panel_width, layout.panel_height, picture.quality, diverging);
    if (!painter || painter_for != wanted) {
      // a new context too: the old painter's textures and programs go with the old one
      painter.reset(), context.reset();
      context = std::make_unique<Context>();
      painter =
          std::make_unique<Painter>(context->gl(), layout.panel_width, layout.panel_height, picture.quality, diverging);
      painter_for = wanted;
    }
    context->make_current();
    return *painter;
  }
};

OffscreenRenderer::OffscreenRenderer() : parts_(std::make_unique<Parts>()) {}
OffscreenRenderer::~OffscreenRenderer() = default;

Image OffscreenRenderer::draw(const Picture& picture) {
  const Layout layout = layout_of(picture);
  const Frame frame = frame_of(picture.view, double(layout.panel_width) / layout.panel_height);

  Image image = blank(picture.width, picture.height);

  Painter& painter = parts_->painter_of(picture, layout);
  for (std::size_t row = 0; row < picture.rows.size(); ++row) {
    for (std::size_t column = 0; column < picture.rows[row].size(); ++column) {
      const DrawList list = draw_list_of(picture.rows[row][column], frame, picture.scale);
      put(painter.paint(list, frame), layout, layout.left + int(column) * layout.panel_width, layout.panel_top[row],
          image);
    }
  }
  return image;
}

Image draw(const Picture& picture) { return OffscreenRenderer().draw(picture); }

}  // namespace crosscheck::render
