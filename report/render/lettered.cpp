// gnuplot reads raw pixels and writes the image.
#include "report/render/lettered.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "mysim/temporary_folder.h"
#include "report/gnuplot.h"
#include "report/render/colour.h"
#include "report/render/lettering.h"
#include "report/render/png_file.h"

namespace crosscheck::render {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const void* data, std::size_t bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(static_cast<const char*>(data), std::streamsize(bytes));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void draw_letters(const std::string& script, const fs::path& folder, const std::string& drawn,
                  const std::string& what) {
  write(folder / "letters.gp", script.data(), script.size());
  tell_warnings(run_gnuplot("letters.gp", folder, {drawn}, what), what);
}

}  // namespace

void paint_bar(const Picture& picture, const Layout& layout, Image& image) {
  if (!picture.scale) return;
  const int left = int(layout.bar_left), right = int(layout.bar_left + layout.bar_width);
  const int top = int(layout.bar_top), bottom = int(layout.bar_top + layout.bar_height);
  for (int x = left; x < right; ++x) {
    const Colour colour = scale_colour(picture.scale->diverging, (float(x - left) + 0.5f) / float(right - left));
    for (int y = top; y < bottom; ++y) {
      unsigned char* pixel = &image.rgb[3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x))];
      for (int channel = 0; channel < 3; ++channel)
        pixel[channel] = static_cast<unsigned char>(std::lround(255 * colour[channel]));
    }
  }
}

void write_lettered(const Picture& picture, const Layout& layout, const Image& image, const Paper& paper,
                    const std::string& what, const fs::path& file) {
  const TemporaryFolder folder("render");
  write(folder.path / "pixels", image.rgb.data(), image.rgb.size());
  draw_letters(lettering_script(picture, layout, paper, "pixels", "picture"), folder.path, "picture", what);
  fs::copy_file(folder.path / "picture", file, fs::copy_options::overwrite_existing);
}

Image lettered(const Picture& picture, const Layout& layout, const Image& image) {
  const TemporaryFolder folder("letters");
  const fs::path file = folder.path / "picture.png";
  write_lettered(picture, layout, image, {}, "the letters of a clip", file);
  return read_png(file);
}

Image drawn_letters(const std::string& script) {
  const TemporaryFolder folder("letters");
  draw_letters(script, folder.path, "picture.png", "the letters of a clip");
  return read_png(folder.path / "picture.png");
}

}  // namespace crosscheck::render
