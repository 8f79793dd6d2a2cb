// Coulomb's law on a slope: who sticks, who slides, who creeps.
#include <fmt/format.h>

#include <cmath>

#include "experiments/cells.h"
#include "report/charts/sphere_parts.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

constexpr double degree = 0.017453292519943295;

/// Those that stand for the others, and those that answer differently.
bool shown_always(const std::string& method) {
  return method == ours || method == theirs || method == position_based || method == sticky_sphere;
}

}  // namespace

Chart cone_law(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-cone";
  f.title = "Coulomb's law on a slope: how far it slides";
  f.x = {"friction / tan(slope)", false, 0.0, 2.5};
  f.y = {"way / way without friction", false, -0.05, 1.05};
  const double step = usual_step(table);
  Curve exact{"Coulomb, exact", {"#555555", "1", -1}, {{0, 1}, {1, 0}, {2.5, 0}}};
  f.curves.push_back(std::move(exact));
  PageTable page{fmt::format("Stick or slide, at a step of {}", step_text(step)),
                 {"method", "sticks or slides as it should", "of", "wrong answers"},
                 {}};
  std::vector<std::string> differing;
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, false, true};
    int right = 0, all = 0, creeping = 0, stuck = 0;
    std::string failed;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method || number_at(table, i, "step") != step) continue;
      if (text_at(table, i, "verdict") != "ok") {
        failed = text_at(table, i, "verdict") == "unsupported" ? text_at(table, i, "reason")
                                                               : failure_word(text_at(table, i, "verdict"));
        ++all;
        continue;
      }
      const double angle = *number_at(table, i, "angle") * degree, mu = *number_at(table, i, "friction");
      curve.points.emplace_back(mu / std::tan(angle), *number_at(table, i, "way") / (9.81 * std::sin(angle) / 8));
      const std::string& answer = text_at(table, i, "answer");
      ++all;
      right += answer == text_at(table, i, "answer by theory");
      creeping += answer == "neither";
      stuck += answer == "sticks" && text_at(table, i, "answer by theory") == "slides";
    }
    std::erase_if(curve.points, [](const auto& p) { return p.first > 2.5; });
    std::string wrong;
    if (creeping) wrong += fmt::format("creeps in {}", creeping);
    if (stuck) wrong += fmt::format("{}sticks where it should slide in {}", wrong.empty() ? "" : ", ", stuck);
    if (!failed.empty()) wrong += (wrong.empty() ? "" : "; ") + failed;
    page.rows.push_back({method, std::to_string(right), std::to_string(all), wrong});
    if (right < all && !curve.points.empty())
      differing.push_back(fmt::format("{} ({} of {})", method, all - right, all));
    if ((right < all || shown_always(method)) && !curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "On slopes of 10 to 50 degrees with frictions of 0 to 1.2 all answers must fall on one line. " +
      (differing.empty() ? "Those of all methods do."
                         : fmt::format("Those that answer otherwise, and in how many cases: {}.", joined(differing)));
  f.caption = fmt::format(
      "A particle on a slope for 0.5 s, step {}; methods that "
      "answer like mysim/symplectic-euler are in the table only; commit {}.",
      step_text(step), commit);
  f.tier = "exact (Coulomb's law)";
  Chart chart{"", std::move(f), "sphere",
              "A particle at rest on a slope must stay where friction exceeds the slope's tangent, and otherwise slide "
              "by g (sin θ - μ cos θ) t² / 2."};
  chart.tables.push_back(std::move(page));
  return chart;
}

std::optional<Chart> cone_map(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-cone-map";
  f.title = "Who sticks, who slides, who creeps";
  f.x = {"slope / degrees", false, 5.0, 55.0};
  f.y = {"friction", false, -0.05, 1.25};
  Curve limit{"tan(slope), exact", {"#555555", "1", -1}, {}};
  // level beside the methods of a slope, which stand beside each other
  for (const double slope : {10., 20., 30., 40., 50.})
    for (const double side : {-4., 4.}) limit.points.emplace_back(slope + side, std::tan(slope * degree));
  f.curves.push_back(std::move(limit));
  const double step = usual_step(table);
  const char* shown[] = {ours, theirs, position_based, sticky_sphere};
  const std::pair<const char*, int> answers[] = {{"sticks", 7}, {"slides", 6}, {"neither", 9}};
  for (size_t m = 0; m < std::size(shown); ++m)
    for (const auto& [answer, marker] : answers) {
      const std::string word = std::string(answer) == "neither" ? "creeps" : answer;
      Curve curve{fmt::format("{} {}", shown[m], word), {style_of(shown[m]).colour, "1", marker}, {}, false, true};
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != shown[m] || number_at(table, i, "step") != step ||
            text_at(table, i, "verdict") != "ok" || text_at(table, i, "answer") != answer)
          continue;
        curve.points.emplace_back(*number_at(table, i, "angle") + 1.7 * (static_cast<double>(m) - 1.5),
                                  *number_at(table, i, "friction"));
      }
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
  if (f.curves.size() == 1) return std::nullopt;  // none of these was asked
  f.finding =
      "Above the line it must stick (filled), below it slide (open); a triangle does neither: it moves at a "
      "steady creep.";
  f.caption = fmt::format("The same runs as above, methods side by side at each slope; step {}; commit {}.",
                          step_text(step), commit);
  f.tier = "exact (Coulomb's law)";
  return Chart{"", std::move(f), "sphere"};
}

}  // namespace crosscheck
