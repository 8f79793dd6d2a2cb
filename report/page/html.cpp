// Text as HTML that keeps a number and its unit on one line; embedded images.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mysim/base/pattern.h"
#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/page/page.h"
#include "report/pictures/picture.h"

namespace crosscheck {
std::string prose(const std::string& text) {
  // `following`: "8 x 8", "0.32 ± 0.01", "< 3"; `unit`: also groups of thousands; `negative`, `positive`: "1.0e-12"
  static const Pattern following("( x|\\(of|±|<) (?=\\d)"),
      unit(
          "(\\d) (?=(?:%|mm/s|m/s|mm|µm|ms|µs|m|s|J|Hz|kg|N/m|N|MB|ω|±|x|times|degrees)(?![A-Za-z])|\\d{3}(?![\\d.]))"),
      negative("(\\d)e-0*(\\d+)"), positive("(\\d)e\\+0*(\\d+)");
  const std::string whole = unit.replaced_in(following.replaced_in(text, "$1\u00a0"), "$1\u00a0");
  return positive.replaced_in(
      negative.replaced_in(escaped(whole), "$1<span class=\"n\">\u00a0×\u00a010<sup>−$2</sup></span>"),
      "$1<span class=\"n\">\u00a0×\u00a010<sup>$2</sup></span>");
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string prose_with_bold_numbers(const std::string& text) {
  // a number that is not part of a word, with its unit
  static const Pattern number(
      "(^|[ (±])(\\d+(?:\\.\\d+)?(?:<span "
      "class=\"n\">[^/]*</sup></span>)?(?:\u00a0(?:%|mm|µm|nm|ms|µs|m|s|times))?)(?![\\w</])");
  return number.replaced_in(prose(text), "$1<b>$2</b>");
}

std::string narrow_prose(const std::string& text) {
  static const Pattern slash("/(?![^<]*>)");
  return slash.replaced_in(prose(text), "/<wbr>");
}

std::string markdown_html(const std::string& text) {
  static const Pattern strong("\\*\\*([^*]+)\\*\\*"), emphasis("\\*([^*]+)\\*"), code("`([^`]+)`"), gap("\\n\\s*\\n"),
      end("\\s+$");
  const std::string inside =
      code.replaced_in(emphasis.replaced_in(strong.replaced_in(end.replaced_in(text, ""), "<b>$1</b>"), "<em>$1</em>"),
                       "<code>$1</code>");
  return "<p>" + gap.replaced_in(inside, "</p>\n<p>") + "</p>\n";
}

std::string json_for_script(const std::string& json) {
  std::string safe;
  for (const char sign : json) sign == '<' ? safe += "\\u003c" : safe += sign;
  return safe;
}

Json image_data(const PageImage& image) {
  const bool vectors = image.file.extension() == ".svg";
  const render::Image pixels = vectors ? render::Image() : render::read_png(image.file);
  const std::string bytes = vectors ? content_of_file(image.file) : render::webp_bytes(pixels);
  return {{"src", fmt::format("data:image/{};base64,{}", vectors ? "svg+xml" : "webp", base64(bytes))},
          {"width", pixels.width},  // lets the browser reserve space while the page loads
          {"height", pixels.height},
          {"alt", image.alt},
          {"caption", image.caption}};
}

}  // namespace crosscheck
