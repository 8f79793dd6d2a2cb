// Findings: numbers from the tables, each with the rule that it follows from and a sentence for the reader.
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

/// The data that findings are made from: all tables, and of a report its scenes. `scene` and `of` are set where one
/// scene is the subject.
struct Facts {
  const TableSet& rows;
  std::span<const Scene> scenes = {};
  std::span<const SceneData> data = {};  // one for each scene
  const Scene* scene = nullptr;
  const SceneData* of = nullptr;
  Facts(const TableSet& all, std::span<const Scene> shown = {}, std::span<const SceneData> their_data = {})
      : rows(all), scenes(shown), data(their_data) {}
};

struct Finding {
  std::string rule;                // key of its text: a rule's key, or "rule.variant"
  std::string scene = {};          // or empty: of the whole report
  std::string method = {};         // or engine that it is about
  std::string other = {};          // and the one that this is compared with
  double value = 0;                // of the rule's quantity, in its unit
  std::optional<double> low = {};  // interval: an error bar, what a search could tell, or the range over scenes
  std::optional<double> high = {};
  std::string tier = {};                          // where the rule names none
  std::map<std::string, std::string> words = {};  // names, numbers and lists that its text asks for besides
};

using Findings = std::vector<Finding>;

/// A kind of finding. The table is in rules.cpp; a new kind is a row there and a text in texts/.
struct FindingRule {
  std::string_view key;
  Findings (*find)(const Facts&);  // several rows may share a function, which is called once
  std::string_view topic;     // answer, agreement, accuracy, failure, cost, contact, order, energy, adequacy, choice
  std::string_view chapter;   // id of the chapter that shows it; empty: the part of its scene
  std::string_view quantity;  // name of the value
  std::string_view unit;      // of value, low and high: "m", "s", "%", "1", "m/s", "1/s" or "degrees"
  std::string_view tier;      // tier of its truth; empty: each finding has its own
  std::string_view words;     // that its findings may have, separated by blanks
  std::vector<std::string_view> tables;  // that it rests on
  std::string_view figure = {};          // that shows it: "{}" is the finding's scene, "*" any; empty: a table shows it
};

const std::vector<FindingRule>& finding_rules();
/// The rule of a key, with a variant or without. Throws std::logic_error with the key where there is none.
const FindingRule& finding_rule(std::string_view key);

/// The findings of the rules with a chapter (`of_scene`: without one), in the order of the table.
Findings found_by_rules(const Facts& facts, bool of_scene);

// Texts, from texts/*.md: "## KEY", a sentence, and "Formula: " with how the value follows from the columns of the
// tables. In a sentence {value}, {low} and {high} are written in the rule's unit, {range} is low to high, {value±} an
// exponent with its standard error; {scene}, {method} and {other} are names, all else are words of the finding. A part
// in square brackets is left out where one of its words is empty.

struct FindingText {
  std::string sentence, formula;
};
/// All texts by key. Throws std::runtime_error that names file and line where one is not of that form.
const std::map<std::string, FindingText>& finding_texts();

/// Throws std::logic_error where the text names what the finding does not have.
std::string sentence_of(const Finding& finding);
/// Their sentences, one after the other.
std::string sentences_of(const Findings& findings);
std::string tier_of(const Finding& finding);
/// All of it but its rows, as report.json has it.
Json json_of(const Finding& finding);

// Functions of the rules, by the file that they are in.

// answers.cpp: one finding or none each
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
// scene.cpp: of one scene
Findings scene_findings(const Facts&);
// recommendation.cpp: of one scene
Findings recommendation_findings(const Facts&);

}  // namespace crosscheck
