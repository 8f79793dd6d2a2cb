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
};

/// All of them; a new kind of finding is a row.
const std::vector<FindingRule>& finding_rules();

/// Throws std::logic_error with the name where there is none.
const FindingRule& finding_rule(std::string_view name);

}  // namespace crosscheck
