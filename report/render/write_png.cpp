// Draws a picture, lets gnuplot set the letters, and puts the files in their place in one go.
#include <algorithm>
#include <stdexcept>

#include "report/pdf_date.h"
#include "report/render/file_in_waiting.h"
#include "report/render/layout.h"
#include "report/render/lettered.h"
#include "report/render/png_file.h"

namespace crosscheck::render {
namespace {

namespace fs = std::filesystem;

/// The picture's image with the bar. Throws std::runtime_error where nothing stands before the ground: the picture is
/// then nowhere darker by more than an eye tells apart.
Image drawn(const Picture& picture, const Layout& layout, const fs::path& file, Studio& studio) {
  Image image = studio.draw(picture);
  constexpr int visible = 24;  // of 255; the ground of an empty picture is one colour
  const auto [darkest, brightest] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  if (darkest == image.rgb.end() || *brightest - *darkest <= visible)
    throw std::runtime_error(file.stem().string() + ": nothing is to be seen in the picture");
  paint_bar(picture, layout, image);
  return image;
}

}  // namespace

void write_png(const Picture& picture, const fs::path& file) {
  Studio studio;
  write_png(picture, file, studio);
}

void write_png(const Picture& picture, const fs::path& file, Studio& studio) {
  FileInWaiting waiting(file);
  const Layout layout = layout_of(picture);
  write_lettered(picture, layout, drawn(picture, layout, file, studio), {}, file.string(), waiting.temporary());
  pack_tightly(waiting.temporary());
  waiting.finish();
}

void write_print(const Picture& picture, double pixels_per_inch, const fs::path& png, const fs::path& pdf) {
  FileInWaiting image_file(png), page_file(pdf);
  Studio studio;
  const Layout layout = layout_of(picture);
  const Image image = drawn(picture, layout, png, studio);
  write_lettered(picture, layout, image, {}, png.string(), image_file.temporary());
  set_resolution(image_file.temporary(), pixels_per_inch);
  write_lettered(picture, layout, image, {true, pixels_per_inch}, pdf.string(), page_file.temporary());
  undate(page_file.temporary());
  image_file.finish(), page_file.finish();
}

}  // namespace crosscheck::render
