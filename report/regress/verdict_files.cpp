#include "report/regress/verdict_files.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "experiments/regress/closeness.h"
#include "mysim/files.h"
#include "mysim/json.h"
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

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : "inf";
}

Json json_of(const Compared& row) {
  Json json{{"scene", row.scene},       {"method", row.method}, {"without", row.without},
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
  const auto shown = [](const std::optional<double>& value, const std::string& word) {
    if (!word.empty() || !value) return word;
    return std::isfinite(*value) ? Json(*value).dump() : std::isnan(*value) ? "nan" : "inf";
  };
  const std::pair<const char*, std::string> parts[] = {
      {"was", shown(row.was, row.was_word)},
      {"is", shown(row.is, row.is_word)},
      {"tolerance", row.was && row.is ? Json(row.tolerance).dump() : ""},
      {"note", row.note}};
  std::string text = fmt::format("{}: {}", row.quantity, name_of(row.state));
  for (const auto& [key, part] : parts)
    if (!part.empty()) text += fmt::format(", {} {}", key, part);
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
  Json json{{"passed", result.passed() && speeds.passed()},
            {"cause", cause.empty() ? "not attributed" : cause},
            {"quantities", result.rows.size()},
            {"identical", close.identical},
            {"differing", close.differing},
            {"failures", Json::list()},
            {"without_answer", Json::list()}};
  if (close.furthest) json["furthest"] = json_of(*close.furthest);
  for (const Compared& row : result.rows)
    if (failed(row.state)) json["failures"].push(json_of(row));
  for (const FailedPoint& f : result.failures) json["without_answer"].push({{"question", f.name}, {"why", f.why}});
  add_speeds(json, speeds);
  write_file(folder / "regress.json", json.dump(1) + "\n");
  write_file(folder / "junit.xml", junit(result, speeds));
  if (!speeds.rows.empty()) write_csv(table_of(speeds), lines, folder);
}

}  // namespace crosscheck
