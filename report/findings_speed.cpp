// Sentences on speed against accuracy and on the cost of a step.
#include <algorithm>
#include <map>

#include "report/findings.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

/// Who meets 1 % of the motion at the least CPU time, on how many scenes.
void cheapest_for_one_percent(const Rows& result, std::vector<Finding>& out) {
  const Table* t = result.table("speed-accuracy-cheapest-cost");
  if (!t) return;
  std::map<std::string, std::vector<std::string>> scenes_of;  // by the cheapest
  double low = 1e300, high = 0;
  std::vector<std::string> without;  // scenes on which no run of Bullet meets it
  for (size_t i = 0; i < t->rows.size(); ++i) {
    const auto* method = std::get_if<std::string>(&t->at(i, "method"));
    if (std::get<double>(t->at(i, "part of motion")) != 0.01 || !method ||
        std::get<std::string>(t->at(i, "measure")) != "error")
      continue;
    std::string where = std::get<std::string>(t->at(i, "scene"));
    // what the clock cannot tell apart shares the place
    if (const auto* same = std::get_if<std::string>(&t->at(i, "as cheap within noise")); same && !same->empty())
      where += fmt::format(" (there {} no dearer within the noise)", *same);
    scenes_of[*method].push_back(where);
    if (const auto* factor = std::get_if<double>(&t->at(i, "Bullet / best"))) {
      low = std::min(low, *factor);
      high = std::max(high, *factor);
    } else {
      without.push_back(std::get<std::string>(t->at(i, "scene")));
    }
  }
  if (scenes_of.empty()) return;
  std::vector<std::string> who;
  for (const auto& [method, where] : scenes_of) who.push_back(fmt::format("{} on {}", method, joined(where)));
  std::string sentence = fmt::format(
      "For an error of 1 % of the motion the cheapest of the runs tried, in CPU time, are of {}", joined(who));
  if (high > 0)
    sentence += fmt::format("; the best of Bullet's worlds takes {} times as much",
                            range(fmt::format("{:.2g}", low), fmt::format("{:.2g}", high)));
  if (!without.empty()) sentence += "; no run of Bullet meets it on " + joined(without);
  out.push_back({"", "cost", sentence + ".", "measured"});
}

/// The same rule in both engines, over the sizes.
void step_of_both(const Rows& result, std::vector<Finding>& out) {
  const Table* t = result.table("size-cost");
  if (!t) return;
  std::map<long, std::pair<double, double>> per_side;  // ours, theirs: s per step
  for (size_t i = 0; i < t->rows.size(); ++i) {
    const auto& method = std::get<std::string>(t->at(i, "method"));
    auto& both = per_side[std::get<long>(t->at(i, "side"))];
    if (method == ours) both.first = std::get<double>(t->at(i, "cpu per step"));
    if (method == theirs) both.second = std::get<double>(t->at(i, "cpu per step"));
  }
  std::erase_if(per_side, [](const auto& s) { return !(s.second.first > 0 && s.second.second > 0); });
  if (per_side.empty()) return;
  double low = 1e300, high = 0;
  for (const auto& [side, both] : per_side) {
    low = std::min(low, both.second / both.first);
    high = std::max(high, both.second / both.first);
  }
  out.push_back(
      {"", "cost",
       fmt::format("On cloth of {0} x {0} to {1} x {1} particles a step of symplectic Euler costs Bullet (Debian's "
                   "build) {2} times the CPU time of mysim.",
                   per_side.begin()->first, per_side.rbegin()->first,
                   range(fmt::format("{:.2g}", low), fmt::format("{:.2g}", high))),
       "measured"});
}

}  // namespace

std::vector<Finding> speed_findings(const Rows& result) {
  std::vector<Finding> out;
  cheapest_for_one_percent(result, out);
  return out;
}

std::vector<Finding> cost_findings(const Rows& result) {
  std::vector<Finding> out;
  step_of_both(result, out);
  return out;
}

}  // namespace crosscheck
