// Findings: rows of data, each with the rule that it follows from; its sentence is the rule's template, filled in.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/base/json.h"
#include "report/findings/report_data.h"

namespace crosscheck {

/// A kind of finding: how it comes from the tables, and how a reader is told. The table is in rules.cpp; a new kind is
/// a row.
struct FindingRule {
  std::string_view name;
  std::string_view topic;     // answer, agreement, accuracy, failure, cost, contact, order, energy, adequacy, choice
  std::string_view chapter;   // of the report, by its id, that shows it; empty: the part of its scene
  std::string_view quantity;  // what the value is
  std::string_view unit;      // of value, low and high: "m", "s", "%", "1", "m/s", "1/s" or "degrees"
  std::string_view tier;      // of the truth that it rests on; empty: each finding has its own
  /// At most 25 words when filled in. {value}, {low} and {high} are written in their unit, {range} is low to high,
  /// {value±} an exponent with its standard error; {scene}, {method} and {other} are names, all else are words of the
  /// finding.
  std::string_view sentence;
  std::string_view formula;  // over columns of the tables, for a reader with the tables at hand
  std::vector<std::string_view> tables;
  std::string_view figure = {};  // that shows it: "{}" is the finding's scene, "*" any; empty: a table shows it
};

const std::vector<FindingRule>& finding_rules();
/// The rule of that name. Throws std::logic_error with the name where there is none.
const FindingRule& finding_rule(std::string_view name);

struct Finding {
  std::string rule;
  std::string scene = {};          // or empty: of the whole report
  std::string method = {};         // or engine that it is about
  std::string other = {};          // and the one that this is compared with
  double value = 0;                // of the rule's quantity, in its unit
  std::optional<double> low = {};  // interval: an error bar, what a search could tell, or the range over scenes
  std::optional<double> high = {};
  std::string tier = {};                          // where the rule names none
  std::map<std::string, std::string> words = {};  // that its template names besides
};

/// For a reader who has never seen the code. Throws std::logic_error where the template names what is not there.
std::string sentence_of(const Finding& finding);
std::string tier_of(const Finding& finding);
/// All of it but its rows, as report.json has it.
Json json_of(const Finding& finding);

// Who is told of: each function is a part of the report.

/// Findings of one scene.
std::vector<Finding> findings_of(const Scene& scene, const SceneData& data, const TableSet& rows);
/// Findings of all scenes together, the most important first.
std::vector<Finding> overall_findings(const std::vector<Scene>& scenes, const std::vector<SceneData>& data,
                                      const TableSet& rows);

/// The cheapest runs within 1 % of the motion, by engine.
std::vector<Finding> speed_findings(const TableSet& rows);
/// The cost of a step in several engines.
std::vector<Finding> cost_findings(const TableSet& rows);
/// Of experiment `stability`: limits beside theory, and methods without a stable step.
std::vector<Finding> limit_findings(const TableSet& rows);
std::vector<Finding> stability_findings(const TableSet& rows);
/// Of experiment `stiffness`: how soft position-based methods make a cloth at the step of a game.
std::vector<Finding> stiffness_findings(const TableSet& rows);
/// Of experiment `energy`.
std::vector<Finding> energy_findings(const TableSet& rows);
/// Of experiment `sphere`: all of them, those on where particles leave a ball, and on the cloth that slides off.
std::vector<Finding> sphere_findings(const TableSet& rows);
std::vector<Finding> leaving_findings(const Table& leaving);
std::vector<Finding> drape_findings(const Table& drapes);
/// The least models; and what stiffness must become on a finer grid: of all springs, and of bend springs.
std::vector<Finding> adequacy_findings(const TableSet& rows);
std::vector<Finding> bend_findings(const TableSet& rows);

/// Their sentences, one after the other.
std::string sentences_of(const std::vector<Finding>& findings);

}  // namespace crosscheck
