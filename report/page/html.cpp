// Text as HTML, in which a number and its unit stay on one line; images inside the page.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "mysim/base/pattern.h"
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
  for (const char c : text) {
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

std::string prose_with_bold_numbers(const std::string& text) {
  // a number that stands by itself, with its unit
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

namespace {

/// A number in the head of a PNG: its width at byte 16, its height at byte 20.
unsigned png_number(const std::string& bytes, size_t at) {
  unsigned number = 0;
  for (size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes.at(i));
  return number;
}

}  // namespace

Json image_data(const PageImage& image) {
  const bool vectors = image.file.extension() == ".svg";
  const std::string bytes = vectors ? content_of_file(image.file) : render::with_few_colours(image.file);
  return {{"src", fmt::format("data:image/{};base64,{}", vectors ? "svg+xml" : "png", base64(bytes))},
          {"width", vectors ? 0 : png_number(bytes, 16)},  // so that a page does not move while it loads
          {"height", vectors ? 0 : png_number(bytes, 20)},
          {"alt", image.alt},
          {"caption", image.caption}};
}

}  // namespace crosscheck
