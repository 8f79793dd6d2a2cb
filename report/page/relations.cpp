// Marks of the relations that need no truth: a row for each engine; and what is broken, by how much, and why.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/check/relations.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

/// The mark of a relation that was tested on several scenes: the worst one, or "not applicable" if there is no other.
RelationMark worse_mark(RelationMark a, RelationMark b) {
  for (const RelationMark mark : {RelationMark::broken, RelationMark::known, RelationMark::holds})
    if (a == mark || b == mark) return mark;
  return RelationMark::not_asked;
}

/// The dots of the parity certificates: full, a ring, a red square.
std::string_view css_class(RelationMark mark) {
  constexpr std::string_view names[] = {"match", "mismatch", "law", "unattested"};
  return names[static_cast<int>(mark)];
}

std::string sentence_of_relation(const std::string& name) {
  const Relation* relation = relation_named(name);
  return relation ? std::string(relation->sentence) : name;  // in a report by another version
}

/// "30", "4.2", "480 000".
std::string grouped_times(double factor) {
  const std::string plain = times_text(factor);
  return factor >= 1e4 && factor < 1e12 ? count_text(std::stol(plain)) : plain;
}

/// "140 times what is allowed, 2e-5 J, since 0.4 s"; where the run failed, when it did.
std::string size_of_break(const RelationRow& row) {
  const std::string unit = row.unit == "1" ? "" : " " + row.unit;
  std::string text;
  if (row.ratio)
    text =
        fmt::format("{} times what is allowed, {}{}", grouped_times(*row.ratio), nice(row.tolerance.value_or(0)), unit);
  else if (row.measured)
    text = fmt::format("{}{}, where nothing is allowed", nice(*row.measured), unit);
  if (row.since) text += fmt::format("{}{:.2g} s", text.empty() ? "fails at " : ", since ", *row.since);
  return readable(text);
}

/// A row for each method and cause of its breaks, with the largest of them.
PageTable table_of_breaks(const std::vector<RelationRow>& rows) {
  PageTable breaks{
      "What is broken, by how much at most, and why", {"method", "what must hold", "scene", "by how much", "why"}, {}};
  std::vector<const RelationRow*> largest;
  for (const RelationRow& row : rows) {
    if (row.mark != RelationMark::broken && row.mark != RelationMark::known) continue;
    size_t at = 0;
    while (at < largest.size() && (row.reason.empty() || largest[at]->method != row.method ||
                                   largest[at]->reason != row.reason || largest[at]->mark != row.mark))
      ++at;
    if (at == largest.size()) {
      largest.push_back(&row);
      breaks.rows.push_back({row.method, row.relation, row.scene, size_of_break(row),
                             row.reason.empty() ? "not known" : readable(row.reason)});
      continue;
    }
    std::vector<std::string>& said = breaks.rows[at];
    const auto add_name = [](std::string& names, const std::string& name) {
      if ((", " + names + ", ").find(", " + name + ", ") == std::string::npos) names += ", " + name;
    };
    add_name(said[1], row.relation), add_name(said[2], row.scene);
    if (row.ratio.value_or(0) > largest[at]->ratio.value_or(0)) largest[at] = &row, said[3] = size_of_break(row);
  }
  // the meaning of each relation, once
  std::vector<std::string> told;
  for (std::vector<std::string>& said : breaks.rows)
    if (said[1].find(',') == std::string::npos && std::ranges::find(told, said[1]) == told.end()) {
      told.push_back(said[1]);
      said[1] = fmt::format("{}: {}", said[1], sentence_of_relation(said[1]));
    }
  return breaks;
}

}  // namespace

Json relations_data(const std::vector<RelationRow>& rows) {
  if (rows.empty()) return nullptr;
  std::vector<std::string> methods, names;
  std::map<std::pair<std::string, std::string>, RelationMark> marks;  // by method and relation
  const auto note = [](std::vector<std::string>& list, const std::string& name) {
    if (std::ranges::find(list, name) == list.end()) list.push_back(name);
  };
  for (const RelationRow& row : rows) {
    note(methods, row.method), note(names, row.relation);
    const auto [at, is_new] = marks.emplace(std::pair{row.method, row.relation}, row.mark);
    if (!is_new) at->second = worse_mark(at->second, row.mark);
  }
  Json header = Json::array(), engines = Json::array();
  for (const std::string& name : names) header.push_back({{"text", name}, {"title", sentence_of_relation(name)}});
  for (const std::string& method : methods) {
    Json cells = Json::array();
    for (const std::string& name : names) {
      const auto at = marks.find({method, name});
      const RelationMark mark = at == marks.end() ? RelationMark::not_asked : at->second;
      cells.push_back({{"class", mark == RelationMark::not_asked ? "" : css_class(mark)},
                       {"says", fmt::format("{}: {}", sentence_of_relation(name), name_of(mark))}});
    }
    engines.push_back({{"method", method}, {"name", name_in_sentence(method)}, {"cells", std::move(cells)}});
  }
  const PageTable breaks = table_of_breaks(rows);
  return {{"header", std::move(header)},
          {"engines", std::move(engines)},
          {"breaks", breaks.rows.empty() ? Json() : table_data(breaks)}};
}

std::string relations_page_html(const std::vector<RelationRow>& rows, const std::vector<PageImage>& pictures,
                                const Provenance& lines) {
  Json images = Json::array();
  for (const PageImage& picture : pictures) images.push_back(image_data(picture));
  return filled("relations-page", {{"title", "Crosscheck: invariants of a method"},
                                   {"styles", page_styles()},
                                   {"relations", relations_data(rows)},
                                   {"pictures", std::move(images)},
                                   {"provenance", provenance_data(lines)}});
}

}  // namespace crosscheck
