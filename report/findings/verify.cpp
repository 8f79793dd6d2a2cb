#include "report/findings/verify.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>

#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/names.h"
#include "report/findings/evidence.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

JsonField read_json(const fs::path& folder) {
  const fs::path file = path_inside(folder, "report.json");
  if (!fs::exists(file)) throw InputError(fmt::format("{}: expected a report", file.string()));
  const JsonField json = JsonField::parse_file(file.string());
  const auto format = json.find("format");
  if (!format || format->dump() != std::to_string(report_format))
    throw InputError(fmt::format("{}: expected a report of format {}, got {}; run `report` again with this version",
                                 file.string(), report_format, format ? format->dump() : "one without a format"));
  try {
    for (const char* part : {"findings", "scenes", "tables", "runs"}) json[part];
    return json;
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected a finished report: {}", error.what()));
  }
}

TableSet read_tables(const JsonField& report, const fs::path& data, Verification& found) {
  TableSet rows;
  for (const JsonField& claimed : report["tables"].elements()) {
    const std::string name = require_name(claimed["name"].text(), "report.json: tables", longest_derived_name);
    rows.tables.push_back(read_csv(data / (name + ".csv")));
    const Evidence now = evidence_of(rows.tables.back());
    found.rows += static_cast<int>(now.rows.size());
    if (const auto reported = claimed["rows"].natural(); now.rows.size() != reported)
      found.mismatches.push_back(fmt::format("table {}: {} rows, {} were reported", name, now.rows.size(), reported));
    else if (now.fingerprint != claimed["fingerprint"].text())
      found.mismatches.push_back(fmt::format("table {}: a row differs from the reported one", name));
  }
  return rows;
}

std::vector<Scene> read_scenes(const JsonField& report, const fs::path& data, Verification& found) {
  std::vector<Scene> scenes;
  for (const auto& [name, claimed] : report["scenes"].items()) {
    scenes.push_back(read_scene(data / "scenes" / (file_name_of(name) + ".toml")));
    if (scenes.back().hash != claimed["hash"].text())
      found.mismatches.push_back(fmt::format("scene {}: differs from the reported one", name));
  }
  return scenes;
}

void compare(const JsonField& claimed, const Finding& now, const TableSet& rows, Verification& found) {
  const std::string sentence = claimed["sentence"].text();
  const auto differs = [&](const std::string& how) {
    found.mismatches.push_back(fmt::format("\"{}\": {}", sentence, how));
  };
  if (sentence != sentence_of(now)) return differs(fmt::format("the data say \"{}\"", sentence_of(now)));
  if (claimed["tier"].text() != tier_of(now)) return differs(fmt::format("it rests on \"{}\"", tier_of(now)));
  const JsonField all = JsonField::parse(dump(json_of(now)), "the data");
  for (const auto& [key, value] : all.items()) {
    const auto said = claimed.find(key);  // a missing field counts as null
    if ((said ? said->dump() : "null") != value.dump())
      return differs(fmt::format("the data say {}: {}", key, value.dump()));
  }
  const std::vector<Evidence> evidence = evidence_of(now, rows);
  const std::vector<JsonField> rests_on = claimed["evidence"].elements();
  if (rests_on.size() != evidence.size()) return differs("it rests on other tables");
  for (size_t i = 0; i < evidence.size(); ++i)
    if (rests_on[i].json() != json_of(evidence[i]))
      differs(fmt::format("rows of table {} differ from those reported", evidence[i].table));
}

}  // namespace

Verification verify_report(const fs::path& folder) {
  Verification found;
  const JsonField report = read_json(folder);
  require_plain_files(path_inside(folder, "data"));
  const TableSet rows = read_tables(report, folder / "data", found);
  const std::vector<Scene> scenes = read_scenes(report, folder / "data", found);
  found.of_data = found.mismatches.size();
  const AllFindings all = all_findings(scenes, rows);
  const std::vector<const Finding*> now = all.each();
  const std::vector<JsonField> claimed = report["findings"].elements();
  found.findings = static_cast<int>(claimed.size());
  if (claimed.size() != now.size())
    found.mismatches.push_back(fmt::format("{} findings, but the data give {}", claimed.size(), now.size()));
  for (size_t i = 0; i < std::min(claimed.size(), now.size()); ++i) compare(claimed[i], *now[i], rows, found);
  return found;
}

namespace {

/// Scene, rule, method and other method of a sentence.
using Key = std::array<std::string, 4>;
using SentencesByKey = std::map<Key, std::vector<std::string>>;

SentencesByKey findings_in(const fs::path& old) {
  SentencesByKey by_key;
  const JsonField json = read_json(old);
  try {
    for (const JsonField& f : json["findings"].elements())
      by_key[{f["scene"].text(), f["rule"].text(), f["method"].text(), f["other_method"].text()}].push_back(
          f["sentence"].text());
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected a finished report whose findings name their rules: {}", error.what()));
  }
  return by_key;
}

bool rests_on_timings(const std::string& key) {
  const std::string_view rule = std::string_view(key).substr(0, key.find('.'));
  const auto found = std::ranges::find(finding_rules(), rule, &FindingRule::key);  // end() for a rule that was removed
  return found != finding_rules().end() &&
         std::ranges::any_of(found->tables, [](std::string_view table) { return table.ends_with("-cost"); });
}

}  // namespace

std::vector<Change> changes_since(const fs::path& old, const AllFindings& now) {
  SentencesByKey before = findings_in(old), after;
  std::vector<Key> order;  // keys in the order of this report, followed by those of removed findings
  for (const Finding* f : now.each()) {
    const Key key{f->scene, f->rule, f->method, f->other};
    if (!after.contains(key)) order.push_back(key);
    after[key].push_back(sentence_of(*f));
  }
  for (const auto& [key, sentences] : before)
    if (!after.contains(key)) order.push_back(key);
  std::vector<Change> changes;
  for (const Key& key : order) {
    std::vector<std::string>&was = before[key], &is = after[key];
    const size_t count = std::max(was.size(), is.size());
    was.resize(count), is.resize(count);
    for (size_t i = 0; i < count; ++i)
      if (was[i] != is[i]) changes.push_back({key[0], was[i], is[i], rests_on_timings(key[1])});
  }
  return changes;
}

}  // namespace crosscheck
