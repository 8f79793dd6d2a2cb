#include "report/page/svg_cells.h"

#include <fmt/format.h>

namespace crosscheck {
namespace {

constexpr std::string_view inner = "<g stroke='none' shape-rendering='crispEdges'>", open = "<polygon fill = '",
                           points = "' points = '", close = "'/></g><path stroke='#ffffff' d='", end = "'/></g>";

/// Where a text ends that must stand right at a place, or npos.
size_t behind(const std::string& body, size_t place, std::string_view text) {
  return place != std::string::npos && body.compare(place, text.size(), text) == 0 ? place + text.size()
                                                                                   : std::string::npos;
}

}  // namespace

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

}  // namespace crosscheck
