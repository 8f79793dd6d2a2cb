// Text and images as HTML: a number and its unit stay on one line.

#include <fmt/format.h>

#include <stdexcept>

#include "mysim/base/text.h"
#include "report/base/assets.h"
#include "report/page/page.h"
#include "report/pictures/png_file.h"

namespace crosscheck {
namespace {

constexpr std::string_view no_break_space = "\u00a0";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) > 127;
}

/// Whether a unit, three digits of a longer number or "±" stand at the beginning.
bool holds_on(std::string_view rest) {
  static constexpr std::string_view units[] = {"%",  "mm/s", "m/s", "mm", "µm", "ms", "µs", "m", "s",     "J",
                                               "Hz", "kg",   "N/m", "N",  "MB", "ω",  "±",  "x", "times", "degrees"};
  for (const std::string_view unit : units)
    if (rest.starts_with(unit) && (rest.size() == unit.size() || !is_letter(rest[unit.size()]))) return true;
  return rest.size() >= 3 && is_digit(rest[0]) && is_digit(rest[1]) && is_digit(rest[2]) &&
         (rest.size() == 3 || !(is_digit(rest[3]) || rest[3] == '.'));
}

/// The text in front stays attached, too: "8 x 8", "0.32 ± 0.01".
bool holds_what_follows(std::string_view before) {
  return before.ends_with(" x") || before.ends_with("(of") || before.ends_with("±") || before.ends_with("<");
}

/// "e-4" in one piece, where a browser would break behind the hyphen. Of escaped text.
std::string with_whole_exponents(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    size_t end = i + 2;
    if (i > 0 && is_digit(text[i - 1]) && text.compare(i, 2, "e-") == 0)
      while (end < text.size() && is_digit(text[end])) ++end;
    if (end == i + 2) {
      out += text[i++];
      continue;
    }
    out += "<span class=\"n\">\u00a0×\u00a010<sup>−" + text.substr(i + 2, end - i - 2) + "</sup></span>";
    i = end;
  }
  return out;
}

}  // namespace

std::string prose(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const std::string_view before = std::string_view(text).substr(0, i), rest = std::string_view(text).substr(i + 1);
    const bool holds = text[i] == ' ' && i > 0 &&
                       ((is_digit(text[i - 1]) && holds_on(rest)) ||
                        (holds_what_follows(before) && !rest.empty() && is_digit(rest[0])));
    if (holds)
      out += no_break_space;
    else
      out += text[i];
  }
  return with_whole_exponents(escaped(out));
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
  if (image.file.extension() == ".svg")
    return fmt::format("<img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\">", base64(content_of_file(image.file)),
                       escaped(image.alt));
  const std::string bytes = render::with_few_colours(image.file);
  // so that a page does not move while it loads
  return fmt::format("<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", base64(bytes),
                     png_number(bytes, 16), png_number(bytes, 20), escaped(image.alt));
}

std::string image_html(const PageImage& image, const std::string& css_class) {
  return fmt::format("<figure class=\"{}\">{}<figcaption>{}</figcaption></figure>\n", css_class, image_tag(image),
                     prose(image.caption));
}

}  // namespace crosscheck
