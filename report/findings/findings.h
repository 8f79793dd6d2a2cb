// Findings: numbers from the tables, each with its rule and a sentence.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/base/json.h"
#include "report/findings/report_data.h"

namespace crosscheck {

/// All tables and, in a report, its scenes. `scene` and `of` are set for findings about a single scene.
struct Facts {
  const TableSet& rows;
  std::span<const Scene> scenes = {};
  std::span<const SceneData> data = {};  // one per scene
  const Scene* scene = nullptr;
  const SceneData* of = nullptr;
  Facts(const TableSet& all, std::span<const Scene> shown = {}, std::span<const SceneData> their_data = {})
      : rows(all), scenes(shown), data(their_data) {}
};

struct Finding {
  std::string rule;                // a rule's key, or "rule.variant"
  std::string scene = {};          // empty: the whole report
  std::string method = {};         // method or engine that the finding is about
  std::string other = {};          // method or engine compared with `method`
  double value = 0;                // in the unit of the rule
  std::optional<double> low = {};  // interval: an error bar, the resolution of a search, or the range over scenes
  std::optional<double> high = {};
  std::string tier = {};
  std::map<std::string, std::string> words = {};  // values of the placeholders in its text
};

using Findings = std::vector<Finding>;

/// To add a kind of finding, add a row in rules.cpp and a text in texts/.
struct FindingRule {
  std::string_view key;
  Findings (*find)(const Facts&);  // called once, even if several rows share it
  std::string_view topic;     // answer, agreement, accuracy, failure, cost, contact, order, energy, adequacy, choice
  std::string_view chapter;   // id of its chapter; empty: it is in the section of its scene
  std::string_view quantity;  // name of `value`
  std::string_view unit;      // unit of `value`, `low` and `high`: "m", "s", "%", "1", "m/s", "1/s" or "degrees"
  std::string_view tier;      // tier of its truth; empty: set in each finding
  std::string_view words;     // placeholders that its findings may define, separated by blanks
  std::vector<std::string_view> tables;
  std::string_view figure = {};  // figure that shows the finding ("{}": its scene, "*": any text); empty: a table
};

const std::vector<FindingRule>& finding_rules();
/// Accepts a key with or without a variant. Throws std::logic_error with the key if it is unknown.
const FindingRule& finding_rule(std::string_view key);

/// Findings of the rules with a chapter, or, if `of_scene`, of the rules without one; in the rules' order.
Findings found_by_rules(const Facts& facts, bool of_scene);

// Texts, from texts/*.md: "## KEY", a sentence, and "Formula: " with the formula of the value in terms of table
// columns. {value}, {low} and {high} are written in the rule's unit, {range} is "low to high", and {value±} is an
// exponent with its standard error. {scene}, {method} and {other} are names; other placeholders are in Finding::words.
// Square brackets enclose text that is omitted if one of its placeholders is empty.

struct FindingText {
  std::string sentence, formula;
};
/// Texts by key. Throws std::runtime_error with file and line if a text is malformed.
const std::map<std::string, FindingText>& finding_texts();

/// Throws std::logic_error if the text uses a word that the finding does not have.
std::string sentence_of(const Finding& finding);
std::string sentences_of(const Findings& findings);
std::string tier_of(const Finding& finding);
/// In the format of report.json, without the rows.
Json json_of(const Finding& finding);

// Functions that the rules call.

// answers.cpp: at most one finding each
Findings agreement_answer(const Facts&);
Findings method_answer(const Facts&);
Findings failure_answer(const Facts&);
Findings ball_answer(const Facts&);
Findings energy_answer(const Facts&);
Findings model_answer(const Facts&);
// overall.cpp
Findings relation_findings(const Facts&);
Findings failure_findings(const Facts&);
Findings order_findings(const Facts&);
// speed.cpp
Findings speed_findings(const Facts&);
Findings cost_findings(const Facts&);
// stability.cpp
Findings limit_findings(const Facts&);
Findings stability_findings(const Facts&);
// energy.cpp
Findings energy_findings(const Facts&);
// contact.cpp
Findings contact_findings(const Facts&);
Findings cone_findings(const Facts&);
Findings plane_findings(const Facts&);
Findings leaving_findings(const Facts&);
Findings drape_findings(const Facts&);
// adequacy.cpp
Findings adequacy_findings(const Facts&);
Findings bend_findings(const Facts&);
// scene.cpp: one scene
Findings scene_findings(const Facts&);
// recommendation.cpp: one scene
Findings recommendation_findings(const Facts&);

}  // namespace crosscheck
