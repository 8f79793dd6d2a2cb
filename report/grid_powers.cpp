// Powers of the number of cells, in words.
#include "report/grid_powers.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/cells.h"

namespace crosscheck {
namespace {

/// Against the number of bend springs in a line instead of its cells.
std::optional<PowerLaw> power_of_bend_springs(const Rows& rows) {
  const Table* t = rows.table("adequacy-bending");
  std::vector<std::pair<double, double>> points;
  for (size_t i = 0; t && i < t->rows.size(); ++i)
    points.emplace_back(*number_at(*t, i, "particles along a line") - 2,
                        *number_at(*t, i, "stiffness of bend springs"));
  return power_law(points);
}

}  // namespace

std::optional<PowerLaw> power_of(const Rows& rows, const std::string& scene, const std::string& quantity) {
  const Table* t = rows.table("adequacy-scaling");
  for (size_t i = 0; t && i < t->rows.size(); ++i)
    if (text_or_none(*t, i, "scene") == scene && text_at(*t, i, "quantity") == quantity)
      return PowerLaw{*number_at(*t, i, "exponent"), *number_at(*t, i, "standard error")};
  return std::nullopt;
}

std::string power_text(const PowerLaw& power) {
  return fmt::format("{:.2f} ± {:.2f}", power.exponent, power.deviation);
}

std::string bend_sentence(const Rows& rows) {
  constexpr double derived = 4, close = 0.05;
  const auto of_cells = power_of(rows, "", stiffness_for_droop), of_springs = power_of_bend_springs(rows);
  if (!of_cells) return "";
  std::string text = fmt::format(
      "For the same droop of a clamped sheet bend springs must stiffen as the number of cells to the power {} (derived "
      "for many cells: {:g}).",
      power_text(*of_cells), derived);
  const double off = std::abs(of_cells->exponent - derived);
  if (off <= std::max(close, 2 * of_cells->deviation)) return text;
  const double left = of_springs ? std::abs(of_springs->exponent - derived) : INFINITY;
  if (!(left < off)) return text + " The difference is not explained.";
  return text + fmt::format(
                    " Counted in bend springs along a line instead of cells (half a spring fewer, as none reaches over "
                    "the free end) the power is {}: {} of the difference comes from that end.",
                    power_text(*of_springs), left <= close ? "nearly all" : "only a part");
}

}  // namespace crosscheck
