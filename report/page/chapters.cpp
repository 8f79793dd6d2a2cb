// Data of chapters: the answer, the opening figures, the explanation, and folds with all other content.
#include <fmt/format.h>

#include <algorithm>

#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"

namespace crosscheck {

Json figure_data(const PageFigure& figure, const PageContent& page) {
  Json ways = Json::array();
  for (const char* form : {"pdf", "csv", "gp"})
    if (std::filesystem::exists(page.figures / (figure.name + "." + form))) ways.push_back(form);
  return {{"name", figure.name}, {"title", figure.title}, {"caption", figure.caption},
          {"runs", figure.runs}, {"hidden", false},       {"ways", std::move(ways)}};
}

Json findings_data(const Findings& findings) {
  Json list = Json::array();
  for (const Finding& f : findings) {
    const std::string tier = tier_of(f);
    const bool against = tier != "measured" && tier != "see each scene";
    list.push_back({{"sentence", sentence_of(f)}, {"tier", (against ? "reference: " : "") + tier}});
  }
  return {{"findings", std::move(list)}};
}

namespace {

constexpr size_t most_folds = 6;  // per chapter

/// The part of a name that the pattern's star matches; empty if the pattern has no star. Returns nullopt if the name
/// does not match.
std::optional<std::string> starred_part(const std::string& name, const std::string& pattern) {
  const size_t star = pattern.find('*');
  if (star == std::string::npos) return name == pattern ? std::optional("") : std::nullopt;
  const std::string before = pattern.substr(0, star), after = pattern.substr(star + 1);
  if (name.size() < before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) return {};
  return name.substr(star, name.size() - before.size() - after.size());
}

struct Lead {
  const Chapter::Entry* entry;
  size_t figure;       // index among the figures of the entry
  std::string choice;  // part of the figure's name that matches the pattern's star
  const PageFigure& of() const { return entry->figures[figure]; }
};

/// Tries the chapter's patterns in order, until figures match one. Returns these figures, the main scene's first.
std::vector<Lead> leads_of(const Chapter& chapter, const PageContent& c) {
  for (const std::string& pattern : chapter.leads) {
    std::vector<Lead> leads;
    for (const Chapter::Entry& entry : chapter.entries)
      for (size_t i = 0; i < entry.figures.size(); ++i)
        if (const auto part = starred_part(entry.figures[i].name, pattern)) leads.push_back({&entry, i, *part});
    std::ranges::stable_partition(leads, [&](const Lead& lead) { return lead.choice == c.main_scene; });
    if (!leads.empty()) return leads;
  }
  return {};
}

/// Data of choices.html: buttons that choose the visible element.
void add_choice(Json& choices, const std::string& id, const std::string& label) {
  choices.push_back({{"id", id}, {"label", label}, {"pressed", choices.empty() ? "true" : "false"}});
}

Json entry_data(const Chapter::Entry& entry, const PageContent& c) {
  Json figures = Json::array(), images = Json::array(), tables = Json::array();
  for (const PageFigure& figure : entry.figures) figures.push_back(figure_data(figure, c));
  for (const PageImage& image : entry.images)
    if (std::filesystem::exists(image.file)) images.push_back(image_data(image));  // missing files are reported
  for (const PageTable& table : entry.tables) tables.push_back(table_data(table));
  return {{"heading", entry.heading},
          {"text", entry.text},
          {"figures", std::move(figures)},
          {"images", std::move(images)},
          {"tables", std::move(tables)}};
}

/// A folded entry. Of the entries in the same fold, one is visible at a time.
struct Folded {
  std::string fold, label;  // heading of the fold, text of the entry's button
  size_t worth;             // index of the entry's pattern in the chapter's list
  Chapter::Entry entry;
};

/// Most important entries first.
std::vector<Folded> folded(const Chapter& chapter, const std::vector<Lead>& leads) {
  std::vector<Folded> all;
  for (const Chapter::Entry& given : chapter.entries) {
    if (given.shown) continue;
    const std::string name = given.figures.empty() ? given.heading : given.figures[0].name;
    const auto pattern =
        std::ranges::find_if(chapter.folds, [&](const std::string& p) { return starred_part(name, p).has_value(); });
    Folded one{given.heading, given.heading, static_cast<size_t>(pattern - chapter.folds.begin()), given};
    for (const Chapter::Group& group : chapter.groups)
      if (const auto part = given.figures.empty() ? std::nullopt : starred_part(name, group.figures)) {
        one.fold = group.heading;
        if (!group.titled) one.label = *part;
      }
    if (const auto lead = std::ranges::find(leads, &given, &Lead::entry); lead != leads.end())
      one.entry.figures.erase(one.entry.figures.begin() + static_cast<long>(lead->figure)), one.entry.text.clear();
    if (!one.entry.figures.empty() || !one.entry.images.empty() || !one.entry.tables.empty()) all.push_back(one);
  }
  std::ranges::stable_sort(all, {}, &Folded::worth);
  return all;
}

std::string kind_of(const Chapter::Entry& entry) {
  return !entry.figures.empty() ? "chart" : !entry.images.empty() ? "picture" : "table";
}

Json fold_data(const std::string& heading, const std::vector<Folded>& all, const PageContent& c, Folds& folds) {
  Json entries = Json::array(), choices = Json::array();
  for (const Folded& one : all) {
    if (one.fold != heading) continue;
    Json entry = entry_data(one.entry, c);
    entry["id"] = fmt::format("one-{}-{}", one.entry.part, &one - all.data());
    entry["hidden"] = !entries.empty();
    add_choice(choices, entry["id"], one.label);
    entries.push_back(std::move(entry));
  }
  const std::string kind = kind_of(std::ranges::find(all, heading, &Folded::fold)->entry);
  if (entries.size() == 1) return folds.fold(heading, kind, "entry", entries[0]);
  const std::string many = counted(entries.size(), kind);
  return folds.fold(heading, many, "group", {{"entries", std::move(entries)}, {"choices", std::move(choices)}});
}

/// Folds for findings, invariants and entries. If there would be more than `most_folds`, the last one contains the
/// least important entries.
Json folds_data(const Chapter& chapter, const std::vector<Lead>& leads, const PageContent& c, Folds& folds) {
  Json all = Json::array();
  Findings said;
  for (const Finding& f : c.findings)
    if (const FindingRule& rule = finding_rule(f.rule);
        rule.topic != "answer" &&
        (rule.chapter == chapter.id || std::ranges::find(chapter.joins, rule.chapter) != chapter.joins.end()))
      said.push_back(f);
  if (!said.empty())
    all.push_back(folds.fold("Findings", counted(said.size(), "finding"), "findings", findings_data(said)));
  if (chapter.id == "same-answer" && !c.relations.empty())
    all.push_back(folds.fold("Invariants that need no reference solution", "table", "relations",
                             relations_data(c.relations), "relations"));
  std::vector<Folded> rest = folded(chapter, leads);
  std::vector<std::string> headings;
  for (const Folded& one : rest) add_once(headings, one.fold);
  if (const size_t room = most_folds - all.size(); headings.size() > room) {
    const std::string more = "More figures and tables";
    for (Folded& one : rest) {
      if (std::ranges::find(headings, one.fold) - headings.begin() < static_cast<long>(room) - 1) continue;
      if (one.fold != one.label) one.label = one.fold + ": " + one.label;
      one.fold = more;
    }
    headings.resize(room - 1);
    headings.push_back(more);
  }
  for (const std::string& heading : headings) all.push_back(fold_data(heading, rest, c, folds));
  return all;
}

/// Data of critical.html: the main scene's numbers in formulas. Null if the scene's critical step is unknown. The
/// formula 2 / omega of leapfrog holds with any drag.
Json critical_data(const PageContent& c) {
  for (const ScenePart& part : c.scenes) {
    const MethodData* m = part.facts->find(subject_method(is_symplectic_of_second_order));
    if (part.scene->name == c.main_scene && m && m->step_limit && *m->step_limit > 0)
      return {{"scene", c.main_scene},
              {"omega", nice(2 / *m->step_limit)},
              {"step", fmt::format("{:.3g}", 1e3 * *m->step_limit)}};
  }
  return nullptr;
}

Json chapter_data(const Chapter& chapter, size_t number, const PageContent& c, Folds& folds) {
  const bool contact =
      std::ranges::any_of(c.scenes, [](const ScenePart& part) { return has_contact(part.scene->model); });
  const bool certificates = chapter.id == "same-answer";
  const Json known{{"contact", contact}, {"critical", critical_data(c)}};
  const auto text = [&](const std::string& given) { return Template(chapter.id + ".md", given).filled(known); };
  const std::vector<Lead> leads = leads_of(chapter, c);
  Json data{{"id", chapter.id},
            {"number", number},
            {"count", c.chapters.size()},
            {"title", text(chapter.title)},
            {"step_lab", chapter.id == "stability" && !c.lab.empty() ? c.main_scene : ""},
            {"label", text(chapter.label)},
            {"answer", answers_of_chapter(chapter.id, c.findings)},
            // true if there are few scenes, so that the certificates leave space for text below them
            {"short", certificates && leads.empty() && c.scenes.size() <= 4},
            {"parity", certificates ? parity_data(c.scenes) : Json()},
            {"choices", Json::array()},
            {"leads", Json::array()},
            {"drawing", nullptr},
            {"formula", text(chapter.formula)},
            {"teaching", markdown_html(text(chapter.teaching))},
            {"experiments", Json::array()},
            {"shown", Json::array()}};
  for (const Lead& lead : leads) {
    if (leads.size() > 1) add_choice(data["choices"], "figure-" + lead.of().name, lead.choice);
    Json figure = figure_data(lead.of(), c);
    figure["hidden"] = &lead != &leads.front();
    data["leads"].push_back(std::move(figure));
  }
  if (const auto svg = leads.empty() ? "" : c.figures / (leads[0].of().name + ".svg"); std::filesystem::exists(svg))
    data["drawing"] = image_data({svg, leads[0].of().title, ""});
  for (const Chapter::Experiment& experiment : chapter.experiments)
    if (!c.lab.empty() && (contact || !experiment.contact))
      data["experiments"].push_back({{"name", experiment.name}, {"title", experiment.title}});
  for (const Chapter::Entry& entry : chapter.entries)
    if (entry.shown) data["shown"].push_back(entry_data(entry, c));
  data["folds"] = folds_data(chapter, leads, c, folds);
  return data;
}

}  // namespace

bool has_contents(const Chapter& chapter) { return chapter.id == "same-answer" || !chapter.entries.empty(); }

Json chapters_data(const PageContent& c, Folds& folds) {
  Json all = Json::array();
  for (size_t i = 0; i < c.chapters.size(); ++i)
    if (has_contents(c.chapters[i])) all.push_back(chapter_data(c.chapters[i], i + 1, c, folds));
  return all;
}

std::vector<std::string> figures_in_sight(const PageContent& c) {
  std::vector<std::string> shown;
  for (const Chapter& chapter : c.chapters) {
    if (const std::vector<Lead> leads = leads_of(chapter, c); !leads.empty()) add_once(shown, leads[0].of().name);
    for (const Chapter::Entry& entry : chapter.entries)
      for (const PageFigure& figure : entry.figures)
        if (entry.shown) add_once(shown, figure.name);
  }
  return shown;
}

bool opens_a_chapter(const PageContent& c, const std::string& figure) {
  return std::ranges::any_of(c.chapters, [&](const Chapter& chapter) {
    const std::vector<Lead> leads = leads_of(chapter, c);
    return !leads.empty() && leads[0].of().name == figure;
  });
}

}  // namespace crosscheck
