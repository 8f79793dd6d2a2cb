// Findings of the search for the largest stable steps.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/tables/table.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Methods that fail at every step, as theory says; and the rates at which they do.
void without_stable_step(const Table& table, const Table* growth, std::vector<Finding>& out) {
  std::map<std::string, std::set<std::string>> scenes_of;  // by method
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (text_at(table, i, "state") == "rest" && text_at(table, i, "prediction") == "no stable step" &&
        text_at(table, i, "measurement") == "no stable step")
      scenes_of[text_at(table, i, "method")].insert(text_at(table, i, "scene"));
  if (scenes_of.empty()) return;
  std::map<std::set<std::string>, std::vector<std::string>> methods_of;  // by the scenes that they fail on
  for (const auto& [method, scenes] : scenes_of) methods_of[scenes].push_back(method);
  std::string who;
  for (const auto& [scenes, methods] : methods_of)
    who += fmt::format("{}{} {} no stable step at all on {}", who.empty() ? "" : "; ", joined(methods),
                       methods.size() == 1 ? "has" : "have", joined({scenes.begin(), scenes.end()}));
  double off = -1;
  std::string which;
  for (size_t i = 0; growth && i < growth->rows.size(); ++i) {
    const double deviation = std::abs(number_at(*growth, i, "deviation", NAN));
    // close to a limit other things are measured
    if (number_at(*growth, i, "share of limit") || !(deviation > off)) continue;
    off = deviation;
    which = fmt::format("{} on {}", text_at(*growth, i, "method"), text_at(*growth, i, "scene"));
  }
  std::string rate;
  if (off >= 0 && off <= 0.01)
    rate = fmt::format(": vibrations grow in every step, at the rate that theory gives (to {})", percent(off, 1));
  if (off > 0.01)
    rate = fmt::format("; the growth in a step differs from theory by up to {} ({})", percent(off, 1), which);
  out.push_back({"", "failure", fmt::format("{}, as theory says{}.", who, rate), "measured", "no-stable-step"});
}

}  // namespace

std::vector<Finding> stability_findings(const Rows& rows) {
  std::vector<Finding> out;
  const Table* table = rows.table("stability");
  if (!table) return out;
  for (const StepLimitSummary& summary : step_limit_summaries(*table))
    out.push_back({"",
                   summary.theory_holds ? "agreement"
                   : summary.at_rest    ? "failure"
                                        : "accuracy",
                   summary.sentence, "measured", "step-limits"});
  without_stable_step(*table, rows.table("stability-growth"), out);
  return out;
}

}  // namespace crosscheck
