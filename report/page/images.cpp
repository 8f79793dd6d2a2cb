// Images inside the page.
#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "report/page/inline_svg.h"
#include "report/page/page.h"

namespace crosscheck {
namespace {

std::string base64(const std::string& bytes) {
  static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = std::min<size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (size_t j = 0; j < 3; ++j) word = word << 8 | (j < left ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (size_t j = 0; j < 4; ++j) out += j <= left ? alphabet[word >> (18 - 6 * j) & 63] : '=';
  }
  return out;
}

}  // namespace

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

std::string image_html(const PageImage& image, const std::string& css_class) {
  std::ifstream in(image.file, std::ios::binary);
  std::stringstream bytes;
  if (!in || !(bytes << in.rdbuf())) throw std::runtime_error("cannot read " + image.file.string());
  const std::string shown =
      image.file.extension() == ".svg"
          ? inline_svg(bytes.str(), image.alt, image.told)
          : fmt::format("<img src=\"data:image/png;base64,{}\" alt=\"{}\">", base64(bytes.str()), escaped(image.alt));
  return fmt::format("<figure class=\"{}\">{}<figcaption>{}</figcaption></figure>\n", css_class, shown,
                     escaped(image.caption));
}

}  // namespace crosscheck
