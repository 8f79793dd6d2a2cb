// One pass over the tags, one over each path.
#include "report/page/slim_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace crosscheck {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  std::string out;
  size_t at = 0;
  for (size_t next; (next = text.find(from, at)) != std::string::npos; at = next + from.size())
    out.append(text, at, next - at).append(to);
  text = out.append(text, at);
}

/// A number of tenths in as few signs as can be, parted from what stands before it.
std::string tenths(long n, bool parted) {
  std::string digits = fmt::format("{}", std::labs(n) / 10);
  if (n % 10 != 0) digits = (digits == "0" ? "" : digits) + fmt::format(".{}", std::labs(n) % 10);
  return (n < 0 ? "-" : parted ? " " : "") + digits;
}

/// Moves and lines between points, "M1.00,2.00 L3.00,4.00", from point to point; any other path as it is.
std::string slim_path(const std::string& path) {
  std::string out;
  long x = 0, y = 0;
  bool first = true;
  for (size_t at = path.find_first_not_of(' '); at < path.size(); at = path.find_first_not_of(' ', at)) {
    const char kind = path[at];
    if ((kind == 'Z' || kind == 'z') && !first) {
      out += 'z', ++at;
      continue;
    }
    char* end = nullptr;
    if (kind != 'M' && kind != 'L') return path;
    const double to_x = std::strtod(path.c_str() + at + 1, &end);
    if (*end != ',') return path;
    const double to_y = std::strtod(end + 1, &end);
    at = static_cast<size_t>(end - path.c_str());
    const long next_x = std::lround(10 * to_x), next_y = std::lround(10 * to_y);
    if (kind == 'M')
      out += "M" + tenths(next_x, false) + tenths(next_y, true);
    else if (next_y == y && next_x != x)
      out += "h" + tenths(next_x - x, false);
    else if (next_x == x && next_y != y)
      out += "v" + tenths(next_y - y, false);
    else
      out += "l" + tenths(next_x - x, false) + tenths(next_y - y, true);
    x = next_x, y = next_y, first = false;
  }
  return out;
}

/// Corners "1.00,2.00 3.00,4.00", to a tenth; anything else as it is.
std::string slim_points(const std::string& points) {
  std::string out;
  const char* at = points.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const double x = std::strtod(at, &end);
    if (end == at || *end != ',') return points;
    const double y = std::strtod(end + 1, &end);
    out += tenths(std::lround(10 * x), !out.empty()) + tenths(std::lround(10 * y), true);
    for (at = end; *at == ' ';) ++at;
  }
  return out;
}

/// White space as one blank; with a line's end, none between tags.
std::string without_lines(const std::string& text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    size_t next = at;
    while (next < text.size() && std::isspace(static_cast<unsigned char>(text[next]))) ++next;
    if (next == at) {
      out += text[at++];
      continue;
    }
    const bool line = text.find('\n', at) < next, outside = !out.empty() && out.back() == '>';
    if (!line || !outside || (next < text.size() && text[next] != '<')) out += ' ';
    at = next;
  }
  return out;
}

/// Attributes in single quotes, paths slim, colours in hexadecimal digits; blanks before the end are gone.
std::string slim_tag(const std::string& tag) {
  std::string out;
  for (size_t at = 0; at < tag.size();) {
    const size_t open = tag.find_first_of("\"'", at);
    const size_t close = open == std::string::npos ? open : tag.find(tag[open], open + 1);
    if (close == std::string::npos) return out.append(tag, at);
    std::string value = tag.substr(open + 1, close - open - 1);
    std::string name = tag.substr(at, open - at);
    replace_all(name, " =", "="), replace_all(name, "= ", "=");
    if (name.ends_with(" d=")) value = slim_path(value);
    if (name.ends_with(" points=")) value = slim_points(value);
    int r, g, b;
    if (std::sscanf(value.c_str(), "rgb(%d,%d,%d)", &r, &g, &b) == 3)
      value = fmt::format("#{:02x}{:02x}{:02x}", r, g, b);
    const char quote = value.find('\'') == std::string::npos ? '\'' : '"';
    out += name + quote + value + quote;
    at = tag.find_first_not_of(' ', close + 1);
    if (at < tag.size() && at > close + 1 && tag[at] != '/' && tag[at] != '>') --at;
  }
  return out;
}

/// Goes from tag to tag; a group without content, and an empty last part of a text, are taken back.
std::string slim_tags(const std::string& text) {
  std::string out;
  size_t opened = std::string::npos;  // where the last tag begins in `out`, if it opens something and nothing followed
  for (size_t at = 0; at < text.size();) {
    if (text[at] != '<') {
      opened = std::string::npos;
      const size_t next = std::min(text.find('<', at), text.size());
      out.append(text, at, next - at);
      at = next;
      continue;
    }
    const size_t end = std::min(text.find('>', at), text.size() - 1) + 1;
    const std::string tag = text.substr(at, end - at);
    at = end;
    const bool last_part = tag == "</tspan>" && text.compare(at, 7, "</text>") == 0;
    if (opened != std::string::npos && (tag == "</g>" || last_part) &&
        out.compare(opened, 2, tag == "</g>" ? "<g" : "<t") == 0) {
      out.resize(opened);
      opened = std::string::npos;
      // the group around it may hold nothing else
      if (const size_t before = out.rfind('<');
          before != std::string::npos && out.back() == '>' && out.compare(before, 2, "<g") == 0)
        opened = before;
      continue;
    }
    opened = tag.starts_with("</") || tag.ends_with("/>") ? std::string::npos : out.size();
    out += slim_tag(tag);
  }
  return out;
}

/// Markers and filters that gnuplot defines in every file, those that are not used.
void drop_unused(std::string& text, const std::string& id, const std::string& close) {
  const size_t at = text.find("id='" + id + "'");
  if (at == std::string::npos || text.find("#" + id + "'") != std::string::npos ||
      text.find("#" + id + ")") != std::string::npos)
    return;
  const size_t begin = text.rfind('<', at), end = text.find(close, at);
  if (end != std::string::npos) text.erase(begin, end + close.size() - begin);
}

/// Whether the attribute has no other value anywhere.
bool nobody_else(const std::string& text, const std::string& rule) {
  const std::string name = rule.substr(0, rule.find('=') + 1);
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if (text.compare(at, rule.size(), rule) != 0) return false;
  return true;
}

}  // namespace

std::string slim_svg(const std::string& text) {
  std::string out = slim_tags(without_lines(text));
  for (int i = 14; i >= 0; --i) drop_unused(out, fmt::format("gpPt{}", i), "/>");
  drop_unused(out, "gpDot", "/>");
  for (const char* filter : {"textbox", "greybox"}) drop_unused(out, filter, "</filter>");
  // what holds where nobody says otherwise
  for (const std::string rule : {" stroke-linecap='butt'", " stroke-linejoin='miter'"})
    if (nobody_else(out, rule)) replace_all(out, rule, "");
  replace_all(out, " font-family='DejaVu Sans'", "");
  const std::string common = "<g fill='none' color='black' stroke='currentColor' stroke-width='1.00'>";
  if (const size_t head = out.find('>', out.find("<svg"));
      head != std::string::npos && out.find("<svg") != std::string::npos) {
    replace_all(out, common, "<g class='g'>");
    replace_all(out, "<g stroke='none' shape-rendering='crispEdges'>", "<g class='c'>");
    out.insert(
        head + 1,
        "<style>svg{font-family:DejaVu Sans,sans-serif}.g{fill:none;color:black;stroke:currentColor;stroke-width:1}"
        ".c{stroke:none;shape-rendering:crispEdges}</style>");
  }
  return out;
}

std::string svg_address(const std::string& text) {
  std::string out = "data:image/svg+xml;charset=utf-8,";
  for (const char c : text) {
    if (c == '%')
      out += "%25";
    else if (c == '#')
      out += "%23";
    else if (c == '"')
      out += "%22";
    else if (c == '&')
      out += "%26";
    else if (c == '/' &&
             out.ends_with('/'))  // names of name spaces look like addresses: a page that needs none has none
      out += "%2F";
    else
      out += c;
  }
  return out;
}

}  // namespace crosscheck
