// A chapter: the answer, the figures that open it, what teaches why, and the rest in folds.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "report/base/assets.h"
#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"
#include "report/page/smaller.h"

namespace crosscheck {

std::string figure_html(const PageFigure& figure, const PageContent& page) {
  std::string ways;
  for (const char* form : {"pdf", "csv", "gp"})
    if (std::filesystem::exists(page.figures / (figure.name + "." + form)))
      ways += fmt::format("<a href=\"figures/{}.{}\">{}</a>", escaped(figure.name), form, form);
  return fmt::format(
      "<figure class=\"chart\" id=\"figure-{0}\"{1}><div class=\"drawn\" data-chart=\"{0}\"></div><figcaption>{2}"
      "</figcaption><p class=\"ways\">{3}</p></figure>\n",
      escaped(figure.name), figure.runs.empty() ? "" : fmt::format(" data-runs=\"{}\"", escaped(figure.runs)),
      prose(figure.caption), ways);
}

std::string fold_html(const std::string& heading, const std::string& kind, const std::string& contents,
                      const std::string& id) {
  return fmt::format(
      "<details class=\"fold\"{}><summary><span>{}</span><span class=\"kind\">{}</span></summary><template>{}"
      "</template></details>\n",
      id.empty() ? "" : fmt::format(" id=\"{}\"", id), prose(heading), kind, contents);
}

std::string findings_html(const std::vector<Finding>& findings) {
  std::string out = "<ul class=\"findings\">\n";
  for (const Finding& f : findings)
    out += fmt::format(
        "<li>{} <span class=\"tier\">{}</span></li>\n", prose(sentence_of(f)),
        tier_of(f) == "measured" || tier_of(f) == "see each scene" ? tier_of(f) : "against: " + escaped(tier_of(f)));
  return out + "</ul>\n";
}

namespace {

bool matches(const std::string& name, const std::string& pattern) {
  const size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern;
  return name.size() + 1 >= pattern.size() && name.starts_with(pattern.substr(0, star)) &&
         name.ends_with(pattern.substr(star + 1));
}

/// What a name that matches has in place of the pattern's star.
std::string starred_part(const std::string& name, const std::string& pattern) {
  return name.substr(0, name.size() + 1 - std::min(name.size() + 1, pattern.size()));
}

/// A figure that opens a chapter.
struct Lead {
  const Chapter::Entry* entry;
  size_t figure;       // of the entry's
  std::string choice;  // what its name has in place of the pattern's star
};

/// The figures of the first pattern that any has; that of the main scene before the others.
std::vector<Lead> leads_of(const Chapter& chapter, const PageContent& c) {
  for (const std::string& pattern : chapter.leads) {
    std::vector<Lead> leads;
    for (const Chapter::Entry& entry : chapter.entries)
      for (size_t i = 0; i < entry.figures.size(); ++i)
        if (const std::string& name = entry.figures[i].name; matches(name, pattern))
          leads.push_back({&entry, i, starred_part(name, pattern)});
    std::ranges::stable_partition(leads, [&](const Lead& lead) { return lead.choice == c.main_scene; });
    if (!leads.empty()) return leads;
  }
  return {};
}

/// Buttons that choose which of several elements is in sight, the first at first: ids, and what stands on the buttons.
std::string choices_html(const std::vector<std::pair<std::string, std::string>>& choices) {
  std::string out;
  for (const auto& [id, label] : choices)
    out += fmt::format("<button type=\"button\" data-figure=\"{}\" aria-pressed=\"{}\">{}</button>", escaped(id),
                       out.empty(), prose(label));
  return "<div class=\"choices\">" + out + "</div>\n";
}

/// One of them at a time, with buttons to choose.
std::string leads_html(const std::vector<Lead>& leads, const PageContent& c) {
  std::vector<std::pair<std::string, std::string>> choices;
  for (const Lead& lead : leads) choices.emplace_back("figure-" + lead.entry->figures[lead.figure].name, lead.choice);
  std::string out = leads.size() > 1 ? choices_html(choices) : "";
  for (const Lead& lead : leads) {
    std::string figure = figure_html(lead.entry->figures[lead.figure], c);
    if (&lead != &leads.front()) figure.insert(std::string_view("<figure").size(), " hidden");
    out += figure;
  }
  return out;
}

std::string entry_html(const Chapter::Entry& entry, const PageContent& c) {
  std::string out = entry.text.empty() ? "" : fmt::format("<p class=\"soft\">{}</p>\n", prose(entry.text));
  for (const PageFigure& figure : entry.figures) out += figure_html(figure, c);
  for (const PageImage& image : entry.images)
    if (std::filesystem::exists(image.file)) out += image_html(image, "render");  // why not, is among the problems
  for (const PageTable& table : entry.tables) out += page_table_html(table);
  return out;
}

/// Pictures in a row, and the chart that belongs to them beside them.
std::string shown_html(const Chapter::Entry& entry, const PageContent& c) {
  std::string pictures;
  for (const PageImage& image : entry.images)
    if (std::filesystem::exists(image.file)) pictures += image_html(image, "render");
  for (const PageFigure& figure : entry.figures) pictures += figure_html(figure, c);
  return fmt::format("<h3>{}</h3>\n{}\n", prose(entry.heading),
                     entry.images.empty() ? "<div class=\"lead\"><div>" + pictures + "</div></div>"
                                          : "<div class=\"moments\">" + pictures + "</div>");
}

std::string kind_of(const Chapter::Entry& entry) {
  return !entry.figures.empty()  ? "chart"
         : !entry.images.empty() ? "picture"
         : !entry.tables.empty() ? "table"
                                 : "text";
}

/// The drawing of a lead figure for readers without JavaScript, unchanged.
std::string drawing_without_script(const PageFigure& lead, const PageContent& c) {
  const std::filesystem::path file = c.figures / (lead.name + ".svg");
  if (!std::filesystem::exists(file)) return "";
  return "<noscript>" + svg_element(content_of_file(file), lead.title) + "</noscript>";
}

/// "{critical}" in a formula becomes the fastest frequency and the critical step of the main scene, where both are
/// known: leapfrog's limit is 2 / omega, whatever the drag.
std::string with_critical_step(std::string formula, const PageContent& c) {
  static constexpr std::string_view mark = "{critical}";
  const size_t at = formula.find(mark);
  if (at == std::string::npos) return formula;
  std::string text;
  for (const ScenePart& part : c.scenes) {
    const MethodData* m = part.facts->find(subject_method(is_symplectic_of_second_order));
    if (part.scene->name == c.main_scene && m && m->limit && *m->limit > 0)
      text = fmt::format(". On {}, as it starts: <em>ω</em> = {} /s, so <em>h</em> &lt; {:.3g} ms",
                         escaped(c.main_scene), nice(2 / *m->limit), 1e3 * *m->limit);
  }
  return formula.replace(at, mark.size(), text);
}

/// Links to the guided experiments of the lab that belong to a chapter.
std::string experiments_html(const Chapter& chapter) {
  std::string links;
  for (const auto& [name, title] : chapter.experiments)
    links += fmt::format("{}<a href=\"#experiment={}\">{}</a>", links.empty() ? "" : ", ", name, escaped(title));
  return links.empty() ? "" : fmt::format("<p class=\"try\">Try it in the lab: {}.</p>", links);
}

const Chapter::Group* group_of(const Chapter::Entry& entry, const Chapter& chapter) {
  for (const Chapter::Group& group : chapter.groups)
    if (!entry.shown && !entry.figures.empty() && matches(entry.figures[0].name, group.figures)) return &group;
  return nullptr;
}

/// The entries of a group in one fold.
std::string group_html(const Chapter::Group& group, const Chapter& chapter, const PageContent& c) {
  std::vector<std::pair<std::string, std::string>> choices;
  std::string contents;
  for (const Chapter::Entry& entry : chapter.entries) {
    if (group_of(entry, chapter) != &group) continue;
    const std::string& name = entry.figures[0].name;
    const std::string id = "one-" + name;
    contents +=
        fmt::format("<div id=\"{}\"{}>{}</div>\n", escaped(id), choices.empty() ? "" : " hidden", entry_html(entry, c));
    choices.emplace_back(id, group.titled ? entry.heading : starred_part(name, group.figures));
  }
  return fold_html(group.heading, fmt::format("{} chart{}", choices.size(), choices.size() == 1 ? "" : "s"),
                   (choices.size() > 1 ? choices_html(choices) : "") + contents);
}

}  // namespace

std::string chapter_html(const Chapter& chapter, size_t number, const PageContent& c) {
  std::string out =
      fmt::format("<section class=\"chapter\" id=\"{}\">\n<p class=\"of\">Chapter {} of {}</p><h2>{}</h2>\n",
                  chapter.id, number, c.chapters.size(), prose(chapter.title));
  const auto question = std::ranges::find(questions(), chapter.id, &Question::chapter);
  if (const Finding* answer = question == questions().end() ? nullptr : answer_to(*question, c.findings))
    out += fmt::format("<p class=\"answer\">{}</p>\n", prose_with_bold_numbers(sentence_of(*answer)));
  const std::vector<Lead> leads = leads_of(chapter, c);
  const bool contact =
      std::ranges::any_of(c.scenes, [](const ScenePart& part) { return part.scene->model.find<Spheres>(); });
  const std::string formula = chapter.formula + (contact ? chapter.contact_formula : "");
  // a certificate of a few scenes is a few lines high: the text stands below it
  const bool is_short = chapter.id == "same-answer" && leads.empty() && c.scenes.size() <= 4;
  out += fmt::format("<div class=\"lead{}\"><div>", is_short ? " short" : "");
  if (chapter.id == "same-answer") out += parity_html(c.scenes);
  if (!leads.empty()) out += leads_html(leads, c) + drawing_without_script(leads[0].entry->figures[leads[0].figure], c);
  out += fmt::format(
      "</div><div class=\"teach\">{}{}{}</div></div>\n",
      formula.empty() ? "" : fmt::format("<div class=\"formula\">{}</div>", with_critical_step(formula, c)),
      chapter.teaching + (contact ? chapter.contact_teaching : ""), c.lab.empty() ? "" : experiments_html(chapter));
  for (const Chapter::Entry& entry : chapter.entries)
    if (entry.shown) out += shown_html(entry, c);
  std::string folds;
  std::vector<Finding> said;
  for (const Finding& f : c.findings)
    if (const FindingRule& rule = finding_rule(f.rule);
        rule.topic != "answer" &&
        (rule.chapter == chapter.id || std::ranges::find(chapter.joins, rule.chapter) != chapter.joins.end()))
      said.push_back(f);
  if (!said.empty())
    folds += fold_html("What was found", fmt::format("{} finding{}", said.size(), said.size() == 1 ? "" : "s"),
                       findings_html(said));
  if (chapter.id == "same-answer" && !c.relations.empty())
    folds += fold_html("What must hold without any truth", "table", relations_html(c.relations), "relations");
  std::set<const Chapter::Group*> grouped;  // whose fold is there, with all its members
  for (const Chapter::Entry& entry : chapter.entries) {
    if (entry.shown) continue;
    if (const Chapter::Group* group = group_of(entry, chapter)) {
      if (grouped.insert(group).second) folds += group_html(*group, chapter, c);
      continue;
    }
    Chapter::Entry rest = entry;
    if (const auto lead = std::ranges::find(leads, &entry, &Lead::entry); lead != leads.end()) {
      rest.figures.erase(rest.figures.begin() + static_cast<long>(lead->figure)), rest.text.clear();
      if (rest.figures.empty() && rest.images.empty() && rest.tables.empty()) continue;
    }
    folds += fold_html(entry.heading, kind_of(rest), entry_html(rest, c));
  }
  return out + (folds.empty() ? "" : "<div class=\"folds\">\n" + folds + "</div>\n") + "</section>\n";
}

bool opens_a_chapter(const PageContent& c, const std::string& figure) {
  return std::ranges::any_of(c.chapters, [&](const Chapter& chapter) {
    const std::vector<Lead> leads = leads_of(chapter, c);
    return !leads.empty() && leads[0].entry->figures[leads[0].figure].name == figure;
  });
}

std::vector<std::string> figures_in_sight(const PageContent& c) {
  std::vector<std::string> shown;
  const auto show = [&](const std::string& figure) {
    if (std::ranges::find(shown, figure) == shown.end()) shown.push_back(figure);
  };
  for (const Chapter& chapter : c.chapters) {
    if (const std::vector<Lead> leads = leads_of(chapter, c); !leads.empty())
      show(leads[0].entry->figures[leads[0].figure].name);
    for (const Chapter::Entry& entry : chapter.entries)
      for (const PageFigure& figure : entry.figures)
        if (entry.shown) show(figure.name);
  }
  return shown;
}

}  // namespace crosscheck
