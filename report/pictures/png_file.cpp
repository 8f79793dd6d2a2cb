// PNG files of pictures: drawn, lettered and put in their place in one go; libpng reads them.
#include "report/pictures/png_file.h"

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "mysim/base/files.h"
#include "report/base/atomic_file.h"
#include "report/base/gnuplot.h"
#include "report/pictures/layout.h"
#include "report/pictures/lettering.h"

namespace crosscheck::render {
namespace {

std::string big_endian(unsigned long value) {
  std::string bytes;
  for (const unsigned shift : {24u, 16u, 8u, 0u}) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

/// Signature and the first chunk, IHDR, of every PNG file.
constexpr std::size_t signature = 8, header = signature + 25;

std::string chunk(const std::string& type_and_data) {
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(type_and_data.data()), static_cast<uInt>(type_and_data.size()));
  return big_endian(type_and_data.size() - 4) + type_and_data + big_endian(sum);
}

std::string bytes_of(const std::filesystem::path& file) {
  std::string bytes = try_read_file(file).value_or("");
  if (bytes.size() < header) throw std::runtime_error("cannot read " + file.string());
  return bytes;
}

void write_bytes(const std::string& bytes, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::string inflated(const std::string& packed, const std::filesystem::path& file) {
  std::string out(std::max<std::size_t>(8 * packed.size(), 1 << 16), '\0');
  for (;; out.resize(4 * out.size())) {
    auto size = static_cast<uLongf>(out.size());
    const int done = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (done == Z_OK) return out.substr(0, size);
    if (done != Z_BUF_ERROR || out.size() > (std::size_t{1} << 31)) break;
  }
  throw std::runtime_error("cannot read " + file.string());
}

}  // namespace

Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_file(&png, file.c_str())) {
    if (constexpr std::size_t largest = 8192; png.width > largest || png.height > largest) {  // as --size allows
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

void set_resolution(const std::filesystem::path& file, double pixels_per_inch) {
  std::string bytes = bytes_of(file);
  const std::string per_metre = big_endian(std::lround(pixels_per_inch / 0.0254));
  bytes.insert(header, chunk("pHYs" + per_metre + per_metre + '\1'));
  write_bytes(bytes, file);
}

void pack_tightly(const std::filesystem::path& file) {
  const std::string bytes = bytes_of(file);
  std::string before = bytes.substr(0, signature), packed, after;
  for (std::size_t at = signature; at + 12 <= bytes.size();) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(bytes[at + i]);
    if (bytes.compare(at + 4, 4, "IDAT") == 0)
      packed += bytes.substr(at + 8, size);
    else
      (packed.empty() ? before : after) += bytes.substr(at, size + 12);
    at += size + 12;
  }
  const std::string pixels = inflated(packed, file);
  std::string tight(compressBound(pixels.size()), '\0');
  auto size = static_cast<uLongf>(tight.size());
  compress2(reinterpret_cast<Bytef*>(tight.data()), &size, reinterpret_cast<const Bytef*>(pixels.data()), pixels.size(),
            Z_BEST_COMPRESSION);
  if (size < packed.size()) write_bytes(before + chunk("IDAT" + tight.substr(0, size)) + after, file);
}

namespace {

using Rgb = std::array<int, 3>;  // 0 to 255

struct Counted {
  Rgb colour;
  double count;  // pixels
};

/// Colours that are to become one.
struct ColourBox {
  std::vector<Counted> colours;
  Rgb mean{};
  int widest = 0;     // of red, green and blue
  double spread = 0;  // squares of distances from the mean along it

  explicit ColourBox(std::vector<Counted> of) : colours(std::move(of)) {
    double count = 0;
    std::array<double, 3> sum{}, squares{};
    for (const Counted& c : colours) {
      count += c.count;
      for (size_t k = 0; k < 3; ++k) sum[k] += c.count * c.colour[k], squares[k] += c.count * c.colour[k] * c.colour[k];
    }
    for (size_t k = 0; k < 3; ++k) {
      mean[k] = static_cast<int>(std::lround(sum[k] / count));
      if (const double own = squares[k] - sum[k] * sum[k] / count; own > spread)
        spread = own, widest = static_cast<int>(k);
    }
    if (colours.size() < 2) spread = 0;
  }
};

constexpr size_t most_colours = 128;

/// At most so many colours that stand for these: the box of the widest spread is cut at its mean, again and again.
std::vector<Rgb> few_of(std::vector<Counted> colours) {
  std::vector<ColourBox> boxes{ColourBox(std::move(colours))};
  while (boxes.size() < most_colours) {
    const auto worst = std::ranges::max_element(boxes, {}, &ColourBox::spread);
    if (!(worst->spread > 0)) break;
    ColourBox box = std::move(*worst);
    const auto axis = static_cast<size_t>(box.widest);
    const auto upper = std::partition(box.colours.begin(), box.colours.end(),
                                      [&](const Counted& c) { return c.colour[axis] <= box.mean[axis]; });
    std::vector<Counted> high(upper, box.colours.end());
    box.colours.erase(upper, box.colours.end());
    if (high.empty()) {  // the mean was rounded to the largest
      const auto most = std::ranges::max_element(box.colours, {}, [&](const Counted& c) { return c.colour[axis]; });
      high.push_back(*most);
      box.colours.erase(most);
    }
    *worst = ColourBox(std::move(box.colours));
    boxes.emplace_back(std::move(high));
  }
  std::vector<Rgb> few;
  for (const ColourBox& box : boxes) few.push_back(box.mean);
  return few;
}

}  // namespace

std::string with_few_colours(const std::filesystem::path& file) {
  const Image image = read_png(file);
  std::map<Rgb, int> place;  // of each colour that there is: at first its pixels
  const auto at = [&](size_t i) { return Rgb{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}; };
  for (size_t i = 0; i < image.rgb.size(); i += 3) ++place[at(i)];
  std::vector<Counted> colours;
  for (const auto& [colour, count] : place) colours.push_back({colour, static_cast<double>(count)});
  const std::vector<Rgb> few = few_of(std::move(colours));
  for (auto& [colour, index] : place)
    index = static_cast<int>(std::ranges::min_element(few, {},
                                                      [&](const Rgb& other) {
                                                        int sum = 0;
                                                        for (size_t k = 0; k < 3; ++k)
                                                          sum += (colour[k] - other[k]) * (colour[k] - other[k]);
                                                        return sum;
                                                      }) -
                             few.begin());
  std::string pixels;
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    if (i % (3 * static_cast<size_t>(image.width)) == 0) pixels += '\0';  // each row: no differences
    pixels += static_cast<char>(place[at(i)]);
  }
  std::string palette = "PLTE", tight(compressBound(pixels.size()), '\0');
  for (const Rgb& colour : few)
    for (const int part : colour) palette += static_cast<char>(part);
  auto size = static_cast<uLongf>(tight.size());
  compress2(reinterpret_cast<Bytef*>(tight.data()), &size, reinterpret_cast<const Bytef*>(pixels.data()), pixels.size(),
            Z_BEST_COMPRESSION);
  const std::string bytes = bytes_of(file);
  std::string small = bytes.substr(0, signature) +
                      chunk("IHDR" + big_endian(static_cast<unsigned long>(image.width)) +
                            big_endian(static_cast<unsigned long>(image.height)) + std::string("\10\3\0\0\0", 5)) +
                      chunk(palette) + chunk("IDAT" + tight.substr(0, size)) + chunk("IEND");
  return small.size() < bytes.size() ? small : bytes;
}

namespace {

namespace fs = std::filesystem;

/// The picture's image with the bar. Throws std::runtime_error where nothing stands before the ground: the picture is
/// then nowhere darker by more than an eye can distinguish.
Image drawn(const Picture& picture, const Layout& layout, const fs::path& file, OffscreenRenderer& renderer) {
  Image image = renderer.draw(picture);
  constexpr int visible = 24;  // of 255; the ground of an empty picture is one colour
  const auto [darkest, brightest] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  if (darkest == image.rgb.end() || *brightest - *darkest <= visible)
    throw std::runtime_error(file.stem().string() + ": nothing is to be seen in the picture");
  paint_bar(picture, layout, image);
  return image;
}

}  // namespace

void write_png(const Picture& picture, const fs::path& file) {
  OffscreenRenderer renderer;
  write_png(picture, file, renderer);
}

void write_png(const Picture& picture, const fs::path& file, OffscreenRenderer& renderer) {
  AtomicFile output(file);
  const Layout layout = layout_of(picture);
  write_lettered(picture, layout, drawn(picture, layout, file, renderer), {}, file.string(), output.temporary());
  pack_tightly(output.temporary());
  output.finish();
}

void write_print(const Picture& picture, double pixels_per_inch, const fs::path& png, const fs::path& pdf) {
  AtomicFile image_file(png), page_file(pdf);
  OffscreenRenderer renderer;
  const Layout layout = layout_of(picture);
  const Image image = drawn(picture, layout, png, renderer);
  write_lettered(picture, layout, image, {}, png.string(), image_file.temporary());
  set_resolution(image_file.temporary(), pixels_per_inch);
  write_lettered(picture, layout, image, {true, pixels_per_inch}, pdf.string(), page_file.temporary());
  erase_pdf_date(page_file.temporary());
  image_file.finish(), page_file.finish();
}

}  // namespace crosscheck::render
