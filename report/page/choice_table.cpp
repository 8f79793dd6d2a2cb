// Which method for which scene: what the page opens with.
#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "report/page/page.h"

namespace crosscheck {

std::string choice_table_html(const std::vector<ScenePart>& scenes) {
  std::string out =
      "<section id=\"scenes\">\n<h2>Which method for which scene?</h2>\n<div class=\"scroll\"><table "
      "class=\"choice\"><thead><tr><th>scene</th>";
  for (const ChoiceColumn& column : choice_columns()) out += fmt::format("<th>{}</th>", prose(column.head));
  out += "</tr></thead><tbody>\n";
  for (const ScenePart& part : scenes) {
    out += fmt::format("<tr><th scope=\"row\"><a href=\"#{0}\" title=\"{1}\">{0}</a></th>", escaped(part.scene->name),
                       escaped(part.scene->question));
    for (const ChoiceCell& cell : part.choice)
      out += fmt::format("<td class=\"{}\">{}</td>", cell.look, prose(cell.text));
    out += "</tr>\n";
  }
  out +=
      "</tbody></table></div>\n<p class=\"note\">Errors at the scene's own step, in % of its motion; in bold who is "
      "nearest, or within 5 % of the nearest; – where nothing was asked, or cannot be said. What is meant by";
  const char* mark = " ";
  for (const ChoiceColumn& column : choice_columns())
    if (column.term != std::string_view()) out += std::exchange(mark, ", ") + term_link(column.term);
  return out + ".</p>\n</section>\n";
}

}  // namespace crosscheck
