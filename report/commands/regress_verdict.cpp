// Writes the verdict of a regression run.
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
#include "report/commands/junit.h"
#include "report/commands/regress_failure.h"
#include "report/page/page_parts.h"

namespace crosscheck {
namespace {

std::vector<Column> plain_columns(const std::vector<std::string>& names) {
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back({name, "1"});
  return columns;
}

Cell cell(const std::optional<double>& value, const std::string& word) {
  return value ? Cell(*value) : word.empty() ? Cell() : Cell(word);
}

Table table_of(const RegressionResult& result) {
  Table table{"regress",
              plain_columns({"scene", "method", "without", "quantity", "unit", "was", "is", "tolerance",
                             "tolerances off", "state", "note"}),
              {}};
  for (const char* name : {"was", "is", "tolerance"})
    std::ranges::find(table.columns, name, &Column::name)->unit = "unit";
  for (const Comparison& row : result.rows)
    table.add({row.scene, row.method, row.without, row.quantity, row.unit, cell(row.was, row.was_word),
               cell(row.is, row.is_word), row.was && row.is ? Cell(row.tolerance) : Cell(),
               row.was && row.is ? Cell(row.off()) : Cell(), std::string(name_of(row.state)), row.note});
  return table;
}

std::string junit(const RegressionResult& result) {
  // failed quantities, by scene and method
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> cases;
  for (const Comparison& row : result.rows) {
    std::string method = row.method.empty() ? "baseline" : row.method;
    if (!row.without.empty()) method += " without " + row.without;
    std::vector<std::string>& wrong = cases[{row.scene, method}];
    if (failed(row.state))
      wrong.push_back(fmt::format("{}: {}: {}\n", row.quantity, name_of(row.state),
                                  row.note.empty() ? describe_change(row) : row.note));
  }
  JUnitReport report("regress");
  for (const auto& [name, wrong] : cases)
    report.add(name.first, name.second, wrong.empty() ? "" : "failure", fmt::format("{} quantities", wrong.size()),
               fmt::format("{}", fmt::join(wrong, "")));
  for (const FailedPoint& f : result.failures) report.add("no answer", f.name, "error", f.why);
  return report.xml();
}

}  // namespace

void write_verdict(const RegressionResult& result, const Provenance& lines, const std::filesystem::path& folder) {
  const Table rows = table_of(result);
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

std::string shown(const std::optional<double>& value, const std::string& word) {
  return value ? fmt::format("{:.7g}", *value) : word.empty() ? "-" : word;
}

std::string off_in_words(const Comparison& row) {
  if (!row.was || !row.is) return "";
  return std::isinf(row.off()) ? "a count" : fmt::format("{:.3g}", row.off());
}

std::string where(const Comparison& row) {
  std::string text = row.scene;
  if (!row.method.empty()) text += " under " + row.method;
  if (!row.without.empty()) text += " without " + row.without;
  return text;
}

/// The 15 largest deviations.
PageTable worst_table(std::vector<Comparison> rows) {
  std::ranges::stable_sort(rows, std::greater(), &Comparison::rank);
  const size_t shown_rows = std::min<size_t>(rows.size(), 15);
  PageTable table{fmt::format("{} of {} cases, the largest deviations first", shown_rows, rows.size()),
                  {"case", "quantity", "was", "is", "unit", "tolerance", "difference / tolerance", "verdict"},
                  {}};
  for (size_t i = 0; i < shown_rows; ++i) {
    const Comparison& row = rows[i];
    const bool numbers = row.was && row.is;
    table.rows.push_back({where(row), row.quantity, shown(row.was, row.was_word),
                          row.note.empty() ? shown(row.is, row.is_word) : row.note, row.unit == "word" ? "" : row.unit,
                          numbers ? fmt::format("{:.2g}", row.tolerance) : "", off_in_words(row),
                          std::string(name_of(row.state))});
  }
  return table;
}

/// A section's table for the page; null where it has no rows.
Json section(const PageTable& table) { return table.rows.empty() ? Json() : table_data(table); }

std::string headline(const VerdictPage& page) {
  const auto rows = [&](auto state) { return std::ranges::count_if(page.result.rows, state); };
  if (!page.blessed.empty()) return fmt::format("{} quantities blessed: {}", page.result.rows.size(), page.blessed);
  if (!page.result.passed())
    return fmt::format("{} of {} quantities failed", rows([](const auto& row) { return failed(row.state); }),
                       page.result.rows.size());
  return fmt::format("Nothing moved: {} quantities are the same",
                     rows([](const auto& row) { return row.state == Status::same; }));
}

PageTable new_methods_table(const RegressionResult& result) {
  PageTable table{"Methods without baselines", {"method", "scenes", "quantities", "bless with"}, {}};
  for (const NewMethod& m : new_methods(result.rows))
    table.rows.push_back({m.method, std::to_string(m.scenes), std::to_string(m.quantities),
                          fmt::format("crosscheck regress --filter '*/{}' --bless --reason TEXT", m.method)});
  return table;
}

}  // namespace

std::string describe(const NewMethod& method) {
  return fmt::format("{} quantities in {} scene{}, not blessed yet", method.quantities, method.scenes,
                     method.scenes == 1 ? "" : "s");
}

std::string describe_change(const Comparison& row) {
  std::string text = fmt::format("was {}, is {}", shown(row.was, row.was_word), shown(row.is, row.is_word));
  if (row.unit != "word" && row.unit != "1") text += " " + row.unit;
  if (row.state == Status::moved && row.was)
    text += fmt::format("; tolerance {:.2g}, {}{} off", row.tolerance, off_in_words(row),
                        std::isinf(row.off()) ? "" : " tolerances");
  return text;
}

namespace {

/// Draws the failures (at most `most`) into OUT/figures. A figure that cannot be drawn is added to `problems`.
std::vector<FailurePart> failure_parts(const std::vector<Case>& cases, const RegressionResult& result,
                                       const Regression& regression, int most, const Provenance& lines,
                                       std::vector<std::string>& problems) {
  std::vector<FailurePart> parts;
  for (const Case& q : failures_to_draw(cases, result.rows, most)) {
    const FailureDetails details = failure_details(q, result.rows, regression);
    FailurePart part;
    part.scene = q.scene.name, part.heading = q.in_words();
    part.text = describe_divergence(details);
    part.images = failure_figures(details, lines, regression.out, problems);
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string verdict_html(const VerdictPage& page) {
  const std::vector<Comparison> worst = worst_comparisons(page.result.rows);
  const auto added = std::ranges::count(page.result.rows, Status::added, &Comparison::state);
  Json data{{"title", "Crosscheck: what moved"},
            {"styles", page_styles()},
            {"headline", headline(page)},
            {"beside", page.beside},
            {"unanswered", Json::array()},
            {"added", added > 0 ? fmt::format("{} quantit{}", added, added == 1 ? "y" : "ies") : ""},
            {"problems", page.problems},
            {"worst", section(worst_table(worst))},
            {"added_methods", page.blessed.empty() ? section(new_methods_table(page.result)) : Json()},
            {"drawn", page.parts.size() < worst.size() && !page.parts.empty()
                          ? fmt::format("{} of {}", page.parts.size(), worst.size())
                          : ""},
            {"parts", Json::array()},
            {"provenance", provenance_data(page.lines)}};
  for (const FailedPoint& f : page.result.failures) data["unanswered"].push_back(f.name + ": " + f.why);
  for (const FailurePart& part : page.parts) {
    Json& one = data["parts"].emplace_back(
        Json{{"heading", part.heading}, {"text", part.text}, {"charts", Json::array()}, {"renders", Json::array()}});
    for (const PageImage& image : part.images)
      one[image.file.extension() == ".svg" ? "charts" : "renders"].push_back(image_data(image));
  }
  return filled("regress", data);
}

}  // namespace

void write_verdict_page(VerdictPage& page, const std::vector<Case>& cases, const Regression& regression, int figures) {
  page.parts = failure_parts(cases, page.result, regression, figures, page.lines, page.problems);
  write_file(regression.out / "index.html", verdict_html(page));
  for (const std::string& problem : page.problems) fmt::print(stderr, "crosscheck: missing: {}\n", problem);
}

}  // namespace crosscheck
