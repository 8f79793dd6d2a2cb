// Sentences on speed against accuracy and on the cost of a step.

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/tables/engines.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

bool tried_bullet(const Rows& result, const std::string& scene) {
  const Table* runs = result.table("speed-accuracy");
  for (size_t i = 0; runs && i < runs->rows.size(); ++i)
    if (text_at(*runs, i, "scene") == scene && family_of(text_at(*runs, i, "method")).is_default_peer() &&
        text_at(*runs, i, "verdict") != "unsupported")
      return true;
  return false;
}

/// The same comparison in force evaluations: whether the method is slower, or its engine.
std::optional<std::string> factors_of_evaluations(const Rows& result) {
  const Table* t = result.table("speed-accuracy-cheapest");
  double low = 1e300, high = 0;
  for (size_t i = 0; t && i < t->rows.size(); ++i) {
    const auto factor = number_at(*t, i, "Bullet / mysim");
    if (number_at(*t, i, "part of motion") != 0.01 || text_at(*t, i, "measure") != "error" || !factor) continue;
    low = std::min(low, *factor), high = std::max(high, *factor);
  }
  if (!(high > 0)) return std::nullopt;
  return range(times_text(low), times_text(high));
}

/// Whether the method takes the scene, as far as experiment `engines` ran it.
bool takes(const Rows& result, const std::string& scene, const std::string& method) {
  for (const EngineRow& run : rows_of<EngineRow>(result))
    if (run.scene == scene && run.method == method) return run.verdict != Verdict::unsupported;
  return false;
}

/// Methods that were hardly tried where others were: with less than two runs on a scene that they take.
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

/// The methods that timing cannot distinguish from the cheapest, it among them.
std::vector<std::string> cheapest_ones(const Table& t, size_t row) {
  std::vector<std::string> all{text_at(t, row, "method")};
  std::istringstream others(text_or_none(t, row, "as cheap within noise"));
  for (std::string name; std::getline(others, name, ',');) all.push_back(name.substr(name.find_first_not_of(' ')));
  return all;
}

/// "leapfrog or rk4", where all are of one engine; else nothing.
std::optional<std::string> of_one_engine(const std::vector<std::string>& methods) {
  std::string text;
  for (const std::string& method : methods) {
    if (engine_of(method) != engine_of(methods.front())) return std::nullopt;
    text += text.empty() ? method : " or " + method.substr(method.find('/') + 1);
  }
  return text;
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

/// The methods that meet 1 % of the motion at the least CPU time, and on how many scenes.
void cheapest_for_one_percent(const Rows& result, std::vector<Finding>& out) {
  const Table* t = result.table("speed-accuracy-cheapest-cost");
  if (!t) return;
  std::map<std::string, std::vector<std::string>> scenes_of;  // by the cheapest
  std::vector<std::string> ties;                              // scenes where timing cannot distinguish engines
  double low = 1e300, high = 0;
  std::vector<std::string> without;  // scenes on which no run of Bullet that was tried meets it
  for (size_t i = 0; i < t->rows.size(); ++i) {
    const std::string method = text_or_none(*t, i, "method");
    if (number_at(*t, i, "part of motion") != 0.01 || method.empty() || text_at(*t, i, "measure") != "error") continue;
    const std::vector<std::string> first = cheapest_ones(*t, i);
    if (const auto name = of_one_engine(first))
      scenes_of[*name].push_back(text_at(*t, i, "scene"));
    else
      ties.push_back(fmt::format("{} ({})", text_at(*t, i, "scene"), fmt::join(first, ", ")));
    if (const auto factor = number_at(*t, i, "Bullet / mysim")) {
      low = std::min(low, *factor);
      high = std::max(high, *factor);
    } else if (tried_bullet(result, text_at(*t, i, "scene"))) {
      without.push_back(text_at(*t, i, "scene"));
    }
  }
  if (scenes_of.empty() && ties.empty()) return;
  std::string sentence = "For an error of 1 % of the motion ";
  if (!scenes_of.empty())
    sentence += fmt::format("the cheapest of the runs tried, in CPU time, is {}", told_by_engine(scenes_of));
  if (!ties.empty())
    sentence += fmt::format("{}the clock cannot tell the cheapest of two engines apart on {}",
                            scenes_of.empty() ? "" : "; ", joined(ties));
  if (high > 0) {
    sentence += fmt::format("; the best run of Bullet's worlds takes {} times as long as that of mysim",
                            range(times_text(low), times_text(high)));
    if (const auto evaluations = factors_of_evaluations(result))
      sentence += *evaluations == "1"
                      ? "; where runs are chosen by force evaluations instead, it takes as many as mysim"
                      : fmt::format(
                            "; where runs are chosen by force evaluations instead, it takes {} "
                            "times as many as mysim",
                            *evaluations);
  }
  if (!without.empty()) sentence += "; no run of Bullet that was tried meets it on " + joined(without);
  out.push_back({"", "cost", sentence + "." + hardly_tried(result), "measured", "cheapest"});
}

/// The same rule in both engines, over the sizes: by kernels for any spring graph on both sides, and by mysim's fused
/// step on regular cloths, of which Bullet has no like.
void step_of_both(const Rows& result, std::vector<Finding>& out) {
  const Table* t = result.table("size-cost");
  if (!t) return;
  const std::string plain = ours + "+plain";
  std::map<long, std::map<std::string, double>> per_side;  // s per step
  for (size_t i = 0; i < t->rows.size(); ++i)
    per_side[std::get<long>(t->at(i, "side"))][text_at(*t, i, "method")] = number_at(*t, i, "cpu per step", 0);
  const auto beside = [&](const std::string& method) -> std::string {
    std::map<double, long> ratios;  // and the sides that they are of
    for (auto& [side, times] : per_side)
      if (times[method] > 0 && times[theirs] > 0) ratios.emplace(times[theirs] / times[method], side);
    if (ratios.empty()) return "";
    const auto told = [](const auto& each) {
      return fmt::format("{0} ({1} x {1})", times_text(each.first), each.second);
    };
    return range(told(*ratios.begin()), told(*ratios.rbegin()));
  };
  const std::string any_network = beside(plain), regular = beside(ours);
  std::vector<std::string> parts;
  if (!any_network.empty())
    parts.push_back(fmt::format("{} times that of mysim's solver for any network", any_network));
  if (!regular.empty())
    parts.push_back(
        fmt::format("{} times that of mysim's kernel for regular cloths, which Bullet has no like of", regular));
  if (!parts.empty())
    out.push_back({"", "cost",
                   fmt::format("In CPU time a step of symplectic Euler on a cloth costs Bullet (Debian's build) {}.",
                               joined(parts)),
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
