#include "report/regress/verdict_files.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/regress/closeness.h"
#include "mysim/files.h"
#include "report/page/page.h"
#include "report/regress/speed_files.h"

namespace crosscheck {
namespace {

Cell cell(const std::optional<double>& value, const std::string& word) {
  return value ? Cell(*value) : word.empty() ? Cell() : Cell(word);
}

Table table_of(const Regressed& result) {
  Table table{"regress",
              {{"scene", "1"},
               {"method", "1"},
               {"without", "1"},
               {"quantity", "1"},
               {"unit", "1"},
               {"was", "unit"},
               {"is", "unit"},
               {"tolerance", "unit"},
               {"tolerances off", "1"},
               {"state", "1"},
               {"note", "1"}},
              {}};
  for (const Compared& row : result.rows)
    table.add({row.scene, row.method, row.without, row.quantity, row.unit, cell(row.was, row.was_word),
               cell(row.is, row.is_word), row.was && row.is ? Cell(row.tolerance) : Cell(),
               row.was && row.is ? Cell(row.off()) : Cell(), std::string(name_of(row.state)), row.note});
  return table;
}

nlohmann::ordered_json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : "inf";
}

nlohmann::ordered_json json_of(const Compared& row) {
  nlohmann::ordered_json json{{"scene", row.scene},       {"method", row.method}, {"without", row.without},
                              {"quantity", row.quantity}, {"unit", row.unit},     {"state", name_of(row.state)}};
  if (row.was) json["was"] = number(*row.was);
  if (!row.was_word.empty()) json["was"] = row.was_word;
  if (row.is) json["is"] = number(*row.is);
  if (!row.is_word.empty()) json["is"] = row.is_word;
  if (row.was && row.is) json["tolerance"] = row.tolerance, json["tolerances_off"] = number(row.off());
  if (!row.note.empty()) json["note"] = row.note;
  return json;
}

std::string sentence(const Compared& row) {
  const nlohmann::ordered_json json = json_of(row);
  std::string text = fmt::format("{}: {}", row.quantity, name_of(row.state));
  for (const char* key : {"was", "is", "tolerance", "note"})
    if (json.contains(key))
      text += fmt::format(", {} {}", key, json[key].is_string() ? json[key].get<std::string>() : json[key].dump());
  return text;
}

std::string junit(const Regressed& result, const Speeds& speeds) {
  struct Case {
    int failures = 0;
    std::string text;
  };
  std::map<std::pair<std::string, std::string>, Case> cases;
  for (const Compared& row : result.rows) {
    std::string method = row.method.empty() ? "baseline" : row.method;
    if (!row.without.empty()) method += " without " + row.without;
    Case& one = cases[{row.scene, method}];
    if (!failed(row.state)) continue;
    ++one.failures;
    one.text += sentence(row) + "\n";
  }
  size_t failures = 0;
  std::string body;
  for (const auto& [name, one] : cases) {
    body += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", escaped(name.first), escaped(name.second));
    failures += one.failures > 0;
    body += one.failures == 0 ? "/>\n"
                              : fmt::format("><failure message=\"{} quantities\">{}</failure></testcase>\n",
                                            one.failures, escaped(one.text));
  }
  for (const FailedPoint& f : result.failures)
    body += fmt::format("  <testcase classname=\"no answer\" name=\"{}\"><error message=\"{}\"/></testcase>\n",
                        escaped(f.name), escaped(f.why));
  const SpeedCases of_speed = cases_of(speeds);
  body += of_speed.body;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"regress\" tests=\"{}\" "
      "failures=\"{}\" errors=\"{}\">\n{}</testsuite>\n</testsuites>\n",
      cases.size() + result.failures.size() + of_speed.cases, failures + of_speed.failures,
      result.failures.size() + of_speed.errors, body);
}

}  // namespace

void write_verdict(const Regressed& result, const Speeds& speeds, const std::string& cause, const Provenance& lines,
                   const std::filesystem::path& folder) {
  write_csv(table_of(result), lines, folder);
  const Closeness close = closeness_of(result.rows);
  nlohmann::ordered_json json{{"passed", result.passed() && speeds.passed()},
                              {"cause", cause.empty() ? "not attributed" : cause},
                              {"quantities", result.rows.size()},
                              {"identical", close.identical},
                              {"differing", close.differing},
                              {"failures", nlohmann::ordered_json::array()},
                              {"without_answer", nlohmann::ordered_json::array()}};
  if (close.furthest) json["furthest"] = json_of(*close.furthest);
  for (const Compared& row : result.rows)
    if (failed(row.state)) json["failures"].push_back(json_of(row));
  for (const FailedPoint& f : result.failures) json["without_answer"].push_back({{"question", f.name}, {"why", f.why}});
  add_speeds(json, speeds);
  write_file(folder / "regress.json", json.dump(1) + "\n");
  write_file(folder / "junit.xml", junit(result, speeds));
  if (!speeds.rows.empty()) write_csv(table_of(speeds), lines, folder);
}

}  // namespace crosscheck
