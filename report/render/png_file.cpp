// libpng reads; a chunk is put in by hand, with zlib's checksum.
#include "report/render/png_file.h"

#include <png.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace crosscheck::render {
namespace {

std::string big_endian(unsigned long value) {
  std::string bytes;
  for (const unsigned shift : {24u, 16u, 8u, 0u}) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

/// Signature and the first chunk, IHDR, of every PNG file.
constexpr std::size_t header = 8 + 25;

}  // namespace

Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_file(&png, file.c_str())) {
    png.format = PNG_FORMAT_RGB;
    image = {int(png.width), int(png.height), std::vector<unsigned char>(PNG_IMAGE_SIZE(png))};
    png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr);
  }
  if (PNG_IMAGE_FAILED(png)) throw std::runtime_error("cannot read " + file.string() + ": " + png.message);
  return image;
}

void set_resolution(const std::filesystem::path& file, double pixels_per_inch) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.size() < header) throw std::runtime_error("cannot read " + file.string());
  const std::string per_metre = big_endian(std::lround(pixels_per_inch / 0.0254));
  const std::string chunk = "pHYs" + per_metre + per_metre + '\1';
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
  bytes.insert(header, big_endian(chunk.size() - 4) + chunk + big_endian(sum));
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace crosscheck::render
