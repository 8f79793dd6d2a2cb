// Which method for which scene: what the page opens with.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "report/page/page.h"

namespace crosscheck {

std::string choice_table_html(const std::vector<ScenePart>& scenes) {
  std::string out =
      "<section id=\"scenes\">\n<h2>Which method for which scene?</h2>\n<div class=\"scroll\"><table "
      "class=\"choice\"><thead><tr><th>scene</th>";
  // a column in which nothing stands is left out
  std::vector<size_t> shown;
  for (size_t i = 0; i < choice_columns().size(); ++i)
    if (std::any_of(scenes.begin(), scenes.end(), [i](const ScenePart& part) { return !part.choice.at(i).empty(); }))
      shown.push_back(i);
  for (const size_t i : shown) out += fmt::format("<th>{}</th>", prose(choice_columns()[i].head));
  out += "</tr></thead><tbody>\n";
  for (const ScenePart& part : scenes) {
    out += fmt::format("<tr><th scope=\"row\"><a href=\"#{0}\" title=\"{1}\">{0}</a></th>", escaped(part.scene->name),
                       escaped(part.scene->question));
    for (const size_t i : shown)
      out += fmt::format("<td class=\"{}\">{}</td>", part.choice[i].look, prose(part.choice[i].text));
    out += "</tr>\n";
  }
  out +=
      "</tbody></table></div>\n<p class=\"note\">Errors at the scene's own step, in % of its motion (*: by steps of "
      "the method's own); in bold who is "
      "nearest, or within 5 % of the nearest; – where nothing was asked, or cannot be said. What each <a "
      "href=\"#methods\">method</a> is; what "
      "is meant by";
  const char* mark = " ";
  for (const size_t i : shown) out += std::exchange(mark, ", ") + term_link(choice_columns()[i].term);
  return out + ".</p>\n</section>\n";
}

}  // namespace crosscheck
