#include "report/verify.h"

#include <fmt/format.h>

#include "experiments/table_file.h"
#include "mysim/errors.h"
#include "mysim/files.h"
#include "mysim/json.h"
#include "report/grounds.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

JsonField read_json(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(fmt::format("{}: expected a report", file.string()));
  try {
    const JsonField json = JsonField::parse_file(file.string());
    for (const char* part : {"findings", "scenes", "tables"}) json[part];
    return json;
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected a finished report: {}", error.what()));
  }
}

Rows read_tables(const JsonField& report, const fs::path& data, Verification& found) {
  Rows rows;
  for (const JsonField& told : report["tables"].elements()) {
    const std::string name = told["name"].text();
    rows.tables.push_back(read_csv(data / (name + ".csv")));
    const Grounds now = grounds_of(rows.tables.back());
    found.rows += static_cast<int>(now.rows.size());
    if (const auto reported = told["rows"].natural(); now.rows.size() != reported)
      found.mismatches.push_back(fmt::format("table {}: {} rows, reported were {}", name, now.rows.size(), reported));
    else if (now.fingerprint != told["fingerprint"].text())
      found.mismatches.push_back(fmt::format("table {}: some row is not the one that was reported", name));
  }
  return rows;
}

std::vector<Scene> read_scenes(const JsonField& report, const fs::path& data, Verification& found) {
  std::vector<Scene> scenes;
  for (const auto& [name, told] : report["scenes"].items()) {
    scenes.push_back(read_scene(data / "scenes" / (file_name_of(name) + ".toml")));
    if (scenes.back().hash != told["hash"].text())
      found.mismatches.push_back(fmt::format("scene {}: not the one that was reported", name));
  }
  return scenes;
}

void compare(const JsonField& told, const Finding& now, const Rows& rows, Verification& found) {
  const std::string sentence = told["sentence"].text();
  const auto differs = [&](const std::string& how) {
    found.mismatches.push_back(fmt::format("\"{}\": {}", sentence, how));
  };
  if (sentence != now.sentence) return differs(fmt::format("the data say \"{}\"", now.sentence));
  if (told["tier"].text() != now.tier) return differs(fmt::format("it rests on \"{}\"", now.tier));
  const std::vector<Grounds> grounds = grounds_of(now, rows);
  const std::vector<JsonField> rests_on = told["evidence"].elements();
  if (rests_on.size() != grounds.size()) return differs("it rests on other tables");
  for (size_t i = 0; i < grounds.size(); ++i)
    if (rests_on[i]["table"].text() != grounds[i].table || rests_on[i]["rows"].dump() != Json(grounds[i].rows).dump() ||
        rests_on[i]["fingerprint"].text() != grounds[i].fingerprint)
      differs(fmt::format("rows of table {} are not those that were reported", grounds[i].table));
}

}  // namespace

Verification verify_report(const fs::path& folder) {
  Verification found;
  const JsonField report = read_json(folder / "report.json");
  const Rows rows = read_tables(report, folder / "data", found);
  const std::vector<Scene> scenes = read_scenes(report, folder / "data", found);
  const AllFindings all = all_findings(scenes, rows);
  std::vector<Finding> now = all.overall;
  for (const auto& of_scene : all.of_scenes) now.insert(now.end(), of_scene.begin(), of_scene.end());
  const std::vector<JsonField> told = report["findings"].elements();
  found.findings = static_cast<int>(told.size());
  if (told.size() != now.size())
    found.mismatches.push_back(fmt::format("{} findings, but the data give {}", told.size(), now.size()));
  for (size_t i = 0; i < std::min(told.size(), now.size()); ++i) compare(told[i], now[i], rows, found);
  return found;
}

}  // namespace crosscheck
