// Relations as marks, in one row per engine; violations with size and cause.

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

/// The mark of a relation over several scenes: the worst mark, or "not applicable" if there is no other mark.
RelationMark worse_mark(RelationMark a, RelationMark b) {
  for (const RelationMark mark : {RelationMark::broken, RelationMark::known, RelationMark::holds})
    if (a == mark || b == mark) return mark;
  return RelationMark::not_applicable;
}

/// CSS class of a dot, which looks as in parity certificates: a full dot, a ring, or a red square.
std::string_view css_class(RelationMark mark) {
  constexpr std::string_view names[] = {"match", "mismatch", "law", "unattested"};
  return names[static_cast<int>(mark)];
}

std::string sentence_of_relation(const std::string& name) {
  const Relation* relation = relation_named(name);
  return relation ? std::string(relation->sentence) : name;  // other versions' reports may have unknown relations
}

/// "3e-3 J, 140 times the tolerance, since 0.4 s"; for a failed run, the time at which the run failed.
std::string size_of_break(const RelationRow& row) {
  std::string text;
  if (row.measured)
    text = nice(*row.measured) + (row.unit == "1" ? "" : " " + row.unit) +
           (row.ratio ? fmt::format(", {} times the tolerance", times_text(*row.ratio)) : ", tolerance 0");
  if (row.since) text += fmt::format("{}{:.2g} s", text.empty() ? "fails at " : ", since ", *row.since);
  return readable(text);
}

/// The largest violation of each method and cause.
PageTable table_of_breaks(const std::vector<RelationRow>& rows) {
  std::vector<const RelationRow*> largest;
  for (const RelationRow& row : rows) {
    if (row.mark != RelationMark::broken && row.mark != RelationMark::known) continue;
    const auto same = std::ranges::find_if(largest, [&](const RelationRow* other) {
      return !row.reason.empty() && other->method == row.method && other->reason == row.reason;
    });
    if (same == largest.end())
      largest.push_back(&row);
    else if (row.ratio.value_or(0) > (*same)->ratio.value_or(0))
      *same = &row;
  }
  PageTable breaks{
      "The largest break of each cause (relations.csv has all)", {"method", "invariant", "scene", "size", "cause"}, {}};
  for (const RelationRow* row : largest)
    breaks.rows.push_back({row->method, fmt::format("{}: {}", row->relation, sentence_of_relation(row->relation)),
                           row->scene, size_of_break(*row), row->reason.empty() ? "unknown" : readable(row->reason)});
  return breaks;
}

}  // namespace

Json relations_data(const std::vector<RelationRow>& rows) {
  if (rows.empty()) return nullptr;
  std::vector<std::string> methods, names;
  std::map<std::pair<std::string, std::string>, RelationMark> marks;
  for (const RelationRow& row : rows) {
    add_once(methods, row.method), add_once(names, row.relation);
    const auto [at, is_new] = marks.emplace(std::pair{row.method, row.relation}, row.mark);
    if (!is_new) at->second = worse_mark(at->second, row.mark);
  }
  Json header = Json::array(), engines = Json::array();
  for (const std::string& name : names) header.push_back({{"text", name}, {"title", sentence_of_relation(name)}});
  for (const std::string& method : methods) {
    Json cells = Json::array();
    for (const std::string& name : names) {
      const auto at = marks.find({method, name});
      const RelationMark mark = at == marks.end() ? RelationMark::not_applicable : at->second;
      cells.push_back({{"class", mark == RelationMark::not_applicable ? "" : css_class(mark)},
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
