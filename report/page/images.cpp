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

std::string image_tag(const PageImage& image) {
  const std::string bytes = content_of_file(image.file);
  if (image.file.extension() == ".svg") return inline_svg(bytes, image.alt, image.told);
  return fmt::format("<img src=\"data:image/png;base64,{}\" alt=\"{}\">", base64(bytes), escaped(image.alt));
}

std::string image_html(const PageImage& image, const std::string& css_class) {
  return fmt::format("<figure class=\"{}\">{}<figcaption>{}</figcaption></figure>\n", css_class, image_tag(image),
                     prose(image.caption));
}

}  // namespace crosscheck
