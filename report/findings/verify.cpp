// Reads report.json again.
#include "report/findings/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "report/findings/evidence.h"

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
  for (const JsonField& claimed : report["tables"].elements()) {
    const std::string name = claimed["name"].text();
    rows.tables.push_back(read_csv(data / (name + ".csv")));
    const Evidence now = evidence_of(rows.tables.back());
    found.rows += static_cast<int>(now.rows.size());
    if (const auto reported = claimed["rows"].natural(); now.rows.size() != reported)
      found.mismatches.push_back(fmt::format("table {}: {} rows, reported were {}", name, now.rows.size(), reported));
    else if (now.fingerprint != claimed["fingerprint"].text())
      found.mismatches.push_back(fmt::format("table {}: some row is not the one that was reported", name));
  }
  return rows;
}

std::vector<Scene> read_scenes(const JsonField& report, const fs::path& data, Verification& found) {
  std::vector<Scene> scenes;
  for (const auto& [name, claimed] : report["scenes"].items()) {
    scenes.push_back(read_scene(data / "scenes" / (file_name_of(name) + ".toml")));
    if (scenes.back().hash != claimed["hash"].text())
      found.mismatches.push_back(fmt::format("scene {}: not the one that was reported", name));
  }
  return scenes;
}

void compare(const JsonField& claimed, const Finding& now, const Rows& rows, Verification& found) {
  const std::string sentence = claimed["sentence"].text();
  const auto differs = [&](const std::string& how) {
    found.mismatches.push_back(fmt::format("\"{}\": {}", sentence, how));
  };
  if (sentence != now.sentence) return differs(fmt::format("the data say \"{}\"", now.sentence));
  if (claimed["tier"].text() != now.tier) return differs(fmt::format("it rests on \"{}\"", now.tier));
  const std::vector<Evidence> evidence = evidence_of(now, rows);
  const std::vector<JsonField> rests_on = claimed["evidence"].elements();
  if (rests_on.size() != evidence.size()) return differs("it rests on other tables");
  for (size_t i = 0; i < evidence.size(); ++i)
    if (rests_on[i]["table"].text() != evidence[i].table ||
        rests_on[i]["rows"].dump() != Json(evidence[i].rows).dump() ||
        rests_on[i]["fingerprint"].text() != evidence[i].fingerprint)
      differs(fmt::format("rows of table {} are not those that were reported", evidence[i].table));
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
  const std::vector<JsonField> claimed = report["findings"].elements();
  found.findings = static_cast<int>(claimed.size());
  if (claimed.size() != now.size())
    found.mismatches.push_back(fmt::format("{} findings, but the data give {}", claimed.size(), now.size()));
  for (size_t i = 0; i < std::min(claimed.size(), now.size()); ++i) compare(claimed[i], now[i], rows, found);
  return found;
}

namespace {

/// Sentences by scene and rule.
using SentencesByRule = std::map<std::pair<std::string, std::string>, std::vector<std::string>>;

SentencesByRule findings_in(const std::filesystem::path& old) {
  const std::filesystem::path file = old / "report.json";
  SentencesByRule by_rule;
  try {
    const JsonField json = JsonField::parse_file(file.string());
    for (const JsonField& finding : json["findings"].elements())
      by_rule[{finding["scene"].text(), finding["rule"].text()}].push_back(finding["sentence"].text());
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected a finished report whose findings name their rules: {}", error.what()));
  }
  return by_rule;
}

bool rests_on_timings(const std::string& rule) {
  const auto& rules = finding_rules();
  const auto found = std::find_if(rules.begin(), rules.end(), [&](const FindingRule& r) { return r.name == rule; });
  return found != rules.end() && std::any_of(found->tables.begin(), found->tables.end(),
                                             [](std::string_view table) { return table.ends_with("-cost"); });
}

}  // namespace

std::vector<Change> changes_since(const std::filesystem::path& old, const AllFindings& now) {
  const SentencesByRule before = findings_in(old);
  SentencesByRule after;
  std::vector<std::pair<std::string, std::string>> order;  // of this report, then what is gone
  const auto take = [&](const Finding& f) {
    auto& sentences = after[{f.scene, f.rule}];
    if (sentences.empty()) order.emplace_back(f.scene, f.rule);
    sentences.push_back(f.sentence);
  };
  for (const Finding& f : now.overall) take(f);
  for (const auto& of_scene : now.of_scenes)
    for (const Finding& f : of_scene) take(f);
  for (const auto& [key, sentences] : before)
    if (!after.contains(key)) order.push_back(key);

  std::vector<Change> changes;
  for (const auto& key : order) {
    const SentencesByRule::const_iterator was = before.find(key), is = after.find(key);
    const auto sentence = [&](const SentencesByRule& by_rule, SentencesByRule::const_iterator at, size_t i) {
      return at != by_rule.end() && i < at->second.size() ? at->second[i] : std::string();
    };
    const size_t count =
        std::max(was == before.end() ? 0 : was->second.size(), is == after.end() ? 0 : is->second.size());
    for (size_t i = 0; i < count; ++i) {
      Change change{key.first, sentence(before, was, i), sentence(after, is, i), rests_on_timings(key.second)};
      if (change.before != change.now) changes.push_back(std::move(change));
    }
  }
  return changes;
}

}  // namespace crosscheck
