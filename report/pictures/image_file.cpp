#include "report/pictures/picture.h"

#include <fmt/format.h>
#include <png.h>
#include <webp/encode.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mysim/base/files.h"
#include "report/pictures/lettering.h"

namespace crosscheck::render {

Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_file(&png, file.c_str())) {
    if (constexpr png_uint_32 largest = 8192; png.width > largest || png.height > largest) {  // the limit of --size
      png_image_free(&png);
      throw std::runtime_error(fmt::format("cannot read {}: larger than {} pixels", file.string(), largest));
    }
    png.format = PNG_FORMAT_RGB;
    image = {int(png.width), int(png.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(png))};
    png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr);
  }
  if (PNG_IMAGE_FAILED(png)) throw std::runtime_error("cannot read " + file.string() + ": " + png.message);
  return image;
}

std::string png_bytes(const Image& image, double pixels_per_inch) {
  std::string bytes;
  const auto append = [](png_structp png, png_bytep data, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
  };
  // the simple interface of libpng does not write the resolution; the only error that can occur here is lack of memory
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const auto per_metre = png_uint_32(std::lround(pixels_per_inch / 0.0254));
  if (per_metre > 0) png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y)
    png_write_row(png, image.rgb.data() + 3 * std::size_t(y) * std::size_t(image.width));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::string webp_bytes(const Image& image) {
  constexpr float quality = 85;  // %; keeps letters and threads sharp
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeRGB(image.rgb.data(), image.width, image.height, 3 * image.width, quality, &bytes);
  if (size == 0) throw std::runtime_error("WebP cannot encode a picture");
  std::string all(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return all;
}

namespace {

/// Draws the image without text. Throws std::runtime_error if nothing is visibly darker than the brightest pixel,
/// because then the image shows only the ground.
Image drawn(const Picture& picture, const std::filesystem::path& file) {
  Image image = draw(picture);
  constexpr int visible = 24;  // out of 255; the ground of an empty picture has a single colour
  const auto [darkest, brightest] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  if (darkest == image.rgb.end() || *brightest - *darkest <= visible)
    throw std::runtime_error(file.stem().string() + ": the picture is empty");
  return image;
}

}  // namespace

void write_png(const Picture& picture, const std::filesystem::path& file) {
  write_file(file, png_bytes(lettered(picture, layout_of(picture), drawn(picture, file))));
}

void write_print(const Picture& picture, double pixels_per_inch, const std::filesystem::path& png,
                 const std::filesystem::path& pdf) {
  const Layout layout = layout_of(picture);
  const Image image = drawn(picture, png);
  write_file(png, png_bytes(lettered(picture, layout, image), pixels_per_inch));
  write_file(pdf, pdf_page(picture, layout, image, pixels_per_inch));
}

}  // namespace crosscheck::render
