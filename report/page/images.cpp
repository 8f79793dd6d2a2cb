// Images inside the page.
#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "report/base64.h"
#include "report/page/inline_svg.h"
#include "report/page/page.h"

namespace crosscheck {

std::string content_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream bytes;
  if (!in || !(bytes << in.rdbuf())) throw std::runtime_error("cannot read " + file.string());
  return bytes.str();
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

namespace {

/// A number of a PNG's head: at byte 16 its width, at byte 20 its height. Throws std::runtime_error where there is
/// none.
unsigned png_number(const std::string& bytes, size_t at) {
  if (bytes.size() < at + 4) throw std::runtime_error("a picture that is no PNG");
  unsigned number = 0;
  for (size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}

}  // namespace

std::string image_tag(const PageImage& image) {
  const std::string bytes = content_of_file(image.file);
  if (image.file.extension() == ".svg") return inline_svg(bytes, image.alt, image.told);
  // so that a page does not move while it loads
  return fmt::format("<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", base64(bytes),
                     png_number(bytes, 16), png_number(bytes, 20), escaped(image.alt));
}

std::string image_html(const PageImage& image, const std::string& css_class) {
  const std::string runs = image.runs.empty() ? "" : fmt::format(" data-runs=\"{}\"", escaped(image.runs));
  const std::string id =
      image.file.extension() == ".svg" ? fmt::format(" id=\"figure-{}\"", escaped(image.file.stem().string())) : "";
  return fmt::format("<figure class=\"{}\"{}{}>{}<figcaption>{}</figcaption></figure>\n", css_class, id, runs,
                     image_tag(image), prose(image.caption));
}

}  // namespace crosscheck
