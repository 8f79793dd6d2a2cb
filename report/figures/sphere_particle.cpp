// A particle and a ball: Coulomb's law on slopes, the height of its rebound, where it leaves.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/table.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

constexpr double degree = 0.017453292519943295;

/// Methods that stand for the others, and methods with different results.
bool shown_always(const std::string& method) {
  return method == ours || method == theirs || method == position_based() || method == sticky_sphere;
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
                                                               : failure_class(text_at(table, i, "verdict"));
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
  // flat across the methods of a slope, which stand side by side
  for (const double slope : {10., 20., 30., 40., 50.})
    for (const double side : {-4., 4.}) limit.points.emplace_back(slope + side, std::tan(slope * degree));
  f.curves.push_back(std::move(limit));
  const double step = usual_step(table);
  const std::string shown[] = {ours, theirs, position_based(), sticky_sphere};
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
  if (f.curves.size() == 1) return std::nullopt;  // none of these was run
  f.finding =
      "Above the line it must stick (filled), below it slide (open); a triangle does neither: it moves at a "
      "steady creep.";
  f.caption = fmt::format("The same runs as above, methods side by side at each slope; step {}; commit {}.",
                          step_text(step), commit);
  f.tier = "exact (Coulomb's law)";
  return Chart{"", std::move(f), "sphere"};
}

namespace {

/// Degrees off; what rounds to nothing has no sign.
std::string off_text(double degrees) {
  const std::string text = fmt::format("{:+.2f}", degrees);
  return text.substr(1) == "0.00" ? "0.00" : text;
}

}  // namespace

Chart rebound_chart(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-rebound";
  f.title = "Rebound of a particle: error of its height";
  f.x = {"step / s", true, std::nullopt, std::nullopt};
  f.y = {"|rebound - e² 0.3 m| / mm", true, 1e-2, 1e3};
  PageTable page{"Rebound height in mm at a step of 1/240 s", {"method"}, {}};
  std::vector<double> parts;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const double e = *number_at(table, i, "restitution"); std::find(parts.begin(), parts.end(), e) == parts.end())
      parts.push_back(e);
  for (const double e : parts) page.header.push_back(fmt::format("e = {:g} (exact {:.4g})", e, 300 * e * e));
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, true, true};
    std::vector<std::string> row{method};
    double of_curve = 0.5;  // Bullet returns nothing: its own rebound where the scene has none
    if (family_of(method).is_default_peer()) of_curve = 0;
    for (const double e : parts) {
      std::string said = "";
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != method || number_at(table, i, "restitution") != e) continue;
        const double h = *number_at(table, i, "step");
        const auto height = number_at(table, i, "rebound");
        if (std::abs(h - 1. / 240) < 1e-9)
          said = height ? fmt::format("{:.4g}", 1e3 * *height) : failure_class_or_cannot(text_at(table, i, "verdict"));
        if (e == of_curve && height)
          if (const double off = std::abs(*height - 0.3 * e * e) * 1e3; off > 1e-2) curve.points.emplace_back(h, off);
      }
      row.push_back(said);
    }
    page.rows.push_back(std::move(row));
    if (family_of(method).is_default_peer()) curve.title += " (e = 0)";
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "A rebound that lasts to the next step is late by up to one, so that the error falls with the step; what is "
      "within "
      "0.01 mm is not drawn. Bullet's soft bodies have no restitution against an obstacle: drawn is how high they come "
      "back where none is asked.";
  f.caption = fmt::format("Dropped by 0.3 m on a ball, e = 0.5 where nothing is said; commit {}.", commit);
  f.tier = "exact (parabolas)";
  Chart chart{"", std::monostate{}, "sphere",
              "A ball that returns the part e of the speed throws back to e² of the height.", f.title};
  if (!f.curves.empty()) chart.figure = std::move(f);  // none where all are within 0.01 mm, or fail
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart leaving_chart(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-leaving";
  f.title = "Where a particle without friction leaves the ball";
  f.x = {"step / s", true, std::nullopt, std::nullopt};
  f.y = {"angle less the exact one / degrees", false, std::nullopt, std::nullopt};
  PageTable page{"Angle and speed where the gap passes 1 mm",
                 {"method", "step", "angle / degrees", "less the exact one / degrees", "speed / (m/s)"},
                 {}};
  double exact = 0, speed = 0;
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, true, true};
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method) continue;
      exact = *number_at(table, i, "angle by theory"), speed = *number_at(table, i, "speed by theory");
      const auto angle = number_at(table, i, "angle");
      const double h = *number_at(table, i, "step");
      page.rows.push_back(
          {method, step_text(h),
           angle                                  ? fmt::format("{:.2f}", *angle)
           : text_at(table, i, "verdict") == "ok" ? "does not leave"
                                                  : failure_class_or_cannot(text_at(table, i, "verdict")),
           angle ? off_text(*angle - exact) : "", angle ? fmt::format("{:.3f}", *number_at(table, i, "speed")) : ""});
      if (angle) curve.points.emplace_back(h, *angle - exact);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  page.rows.insert(page.rows.begin(), {"exact", "", fmt::format("{:.2f}", exact), "0", fmt::format("{:.3f}", speed)});
  f.floor = {"exact", 0};
  f.finding = fmt::format(
      "Contact ends at 48.2 degrees, where cos = 2/3; the gap must pass 1 mm at {:.2f} degrees and {:.3f} m/s. {} A "
      "particle that never comes off, as on the sticky sphere, has no point here.",
      exact, speed, leaving_sentence(table));
  f.caption = fmt::format(
      "A ball of 1.02 m, no friction, started 1 degree off its top; the gap of 1 mm is compared, as some engines let "
      "the particle hop before it leaves; commit {}.",
      commit);
  f.tier = "exact (energy on the ball, then free flight)";
  Chart chart{"", std::monostate{}, "sphere", "", f.title};
  if (!f.curves.empty()) chart.figure = std::move(f);  // none where no particle leaves
  chart.tables.push_back(std::move(page));
  return chart;
}

}  // namespace crosscheck
