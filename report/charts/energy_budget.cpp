// Where the energy of a run came from and where it went.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/cells.h"
#include "report/charts/energy_parts.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

std::vector<Bars::Part> parts_for(size_t bars) {
  std::vector<Bars::Part> parts = {{"drag", "#0072B2", false, {}},
                                   {"dashpots", "#56B4E9", false, {}},
                                   {"contact", "#D55E00", false, {}},
                                   {"contact (inferred)", "#D55E00", true, {}},
                                   {"left: motion and springs", "#009E73", false, {}},
                                   {"does not add up", "#CC79A7", false, {}},
                                   {"gravity", "#999999", false, {}},
                                   {"at the start", "#333333", false, {}},
                                   {"wind", "#E69F00", false, {}},
                                   {"moved pins", "#7A3B00", false, {}}};
  for (Bars::Part& part : parts) part.height.assign(bars, 0);
  return parts;
}

}  // namespace

std::optional<Chart> budget_chart(const Table& table, const std::string& scene, const std::string& commit) {
  std::vector<size_t> shown;
  std::string failed;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene || !number_at(table, i, "kinetic")) continue;
    if (flag_at(table, i, "undamped")) return std::nullopt;
    if (text_at(table, i, "verdict") == "ok")
      shown.push_back(i);
    else
      failed += fmt::format(" {} is not shown: {} at {:.3g} s.", text_at(table, i, "method"),
                            failure_word(text_at(table, i, "verdict")), number_at(table, i, "end", 0));
  }
  if (shown.empty()) return std::nullopt;
  Bars bars;
  bars.name = scene + "-energy-budget";
  bars.title = scene + ": where energy came from and went";
  bars.label = "energy / J (left of zero: came in)";
  bars.parts = parts_for(shown.size());
  bool inferred = false;
  for (size_t b = 0; b < shown.size(); ++b) {
    const size_t i = shown[b];
    bars.names.push_back(text_at(table, i, "method"));
    const bool guessed = flag_at(table, i, "contact inferred");
    inferred |= guessed;
    const double contact = number_at(table, i, "contact took", 0);
    const double heights[] = {number_at(table, i, "drag took", 0),
                              number_at(table, i, "dashpots took", 0),
                              guessed ? 0 : contact,
                              guessed ? contact : 0,
                              number_at(table, i, "kinetic", 0) + number_at(table, i, "elastic", 0),
                              -number_at(table, i, "residual", 0),
                              -number_at(table, i, "gravity gave", 0),
                              -number_at(table, i, "kinetic at start", 0) - number_at(table, i, "elastic at start", 0),
                              -number_at(table, i, "wind gave", 0),
                              -number_at(table, i, "pins gave", 0)};
    for (size_t p = 0; p < bars.parts.size(); ++p) bars.parts[p].height[b] = heights[p];
  }
  const auto nothing = [](const Bars::Part& part) {
    return std::all_of(part.height.begin(), part.height.end(), [](double height) { return height == 0; });
  };
  if (std::all_of(bars.parts.begin(), bars.parts.end(), nothing)) return std::nullopt;  // at rest
  bars.finding = "What each run was given, left of zero, and where it went, right of it.";
  if (inferred)
    bars.finding +=
        " Hatched: an engine that does not tell its impulses; what is missing is called contact, and no closure is "
        "claimed.";
  bars.tier = "exact (the sum is zero), to the rounding of the sums";
  bars.caption = fmt::format("Scene {}; {}, rules that solve a whole step at ten times that; commit {}.", scene,
                             length_text(table, scene), commit);
  const std::string about =
      scene == "all-at-once"
          ? "One small scene with everything that takes or gives energy: a cloth of 5 x 5 particles, held by two moved "
            "corners, swings in gusts against a ball, with drag, springs that damp, and friction."
          : "";
  return Chart{"", std::move(bars), "energy", about + failed};
}

}  // namespace crosscheck
