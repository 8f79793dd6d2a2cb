// The way through the page: one line that stays in sight.
#include <fmt/format.h>

#include "report/page/page.h"

namespace crosscheck {

std::string contents_html(const PageContent& c) {
  std::string out = "<nav aria-label=\"Contents\">\n<a href=\"#scenes\">Which method</a>\n";
  if (!c.against.empty()) out += "<a href=\"#changes\">What changed</a>\n";
  for (const Chapter& chapter : c.chapters)
    if (!chapter.entries.empty())
      out += fmt::format("<a href=\"#{}\" title=\"{}\">{}</a>\n", chapter.id, escaped(chapter.title),
                         escaped(chapter.label.empty() ? chapter.title : chapter.label));
  if (!c.scenes.empty()) {
    // opens below the pointer and below the keys alike
    out += fmt::format("<span class=\"menu\"><a href=\"#{}\">Scenes</a><span class=\"list\">\n",
                       escaped(c.scenes[0].scene->name));
    for (const ScenePart& part : c.scenes) out += fmt::format("<a href=\"#{0}\">{0}</a>\n", escaped(part.scene->name));
    out += "</span></span>\n";
  }
  return out + "<a href=\"#words\">Words</a>\n<a href=\"#made\">How it was made</a>\n</nav>\n";
}

}  // namespace crosscheck
