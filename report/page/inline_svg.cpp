// Rewrites gnuplot's SVG.
#include "report/page/inline_svg.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "mysim/base/hash.h"
#include "report/page/page.h"

namespace crosscheck {
namespace {

/// From `begin` to behind `end`; where it stands, or npos.
struct Part {
  size_t from, size;
};
Part part_of(const std::string& text, const std::string& begin, const std::string& end, size_t after = 0) {
  const size_t from = text.find(begin, after);
  if (from == std::string::npos) return {from, 0};
  const size_t to = text.find(end, from);
  if (to == std::string::npos) throw std::runtime_error("a drawing of gnuplot's without " + end);
  return {from, to + end.size() - from};
}

void remove(std::string& text, const std::string& begin, const std::string& end) {
  for (Part p = part_of(text, begin, end); p.from != std::string::npos; p = part_of(text, begin, end, p.from))
    text.erase(p.from, p.size);
}

/// Tenths as a number without what is not needed: -0.5 is -.5.
std::string tenths(long n) {
  std::string text = n < 0 ? "-" : "";
  n = std::abs(n);
  if (n >= 10 || n == 0) text += std::to_string(n / 10);
  if (n % 10) text += fmt::format(".{}", n % 10);
  return text;
}

void join(std::string& out, const std::string& number) {
  if (!out.empty() && (std::isdigit(static_cast<unsigned char>(out.back())) || out.back() == '.') && number[0] != '-')
    out += ' ';
  out += number;
}

/// "M1.23,4.56 L7.89,0.12 Z" with differences in tenths; what is more than moves and lines stays as it is.
std::string shorter_path(const std::string& path) {
  std::string out;
  long x = 0, y = 0;
  char last = 0;
  const char* at = path.c_str();
  while (true) {
    while (*at == ' ' || *at == '\n' || *at == '\t') ++at;
    if (!*at) return out;
    const char command = *at++;
    if (command == 'Z') {
      out += 'z', last = 0;
      continue;
    }
    if (command != 'M' && command != 'L') return path;
    char* end = nullptr;
    const long to_x = std::lround(10 * std::strtod(at, &end));
    if (end == at || *end != ',') return path;
    at = end + 1;
    const long to_y = std::lround(10 * std::strtod(at, &end));
    if (end == at) return path;
    at = end;
    if (command == 'M') {
      out += 'M' + tenths(to_x);
      join(out, tenths(to_y));
    } else {
      if (last != 'L') out += 'l';
      join(out, tenths(to_x - x));
      join(out, tenths(to_y - y));
    }
    x = to_x, y = to_y, last = command;
  }
}

/// Numbers with two decimals rounded to one, whatever stands around them.
std::string in_tenths(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    if (text[i] != '-' && !std::isdigit(static_cast<unsigned char>(text[i]))) {
      out += text[i++];
      continue;
    }
    char* end = nullptr;
    out += tenths(std::lround(10 * std::strtod(text.c_str() + i, &end)));
    i = static_cast<size_t>(end - text.c_str());
  }
  return out;
}

/// Replaces what stands in quotes behind `name=` by what `change` makes of it.
template <class Change>
void change_attribute(std::string& text, const std::string& name, Change change) {
  std::string out;
  size_t done = 0;
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, done)) {
    const size_t open = at + name.size(), close = text.find(text[open], open + 1);
    if (close == std::string::npos) throw std::runtime_error("a drawing of gnuplot's with an open quote");
    out.append(text, done, open + 1 - done);
    out += change(text.substr(open + 1, close - open - 1));
    done = close;
  }
  text = out + text.substr(done);
}

/// White space between and in tags, where one blank or nothing says the same; texts stay.
std::string without_white_space(const std::string& text) {
  std::string out;
  bool in_tag = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool blank = text[i] == ' ' || text[i] == '\n' || text[i] == '\t';
    if (text[i] == '<') in_tag = true;
    if (!blank || (!in_tag && text[i] == ' ')) {
      out += text[i];
    } else if (in_tag && out.back() != ' ') {
      out += ' ';
    }
    if (text[i] == '>') {
      in_tag = false;
      // indentation behind a tag, up to the next one
      size_t next = i + 1;
      while (next < text.size() && std::isspace(static_cast<unsigned char>(text[next]))) ++next;
      if (next < text.size() && text[next] == '<' && text.find('\n', i) < next) i = next - 1;
    }
  }
  return out;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// "rgb( 85,  85,  85)" as "#555555".
void shorten_colours(std::string& text) {
  for (Part p = part_of(text, "rgb(", ")"); p.from != std::string::npos; p = part_of(text, "rgb(", ")", p.from + 1)) {
    int r = 0, g = 0, b = 0;
    if (std::sscanf(text.c_str() + p.from, "rgb( %d , %d , %d", &r, &g, &b) == 3)
      text.replace(p.from, p.size, fmt::format("#{:02x}{:02x}{:02x}", r, g, b));
  }
}

/// Groups that hold nothing.
void remove_empty_groups(std::string& text) {
  for (size_t end = text.find("></g>"); end != std::string::npos; end = text.find("></g>", end)) {
    const size_t open = text.rfind('<', end);
    if (text.compare(open, 2, "<g") == 0)
      text.erase(open, end + 5 - open), end = open > 0 ? open - 1 : 0;
    else
      end += 5;
  }
}

/// Titles that only say a group's id, where gnuplot has no better one.
void remove_names(std::string& text) {
  const std::string begin = " id=\"", title = "\" ><title>";
  for (size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const size_t from = at + begin.size(), end = text.find('"', from);
    const std::string said = title + text.substr(from, end - from) + "</title>";
    if (text.compare(end, said.size(), said) == 0) text.replace(end, said.size(), "\">");
  }
}

/// Its title without the method, which the run that it plays names (page.js puts it in front again).
std::string title_of(const Tooltip& tip) {
  const std::string method = tip.run.substr(0, tip.run.rfind(' ')) + ", ";
  return escaped(!tip.run.empty() && tip.words.starts_with(method) ? tip.words.substr(method.size()) : tip.words);
}

/// Gives the shapes from a place on their words. Where there are more, the last is the key's sample.
void tell(std::string& body, size_t at, const std::string& shape, const std::vector<Tooltip>& tips) {
  const std::string open = "<" + shape + " ";
  for (const Tooltip& tip : tips) {
    at = at == std::string::npos ? at : body.find(open, at);
    if (at == std::string::npos) throw std::runtime_error("a drawing with fewer shapes than runs");
    const size_t close = body.find("/>", at);
    body.replace(close, 2, fmt::format("><title>{}</title></{}>", title_of(tip), shape));
    body.insert(at + open.size(),
                tip.run.empty() ? "class=\"told\" " : fmt::format("data-run=\"{}\" ", escaped(tip.run)));
    at = close;
  }
}

constexpr std::string_view inner = "<g stroke='none' shape-rendering='crispEdges'>", open = "<polygon fill = '",
                           points = "' points = '", close = "'/></g><path stroke='#ffffff' d='", end = "'/></g>";

/// Where a text ends that must stand right at a place, or npos.
size_t behind(const std::string& body, size_t place, std::string_view text) {
  return place != std::string::npos && body.compare(place, text.size(), text) == 0 ? place + text.size()
                                                                                   : std::string::npos;
}

/// The drawing with each box that has a white border as a polygon alone, a third of the text: the page's style gives it
/// the border. Whatever else is in it stays. For drawings that inline_svg() has cleaned already.
void join_boxes_and_borders(std::string& body) {
  std::string out;
  size_t done = 0;
  for (size_t at = body.find(inner); at != std::string::npos; at = body.find(inner, at + 1)) {
    // <g ...><g stroke='none' ...><polygon fill = 'f' points = 'p '/></g><path stroke='#ffffff' d='...'/></g>
    const size_t outer = body.rfind('<', at - 1), fill = behind(body, at + inner.size(), open);
    if (fill == std::string::npos || behind(body, outer, "<g ") == std::string::npos) continue;
    const size_t fill_end = body.find('\'', fill), corners = behind(body, fill_end, points);
    const size_t corners_end = corners == std::string::npos ? corners : body.find('\'', corners);
    const size_t border = behind(body, corners_end, close);
    if (border == std::string::npos) continue;
    const size_t box_end = behind(body, body.find('\'', border), end);
    if (box_end == std::string::npos) continue;
    out.append(body, done, outer - done);
    out += fmt::format("<polygon fill=\"{}\" points=\"{}\"/>", body.substr(fill, fill_end - fill),
                       body.substr(corners, body.find_last_not_of(' ', corners_end - 1) + 1 - corners));
    done = box_end;
  }
  body = out + body.substr(done);
}

}  // namespace

std::string deduplicate_markers(const std::string& page) {
  const std::string begin = "<defs><circle id='gpDot'", body = "<body>";
  std::string out, shapes;
  size_t done = 0;
  for (Part p = part_of(page, begin, "</defs>"); p.from != std::string::npos;
       p = part_of(page, begin, "</defs>", p.from + p.size)) {
    if (shapes.empty()) shapes = page.substr(p.from, p.size);
    out.append(page, done, p.from - done);
    done = p.from + p.size;
  }
  out += page.substr(done);
  // in a drawing of no size of their own: where none is shown, or the first is folded away, the others need them
  if (const size_t at = out.find(body); !shapes.empty() && at != std::string::npos)
    out.insert(at + body.size(),
               "<svg width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\">" + shapes + "</svg>");
  return out;
}

std::string inline_svg(const std::string& svg, const std::string& alt, const Tooltips& tooltips) {
  const Part head = part_of(svg, "<svg", ">");
  const std::string view = "viewBox=\"";
  const size_t box = svg.find(view), end = svg.rfind("</svg>");
  if (head.from == std::string::npos || box > head.from + head.size || end == std::string::npos)
    throw std::runtime_error("no drawing of gnuplot's");
  const std::string seen = svg.substr(box, svg.find('"', box + view.size()) + 1 - box);
  std::string body = svg.substr(head.from + head.size, end - head.from - head.size);
  remove(body, "<desc>", "</desc>");
  if (const Part title = part_of(body, "<title>", "</title>"); title.from != std::string::npos)
    body.erase(title.from, title.size);  // the file's name; those of curves follow
  shorten_colours(body);
  change_attribute(body, " d=", shorter_path);
  change_attribute(body, "points = ", in_tenths);
  change_attribute(body, "transform=", [](const std::string& text) {
    const Part moved = part_of(text, "translate(", ")");
    if (moved.from != 0) return text;
    return in_tenths(text.substr(0, moved.size)) + text.substr(moved.size);
  });
  body = without_white_space(body);
  replace_all(body, " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"", "");  // as they are without
  replace_all(body, "xlink:href", "href");
  // what nearly every group says is said once, around all
  replace_all(body, "<g fill=\"none\" color=\"black\" stroke=\"currentColor\" stroke-width=\"1.00\">", "<g>");
  replace_all(body, " font-family=\"DejaVu Sans\"", "");
  replace_all(body, " font-size=\"12.00\"", "");
  replace_all(body, "font-family=\"DejaVu Sans:Bold\"", "font-weight=\"bold\"");
  replace_all(body, "fill=\"#ffffff\"/>", "fill=\"#ffffff\" stroke=\"none\"/>");  // the paper
  replace_all(body, "<title>gnuplot_canvas</title>", "");
  replace_all(body, " id=\"gnuplot_canvas\"", "");  // one for each drawing, which a page must not have twice
  remove_names(body);
  // of another drawing with patterns of its own
  replace_all(body, "gpPat", fmt::format("gpPat{:x}-", Fnv1a::of(body)));
  remove_empty_groups(body);
  if (!tooltips.boxes.empty()) join_boxes_and_borders(body);
  for (size_t i = 0; i < tooltips.markers.size(); ++i)
    if (!tooltips.markers[i].empty())
      tell(body, body.find(fmt::format("_plot_{}\"", i + 1)), "use", tooltips.markers[i]);
  tell(body, 0, "polygon", tooltips.boxes);
  return fmt::format(
      "<svg {} role=\"img\" aria-label=\"{}\"><g fill=\"none\" color=\"black\" stroke=\"currentColor\" "
      "font-family=\"DejaVu Sans\" font-size=\"12\">{}</g></svg>",
      seen, escaped(alt), body);
}

namespace {

struct Tag {
  size_t from, size;
  std::string_view bytes, width, height, alt;
};

/// The quoted text behind `name="` in a tag.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const size_t at = tag.find(name);
  if (at == std::string_view::npos) return "";
  const size_t from = at + name.size();
  return tag.substr(from, tag.find('"', from) - from);
}

std::vector<Tag> pictures_in(std::string_view page) {
  std::vector<Tag> tags;
  const std::string_view begin = "<img src=\"data:image/png";
  for (size_t at = page.find(begin); at != std::string_view::npos; at = page.find(begin, at + 1)) {
    const std::string_view tag = page.substr(at, page.find('>', at) + 1 - at);
    tags.push_back({at, tag.size(), attribute(tag, "src=\""), attribute(tag, " width=\""), attribute(tag, " height=\""),
                    attribute(tag, " alt=\"")});
  }
  return tags;
}

}  // namespace

std::string deduplicate_pictures(const std::string& page) {
  const std::vector<Tag> tags = pictures_in(page);
  std::map<std::string_view, int> uses, names;
  for (const Tag& tag : tags) ++uses[tag.bytes];
  std::string out;
  size_t done = 0;
  for (const Tag& tag : tags) {
    if (uses[tag.bytes] < 2) continue;
    const auto [name, first] = names.emplace(tag.bytes, static_cast<int>(names.size()) + 1);
    out.append(page, done, tag.from - done);
    out += fmt::format("<svg class=\"picture\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", tag.width,
                       tag.height, tag.alt);
    out += first ? fmt::format("<image id=\"picture-{}\" width=\"{}\" height=\"{}\" href=\"{}\"/></svg>", name->second,
                               tag.width, tag.height, tag.bytes)
                 : fmt::format("<use href=\"#picture-{}\"/></svg>", name->second);
    done = tag.from + tag.size;
  }
  return out + page.substr(done);
}

}  // namespace crosscheck
