#include "report/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "mysim/errors.h"
#include "mysim/json.h"
#include "report/finding_rules.h"

namespace crosscheck {
namespace {

/// Sentences by scene and rule.
using Told = std::map<std::pair<std::string, std::string>, std::vector<std::string>>;

Told told_in(const std::filesystem::path& old) {
  const std::filesystem::path file = old / "report.json";
  Told told;
  try {
    const JsonField json = JsonField::parse_file(file.string());
    for (const JsonField& finding : json["findings"].elements())
      told[{finding["scene"].text(), finding["rule"].text()}].push_back(finding["sentence"].text());
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected a finished report whose findings name their rules: {}", error.what()));
  }
  return told;
}

bool rests_on_timings(const std::string& rule) {
  const auto& rules = finding_rules();
  const auto found = std::find_if(rules.begin(), rules.end(), [&](const FindingRule& r) { return r.name == rule; });
  return found != rules.end() && std::any_of(found->tables.begin(), found->tables.end(),
                                             [](std::string_view table) { return table.ends_with("-cost"); });
}

}  // namespace

std::vector<Change> changes_since(const std::filesystem::path& old, const AllFindings& now) {
  const Told before = told_in(old);
  Told after;
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
    const Told::const_iterator was = before.find(key), is = after.find(key);
    const auto sentence = [&](const Told& told, Told::const_iterator at, size_t i) {
      return at != told.end() && i < at->second.size() ? at->second[i] : std::string();
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
