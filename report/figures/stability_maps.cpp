// Stability maps: the outcome of runs over time step and stiffness, and over time step and drag.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/tables/table.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// A verdict with its colour and its text in the key. Each is at least 8 in lightness (CIE L*) from every other.
struct CellClass {
  const char *verdict, *title, *colour;
};
constexpr CellClass cell_classes[] = {
    {"ok", "stable", "#CBDAE1"},
    {"energy", "blows up", "#B44E00"},
    {"nan", "not a number", "#5D2252"},
    {"stretch", "overstretched", "#E8B34C"},
    {"solver", "solver gives up", "#525252"},
    {"frozen", "frozen", "#50A9DB"},
    {"timeout", "time limit", "#00996F"},
    {"crash", "program fails", "#222222"},
    {"unsupported", "unsupported", "#F7F5EE"},
};
int kind_of(const std::string& verdict) {
  for (size_t i = 0; i < std::size(cell_classes); ++i)
    if (verdict == cell_classes[i].verdict) return static_cast<int>(i);
  return 1;
}

/// Compares the predicted limit of each row of a map with the steps at which runs begin to fail.
class RowsAgainstTheory {
 public:
  explicit RowsAgainstTheory(std::string kind) : kind_(std::move(kind)) {}

  void add(const Table& limits, size_t i) {
    const auto predicted = number_at(limits, i, "predicted limit");
    if (!predicted) return;
    const double held = number_at(limits, i, "held", 0), failed = number_at(limits, i, "failed", INFINITY);
    if (*predicted == 0) {
      if (held == 0) ++none_hold_;
      if (held > 0) ++some_hold_;
      if (held > longest_) longest_ = held, by_ = text_at(limits, i, "method");
      return;
    }
    // both limits lie left of the map, or right of it
    if ((held == 0 && failed >= *predicted) || (std::isinf(failed) && held <= *predicted)) return;
    ++compared_;
    // a row that is stable, or fails, at every step has no measured limit
    const double off =
        held > 0 && std::isfinite(failed) ? std::abs(std::sqrt(held * failed) / *predicted - 1) : INFINITY;
    if (off > near)
      ++apart_;
    else
      worst_near_ = std::max(worst_near_, off);
    if (off <= worst_) return;
    worst_ = off;
    which_ = fmt::format("{} at a {} of {}, which {}, by theory up to {}", text_at(limits, i, "method"),
                         kind_ == "drag" ? "drag rate" : "stiffness factor", nice(*number_at(limits, i, "value")),
                         held == 0 ? "fails at every step" : "holds up to " + step_text(held), step_text(*predicted));
  }

  std::string sentence() const {
    std::vector<std::string> all;
    if (compared_ > 0 && apart_ == 0)
      all.push_back(fmt::format(
          "Runs begin to fail where the dashed line of theory crosses a row: {} limits lie within {} of it.", compared_,
          percent(worst_near_, 1)));
    else if (compared_ > 0)
      all.push_back(
          fmt::format("On {} of {} rows runs begin to fail within {} of the dashed line of theory; furthest off is {}.",
                      compared_ - apart_, compared_, percent(near, 1), which_));
    if (none_hold_ > 0)
      all.push_back(fmt::format("Where theory has no stable step, none holds on {} rows.", none_hold_));
    if (some_hold_ > 0)
      all.push_back(fmt::format("On {} rows short steps hold that by theory grow, if slowly: up to {} by {}.",
                                some_hold_, step_text(longest_), by_));
    if (all.empty()) return "Theory has no limit for these methods here.";
    return fmt::format("{}", fmt::join(all, " "));
  }

 private:
  // the search leaves 2 % between what held and what failed, and growth must be seen within a short run
  static constexpr double near = 0.05;
  std::string kind_, which_, by_;
  int compared_ = 0, apart_ = 0, none_hold_ = 0, some_hold_ = 0;
  double worst_ = -1, worst_near_ = 0, longest_ = 0;
};

/// Steps of the runs that came to the end: "1000", "300 to 1000".
std::string steps_of(const std::set<long>& steps) {
  if (steps.empty()) return "";
  return range(std::to_string(*steps.begin()), std::to_string(*steps.rbegin())) + " steps ";
}

HeatMap map_of(const Table& cells, const Table& limits, const std::string& scene, const std::string& kind,
               const std::string& commit) {
  HeatMap map;
  map.name = fmt::format("{}-{}-map", scene, kind);
  map.title = kind == "drag" ? fmt::format("{}: stability over time step and drag", scene)
                             : fmt::format("{}: stability over time step and stiffness", scene);
  map.x_label = "time step / s";
  map.y_label = kind == "drag" ? "drag rate / (1/s)" : "stiffness / nominal stiffness";
  for (const CellClass& cell_class : cell_classes) map.kinds.push_back({cell_class.title, cell_class.colour});
  const auto panel = [&](const std::string& method) -> HeatMap::Panel& {
    for (HeatMap::Panel& p : map.panels)
      if (p.title == method) return p;
    return map.panels.emplace_back(HeatMap::Panel{method, {}, {}, {}});
  };
  map.runs = fmt::format("{}-{}-map", scene, kind);
  std::set<long> steps;
  for (size_t i = 0; i < cells.rows.size(); ++i) {
    if (text_at(cells, i, "scene") != scene || text_at(cells, i, "map") != kind) continue;
    const std::string& verdict = text_at(cells, i, "verdict");
    const double step = *number_at(cells, i, "step");
    const double value = *number_at(cells, i, "value");
    const std::string& method = text_at(cells, i, "method");
    const std::string outcome =
        verdict == "ok"            ? "stable"
        : verdict == "unsupported" ? "unsupported"
                                   : fmt::format("{} at {:.3g} s", failure_class(verdict), *number_at(cells, i, "end"));
    HeatMap::Panel& own = panel(method);
    own.cells.push_back({step,
                         value,
                         kind_of(verdict),
                         {fmt::format("{}, step {}, {}\n{}", method, step_text(step),
                                      kind == "drag" ? fmt::format("drag {} 1/s", nice(value))
                                                     : fmt::format("stiffness × {}", nice(value)),
                                      outcome),
                          fmt::format("{} {}", method, own.cells.size())}});
    if (verdict == "ok") steps.insert(std::lround(*number_at(cells, i, "end") / step));
  }
  RowsAgainstTheory rows(kind);
  for (size_t i = 0; i < limits.rows.size(); ++i) {
    if (text_at(limits, i, "scene") != scene || text_at(limits, i, "map") != kind) continue;
    HeatMap::Panel& p = panel(text_at(limits, i, "method"));
    const double value = *number_at(limits, i, "value");
    const auto predicted = number_at(limits, i, "predicted limit"), held = number_at(limits, i, "held"),
               failed = number_at(limits, i, "failed");
    if (predicted && *predicted > 0) p.predicted.emplace_back(*predicted, value);
    if (held && failed) p.measured.emplace_back(std::sqrt(*held * *failed), value);
    rows.add(limits, i);
  }
  map.finding = rows.sentence();
  std::vector<std::string> whole;
  for (const HeatMap::Panel& p : map.panels)
    if (std::all_of(p.cells.begin(), p.cells.end(), [](const auto& cell) { return cell.kind == 0; }))
      whole.push_back(p.title);
  if (!whole.empty()) map.finding += fmt::format(" No run of {} fails.", joined(whole));
  map.caption = fmt::format(
      "Scene {}; each cell a run of {}after a small kick; growth below a millionth counts as none; commit {}.", scene,
      steps_of(steps), commit);
  map.tier = "exact for small motion under the discrete rule (dashed); measured limits (dots) are known to 2 %";
  return map;
}

}  // namespace

std::vector<Chart> map_charts(const Table& cells, const Table& limits, const std::string& commit) {
  std::vector<std::pair<std::string, std::string>> maps;  // scene, kind
  for (size_t i = 0; i < cells.rows.size(); ++i) {
    const std::pair each{text_at(cells, i, "scene"), text_at(cells, i, "map")};
    if (std::find(maps.begin(), maps.end(), each) == maps.end()) maps.push_back(each);
  }
  std::vector<Chart> charts;
  for (const auto& [scene, kind] : maps)
    charts.push_back(
        {"", map_of(cells, limits, scene, kind, commit), "stability",
         kind == "drag"
             ? "By theory drag decides which steps of explicit Euler hold at all, and shortens the step of "
               "symplectic Euler, by much once its rate passes that of the springs."
             : "By theory, while drag is weak, four times the stiffness halves the step of symplectic Euler, "
               "leapfrog and rk4, and quarters that of explicit Euler where drag gives it one: without drag it has "
               "none."});
  return charts;
}

}  // namespace crosscheck
