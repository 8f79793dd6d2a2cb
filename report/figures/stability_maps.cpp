#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reference/engines/engines.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Colours differ pairwise by at least 8 in lightness (CIE L*).
struct CellClass {
  Verdict verdict;
  const char *title, *colour;
};
constexpr CellClass cell_classes[] = {
    {Verdict::ok, "stable", "#CBDAE1"},
    {Verdict::energy, "blows up", "#B44E00"},
    {Verdict::nan, "not a number", "#5D2252"},
    {Verdict::stretch, "overstretched", "#E8B34C"},
    {Verdict::solver, "solver gives up", "#525252"},
    {Verdict::frozen, "frozen", "#50A9DB"},
    {Verdict::timeout, "time limit", "#00996F"},
    {Verdict::crash, "program fails", "#222222"},
    {Verdict::unsupported, "unsupported", "#F7F5EE"},
};
int kind_of(Verdict verdict) {
  const auto* found = std::ranges::find(cell_classes, verdict, &CellClass::verdict);
  return found == std::end(cell_classes) ? 1 : static_cast<int>(found - cell_classes);
}

class RowsAgainstTheory {
 public:
  void add(const MapLimitRow& row) {
    if (!row.predicted) return;
    const double predicted = *row.predicted, held = row.held.value_or(0), failed = row.failed.value_or(INFINITY);
    if (predicted == 0) {
      ++(held == 0 ? none_hold_ : some_hold_);
      if (held > longest_) longest_ = held, by_ = row.method;
      return;
    }
    // nothing to compare if both limits lie beyond the same end of the map
    if ((held == 0 && failed >= predicted) || (std::isinf(failed) && held <= predicted)) return;
    ++compared_;
    // a row that is stable at every step, or fails at every step, has no measured limit
    const double off =
        held > 0 && std::isfinite(failed) ? std::abs(std::sqrt(held * failed) / predicted - 1) : INFINITY;
    if (off > near)
      ++apart_;
    else
      worst_near_ = std::max(worst_near_, off);
    if (off <= worst_) return;
    worst_ = off;
    which_ = fmt::format("{} at a {} of {}, which {}, by theory up to {}", without_folders(row.method),
                         row.map == "drag" ? "drag rate" : "stiffness factor", nice(row.value),
                         held == 0 ? "fails at every step" : "holds up to " + step_text(held), step_text(predicted));
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
      all.push_back(fmt::format("Where theory has no stable step, no step holds on {} rows.", none_hold_));
    if (some_hold_ > 0)
      all.push_back(fmt::format("On {} rows short steps hold although theory predicts slow growth: up to {} by {}.",
                                some_hold_, step_text(longest_), by_));
    if (all.empty()) return "Theory has no limit for these methods here.";
    return fmt::format("{}", fmt::join(all, " "));
  }

 private:
  // relative tolerance: the search leaves a bracket of 2 %, and slow growth is invisible in a short run
  static constexpr double near = 0.05;
  std::string which_, by_;
  int compared_ = 0, apart_ = 0, none_hold_ = 0, some_hold_ = 0;
  double worst_ = -1, worst_near_ = 0, longest_ = 0;
};

/// "1000", or "300 to 1000"
std::string steps_of(const std::set<long>& steps) {
  if (steps.empty()) return "";
  return range(std::to_string(*steps.begin()), std::to_string(*steps.rbegin())) + " steps ";
}

Chart map_chart(const std::vector<MapRow>& cells, const std::vector<MapLimitRow>& limits, const MapRow& first,
                const std::string& commit) {
  const bool drag = first.map == "drag";
  const auto here = [&](const auto& row) { return row.scene == first.scene && row.map == first.map; };
  HeatMap map;
  map.runs = fmt::format("{}-{}-map", first.scene, first.map);
  for (const CellClass& cell_class : cell_classes) map.kinds.push_back({cell_class.title, cell_class.colour});
  const auto panel = [&](const std::string& method) -> HeatMap::Panel& {
    const auto found = std::ranges::find(map.panels, method, &HeatMap::Panel::title);
    return found != map.panels.end() ? *found : map.panels.emplace_back(HeatMap::Panel{method, {}, {}, {}});
  };
  std::set<long> steps;
  for (const MapRow& row : cells | std::views::filter(here)) {
    HeatMap::Panel& own = panel(row.method);
    const std::string outcome = row.verdict == Verdict::ok ? "stable"
                                : row.verdict == Verdict::unsupported
                                    ? "unsupported"
                                    : fmt::format("{} at {:.3g} s", failure_class(row.verdict), *row.end);
    own.cells.push_back(
        {row.step,
         row.value,
         kind_of(row.verdict),
         {fmt::format("{}, step {}, {}\n{}", without_folders(row.method), step_text(row.step),
                      drag ? fmt::format("drag {} 1/s", nice(row.value)) : "stiffness × " + nice(row.value), outcome),
          fmt::format("{} {}", row.method, own.cells.size())}});
    if (row.verdict == Verdict::ok) steps.insert(std::lround(*row.end / row.step));
  }
  RowsAgainstTheory rows;
  for (const MapLimitRow& row : limits | std::views::filter(here)) {
    HeatMap::Panel& own = panel(row.method);
    if (row.predicted && *row.predicted > 0) own.predicted.emplace_back(*row.predicted, row.value);
    if (row.held && row.failed) own.measured.emplace_back(std::sqrt(*row.held * *row.failed), row.value);
    rows.add(row);
  }
  map.finding = rows.sentence();
  std::vector<std::string> whole;
  for (const HeatMap::Panel& p : map.panels)
    if (std::ranges::all_of(p.cells, [](const auto& cell) { return cell.kind == 0; }))
      whole.push_back(without_folders(p.title));
  if (!whole.empty()) map.finding += fmt::format(" No run of {} fails.", joined(whole));
  return described(drag ? "{scene}-drag-map" : "{scene}-stiffness-map", std::move(map), "scene"_a = first.scene,
                   "steps"_a = steps_of(steps), "commit"_a = commit);
}

}  // namespace

std::vector<Chart> map_charts(const std::vector<MapRow>& cells, const std::vector<MapLimitRow>& limits,
                              const std::string& commit) {
  std::vector<Chart> charts;
  std::set<std::pair<std::string, std::string>> seen;  // scene and kind
  for (const MapRow& row : cells)
    if (seen.emplace(row.scene, row.map).second) charts.push_back(map_chart(cells, limits, row, commit));
  return charts;
}

}  // namespace crosscheck
