// Sentences on speed against accuracy and on the cost of a step.
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "experiments/cells.h"
#include "experiments/speed_accuracy/by_engine.h"
#include "report/findings.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

bool tried_bullet(const Rows& result, const std::string& scene) {
  const Table* runs = result.table("speed-accuracy");
  for (size_t i = 0; runs && i < runs->rows.size(); ++i)
    if (text_at(*runs, i, "scene") == scene && text_at(*runs, i, "method").starts_with("bullet/") &&
        text_at(*runs, i, "verdict") != "unsupported")
      return true;
  return false;
}

/// What the same comparison gives in force evaluations: whether it is the method that is dearer, or its engine.
std::optional<std::string> factors_of_evaluations(const Rows& result) {
  const Table* t = result.table("speed-accuracy-cheapest");
  double low = 1e300, high = 0;
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    const auto factor = number_at(*t, i, "Bullet / best");
    if (number_at(*t, i, "part of motion") != 0.01 || text_at(*t, i, "measure") != "error" || !factor) continue;
    low = std::min(low, *factor), high = std::max(high, *factor);
  }
  if (!(high > 0)) return std::nullopt;
  return range(times_text(low), times_text(high));
}

/// Whether the method takes the scene, as far as experiment `engines` asked.
bool takes(const Rows& result, const std::string& scene, const std::string& method) {
  const Table* t = result.table("engines");
  for (size_t i = 0; t && i < t->rows.size(); ++i)
    if (text_at(*t, i, "scene") == scene && text_at(*t, i, "method") == method)
      return text_at(*t, i, "verdict") != "unsupported";
  return false;
}

/// Who was hardly tried where others were: with less than two runs on a scene that they take.
std::string hardly_tried(const Rows& result) {
  const Table* t = result.table("speed-accuracy");
  if (!t) return "";
  std::vector<std::string> scenes;
  for (const std::string& scene : distinct(*t, "scene")) {
    std::vector<std::string> seldom;
    for (const std::string& method : distinct(*t, "method")) {
      if (!takes(result, scene, method)) continue;
      int runs = 0;
      for (size_t i = 0; i < t->rows.size(); ++i)
        runs += text_at(*t, i, "scene") == scene && text_at(*t, i, "method") == method;
      if (runs < 2) seldom.push_back(fmt::format("{} ({})", method, runs == 0 ? "no run" : "one run"));
    }
    if (!seldom.empty()) scenes.push_back(fmt::format("{} on {}", joined(seldom), scene));
  }
  return scenes.empty() ? "" : fmt::format(" Hardly tried: {}.", joined(scenes));
}

/// "mysim on 11 scenes (leapfrog on spring and chain, xpbd on projectile) and odeint/dopri5 on rod"
std::string told_by_engine(const std::map<std::string, std::vector<std::string>>& scenes_of) {
  std::map<std::string, std::vector<std::string>> lines;  // by engine
  std::map<std::string, size_t> wins;
  for (const auto& [method, where] : scenes_of) {
    const std::string engine = engine_of(method);
    wins[engine] += where.size();
    lines[engine].push_back(fmt::format("{} on {}", method.substr(method.find('/') + 1), joined(where)));
  }
  std::vector<std::pair<size_t, std::string>> engines;
  for (const auto& [engine, scenes] : wins) engines.emplace_back(scenes, engine);
  std::ranges::stable_sort(engines, std::greater(), &std::pair<size_t, std::string>::first);
  std::vector<std::string> out;
  for (const auto& [scenes, engine] : engines)
    out.push_back(lines[engine].size() == 1
                      ? fmt::format("of {}/{}", engine, lines[engine][0])
                      : fmt::format("of {} on {} scenes ({})", engine, scenes, fmt::join(lines[engine], "; ")));
  return joined(out);
}

/// Who meets 1 % of the motion at the least CPU time, on how many scenes.
void cheapest_for_one_percent(const Rows& result, std::vector<Finding>& out) {
  const Table* t = result.table("speed-accuracy-cheapest-cost");
  if (!t) return;
  std::map<std::string, std::vector<std::string>> scenes_of;  // by the cheapest
  size_t shared = 0, scenes = 0;                              // where the clock cannot tell another from it
  double low = 1e300, high = 0;
  std::vector<std::string> without;  // scenes on which no run of Bullet that was tried meets it
  for (size_t i = 0; i < t->rows.size(); ++i) {
    const std::string method = text_or_none(*t, i, "method");
    if (number_at(*t, i, "part of motion") != 0.01 || method.empty() || text_at(*t, i, "measure") != "error") continue;
    scenes_of[method].push_back(text_at(*t, i, "scene"));
    ++scenes;
    shared += !text_or_none(*t, i, "as cheap within noise").empty();
    if (const auto factor = number_at(*t, i, "Bullet / best")) {
      low = std::min(low, *factor);
      high = std::max(high, *factor);
    } else if (tried_bullet(result, text_at(*t, i, "scene"))) {
      without.push_back(text_at(*t, i, "scene"));
    }
  }
  if (scenes_of.empty()) return;
  std::string sentence =
      fmt::format("For an error of 1 % of the motion the cheapest of the runs tried, in CPU time, is {}",
                  told_by_engine(scenes_of));
  if (shared > 0)
    sentence +=
        shared == scenes && scenes == 1
            ? "; another method is no dearer within the noise"
            : fmt::format("; on {} of these {} scenes another method is no dearer within the noise", shared, scenes);
  if (high > 0) {
    sentence += fmt::format("; the best run of Bullet's worlds takes {} times as long as the cheapest",
                            range(times_text(low), times_text(high)));
    if (const auto evaluations = factors_of_evaluations(result))
      sentence += *evaluations == "1"
                      ? "; where runs are chosen by force evaluations instead, it takes as many as mysim"
                      : fmt::format(
                            "; where runs are chosen by force evaluations instead, it takes {} "
                            "times as many as the best",
                            *evaluations);
  }
  if (!without.empty()) sentence += "; no run of Bullet that was tried meets it on " + joined(without);
  out.push_back({"", "cost", sentence + "." + hardly_tried(result), "measured", "cheapest"});
}

/// The same rule in both engines, over the sizes.
void step_of_both(const Rows& result, std::vector<Finding>& out) {
  const Table* t = result.table("size-cost");
  if (!t) return;
  std::map<long, std::pair<double, double>> per_side;  // ours, theirs: s per step
  for (size_t i = 0; i < t->rows.size(); ++i) {
    const std::string& method = text_at(*t, i, "method");
    auto& both = per_side[std::get<long>(t->at(i, "side"))];
    if (method == ours) both.first = number_at(*t, i, "cpu per step", 0);
    if (method == theirs) both.second = number_at(*t, i, "cpu per step", 0);
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
                   per_side.begin()->first, per_side.rbegin()->first, range(times_text(low), times_text(high))),
       "measured", "size-cost"});
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
