#include "report/commands/regress_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/regress/comparison.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "report/commands/json_files.h"
#include "report/findings/findings_text.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

std::string shown(const std::optional<double>& value, const std::string& word) {
  return value ? fmt::format("{:.7g}", *value) : word.empty() ? "-" : word;
}

std::string off_in_words(const Comparison& row) {
  if (!row.was || !row.is) return "";
  return std::isinf(row.off()) ? "a count" : fmt::format("{:.3g}", row.off());
}

Cell cell(const std::optional<double>& value, const std::string& word) {
  return value ? Cell(*value) : word.empty() ? Cell() : Cell(word);
}

Table table_of(const std::vector<Comparison>& comparisons) {
  Table table{"regress",
              columns_of("scene, method, without, quantity, unit, was [unit], is [unit], tolerance [unit], "
                         "tolerances off, state, note"),
              {}};
  for (const Comparison& row : comparisons)
    table.add({row.scene, row.method, row.without, row.quantity, row.unit, cell(row.was, row.was_word),
               cell(row.is, row.is_word), row.was && row.is ? Cell(row.tolerance) : Cell(),
               row.was && row.is ? Cell(row.off()) : Cell(), std::string(name_of(row.state)), row.note});
  return table;
}

std::string junit(const RegressionResult& result) {
  // failed quantities by scene and method
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> wrong;
  for (const Comparison& row : result.rows) {
    std::string method = row.method.empty() ? "baseline" : row.method;
    if (!row.without.empty()) method += " without " + row.without;
    std::vector<std::string>& lines = wrong[{row.scene, method}];
    if (failed(row.state))
      lines.push_back(fmt::format("{}: {}: {}\n", row.quantity, name_of(row.state), describe_change(row)));
  }
  std::vector<TestCase> cases;
  for (const auto& [name, lines] : wrong)
    cases.push_back({name.first, name.second, lines.empty() ? "" : "failure",
                     fmt::format("{} quantities", lines.size()), fmt::format("{}", fmt::join(lines, ""))});
  for (const FailedPoint& f : result.failures) cases.push_back({"no answer", f.name, "error", f.why});
  return junit_xml("regress", cases);
}

}  // namespace

std::string case_of(const Comparison& row) {
  std::string text = row.scene;
  if (!row.method.empty()) text += ", " + row.method;
  if (!row.without.empty()) text += " without " + row.without;
  return text;
}

std::string describe(const NewMethod& m) {
  return fmt::format("{}: {} quantities in {}, not blessed yet; bless with --filter '*/{}'", m.method, m.quantities,
                     counted(m.scenes, "scene"), m.method);
}

std::string describe_change(const Comparison& row) {
  if (!row.note.empty()) return row.note;
  std::string text = fmt::format("was {}, is {}", shown(row.was, row.was_word), shown(row.is, row.is_word));
  if (row.unit != "word" && row.unit != "1") text += " " + row.unit;
  if (row.state == Status::moved && row.was)
    text += fmt::format("; tolerance {:.2g}, {}{} off", row.tolerance, off_in_words(row),
                        std::isinf(row.off()) ? "" : " tolerances");
  return text;
}

void write_verdict(const RegressionResult& result, const Provenance& lines, const std::filesystem::path& folder) {
  const Table rows = table_of(result.rows);
  write_csv(rows, lines, folder);
  Table wrong{rows.name, rows.columns, {}};
  for (size_t i = 0; i < rows.rows.size(); ++i)
    if (failed(result.rows[i].state)) wrong.add(rows.rows[i]);
  const auto unanswered = [](const std::vector<FailedPoint>& points) {
    Json list = Json::array();
    for (const FailedPoint& f : points) list.push_back({{"question", f.name}, {"why", f.why}});
    return list;
  };
  Json added = Json::array();
  for (const NewMethod& m : new_methods(result.rows))
    added.push_back({{"method", m.method}, {"scenes", m.scenes}, {"quantities", m.quantities}});
  const Json json{{"passed", result.passed()},
                  {"quantities", result.rows.size()},
                  {"failures", rows_json(wrong)},
                  {"new_methods", std::move(added)},
                  {"without_answer", unanswered(result.failures)}};
  write_file(folder / "regress.json", dump(json, 1) + "\n");
  write_file(folder / "junit.xml", junit(result));
}

namespace {

/// Null if the table has no rows.
Json page_table(const Table& table, const std::string& caption) {
  PageTable page{caption, {}, {}};
  for (const Column& column : table.columns) page.header.push_back(column.name);
  for (const auto& row : table.rows) {
    std::vector<std::string>& cells = page.rows.emplace_back();
    for (const Cell& cell : row) {
      const auto* text = std::get_if<std::string>(&cell);
      const auto* number = std::get_if<double>(&cell);
      cells.push_back(text ? *text : number ? fmt::format("{:.6g}", *number) : csv_row({cell}));
    }
  }
  return page.rows.empty() ? Json() : table_data(page);
}

std::string headline(const VerdictPage& page) {
  const std::vector<Comparison>& rows = page.result.rows;
  if (!page.blessed.empty()) return fmt::format("{} quantities blessed: {}", rows.size(), page.blessed);
  if (!page.result.passed())
    return fmt::format("{} of {} quantities failed",
                       std::ranges::count_if(rows, [](const auto& row) { return failed(row.state); }), rows.size());
  return fmt::format("Nothing changed: {} quantities are the same",
                     std::ranges::count(rows, Status::same, &Comparison::state));
}

}  // namespace

std::vector<FailurePart> write_verdict_page(const VerdictPage& page, const Regression& regression, int figures) {
  std::vector<FailurePart> parts;
  std::vector<std::string> problems;
  for (const Case& q : failures_to_draw(cases(regression.selection), page.result.rows, figures))
    parts.push_back(drawn_failure(q, page.result.rows, regression, page.lines, problems));
  std::vector<Comparison> worst = worst_comparisons(page.result.rows);
  const size_t failed_cases = worst.size(), most = 15;
  std::ranges::stable_sort(worst, std::greater(), &Comparison::rank);
  worst.erase(worst.begin() + static_cast<long>(std::min(most, failed_cases)), worst.end());
  const auto added = std::ranges::count(page.result.rows, Status::added, &Comparison::state);
  Json data{{"title", "Crosscheck: changes"},
            {"styles", page_styles()},
            {"headline", headline(page)},
            {"beside", page.beside},
            {"unanswered", Json::array()},
            {"added", added > 0 ? fmt::format("{} quantit{}", added, added == 1 ? "y" : "ies") : ""},
            {"problems", problems},
            {"worst", page_table(table_of(worst), fmt::format("{} of {} cases, the largest deviations first",
                                                              worst.size(), failed_cases))},
            {"added_methods", Json::array()},
            {"drawn",
             parts.size() < failed_cases && !parts.empty() ? fmt::format("{} of {}", parts.size(), failed_cases) : ""},
            {"parts", Json::array()},
            {"provenance", provenance_data(page.lines)}};
  for (const FailedPoint& f : page.result.failures) data["unanswered"].push_back(f.name + ": " + f.why);
  if (page.blessed.empty())
    for (const NewMethod& m : new_methods(page.result.rows)) data["added_methods"].push_back(describe(m));
  for (const FailurePart& part : parts) {
    Json& one = data["parts"].emplace_back(
        Json{{"heading", part.heading}, {"text", part.text}, {"charts", Json::array()}, {"renders", Json::array()}});
    for (const PageImage& image : part.images)
      one[image.file.extension() == ".svg" ? "charts" : "renders"].push_back(image_data(image));
  }
  write_file(regression.out / "index.html", filled("regress", data));
  for (const std::string& problem : problems) fmt::print(stderr, "crosscheck: missing: {}\n", problem);
  return parts;
}

}  // namespace crosscheck
