// Panels for print: letters have a size of their own, and panels make room for them.
#include <algorithm>

#include "report/render/picture.h"
#include "report/render/text_width.h"

namespace crosscheck::render {
namespace {

constexpr double fill = 0.92;  // of a panel's width that letters may take

/// Whether all titles fit into panels of this width (in units of the font size) when they are wrapped.
bool titles_fit(const std::vector<Panel>& panels, double room) {
  return std::all_of(panels.begin(), panels.end(), [room](const Panel& panel) {
    const auto lines = lines_of(wrapped(panel.title, true, room));
    return std::all_of(lines.begin(), lines.end(), [&](const auto& line) { return text_width(line, true) <= room; });
  });
}

}  // namespace

void arrange(Picture& picture, double aspect) {
  std::vector<Panel> panels = std::move(picture.rows[0]);
  const double width = fill * picture.width / picture.text;
  std::size_t columns = panels.size();
  while (columns > 1 && !titles_fit(panels, width / double(columns))) --columns;
  // as many in each row as can be, so that few places stay empty
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  columns = (panels.size() + rows - 1) / rows;
  picture.rows.clear();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i % columns == 0) picture.rows.emplace_back();
    panels[i].title = wrapped(panels[i].title, true, width / double(columns));
    panels[i].subtitle = wrapped(panels[i].subtitle, false, width / double(columns));
    picture.rows.back().push_back(std::move(panels[i]));
  }
  picture.height = height_for(picture, aspect);
}

}  // namespace crosscheck::render
