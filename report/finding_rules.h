// How each kind of finding comes from the tables: the formula behind its sentence, and where its rows stand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

struct FindingRule {
  std::string_view name;
  std::string_view formula;  // over columns of the tables, for a reader with the tables at hand
  std::vector<std::string_view> tables;
  std::string_view figure = {};  // that shows it: "{}" is the finding's scene, "*" any; empty: a table does
};

/// All of them; a new kind of finding is a row.
const std::vector<FindingRule>& finding_rules();

/// Throws std::logic_error with the name where there is none.
const FindingRule& finding_rule(std::string_view name);

/// The figure that shows a finding, of those that there are; of several the last. Empty where there is none.
std::string figure_of(std::string_view rule, const std::string& scene, const std::vector<std::string>& figures);

}  // namespace crosscheck
