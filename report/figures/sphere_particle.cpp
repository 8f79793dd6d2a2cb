// A particle and a ball: Coulomb's law on slopes, the height of its rebound, where it leaves.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/tables/sphere.h"
#include "experiments/tables/table.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

constexpr double degree = 0.017453292519943295;

/// Representative methods, and methods with different results.
bool shown_always(const std::string& method) {
  const std::vector<std::string> shown = representatives_in_contact();
  return std::ranges::find(shown, method) != shown.end();
}

}  // namespace

Chart cone_law(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-cone";
  f.title = "Coulomb friction on a slope: distance slid";
  f.x = {"friction coefficient / tan(slope)", false, 0.0, 2.5};
  f.y = {"distance slid / frictionless distance", false, -0.05, 1.05};
  const double step = usual_step(table);
  Curve exact{"Coulomb, exact", {"#555555", "1", -1}, {{0, 1}, {1, 0}, {2.5, 0}}};
  f.curves.push_back(std::move(exact));
  PageTable page{fmt::format("Stick or slide, at a time step of {}", step_text(step)),
                 {"method", "correct cases", "cases", "wrong cases"},
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
      const std::string& outcome = text_at(table, i, "answer");
      ++all;
      right += outcome == text_at(table, i, "answer by theory");
      creeping += outcome == "neither";
      stuck += outcome == "sticks" && text_at(table, i, "answer by theory") == "slides";
    }
    std::erase_if(curve.points, [](const auto& p) { return p.first > 2.5; });
    std::string wrong;
    if (creeping) wrong += fmt::format("creeps in {}", creeping);
    if (stuck) wrong += fmt::format("{}sticks where it should slide in {}", wrong.empty() ? "" : ", ", stuck);
    if (!failed.empty()) wrong += (wrong.empty() ? "" : "; ") + failed;
    page.rows.push_back({method, std::to_string(right), std::to_string(all), wrong});
    if (right < all && !curve.points.empty())
      differing.push_back(fmt::format("{} (right in {} of {})", name_in_sentence(method), right, all));
    if ((right < all || shown_always(method)) && !curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "On slopes of 10 to 50 degrees with frictions of 0 to 1.2 all answers must fall on one line. " +
      (differing.empty() ? "Those of all methods do." : fmt::format("Those that do not: {}.", joined(differing)));
  f.caption = fmt::format(
      "A particle on a slope for 0.5 s, step {}; methods that "
      "answer like symplectic Euler are in the table only; commit {}.",
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
  f.title = "Sticking, sliding and creep by method";
  f.x = {"slope / degrees", false, 5.0, 55.0};
  f.y = {"friction coefficient", false, -0.05, 1.25};
  Curve limit{"tan(slope), exact", {"#555555", "1", -1}, {}};
  // constant over the methods of one slope, which are drawn side by side
  for (const double slope : {10., 20., 30., 40., 50.})
    for (const double side : {-4., 4.}) limit.points.emplace_back(slope + side, std::tan(slope * degree));
  f.curves.push_back(std::move(limit));
  const double step = usual_step(table);
  const std::vector<std::string> shown = representatives_in_contact();
  // a shape for each method: filled, open, and its triangle
  static constexpr int shapes[][3] = {{7, 6, 9}, {5, 4, 8}, {13, 12, 11}, {15, 14, 10}};
  const char* outcomes[] = {"sticks", "slides", "neither"};
  for (size_t m = 0; m < shown.size(); ++m)
    for (size_t o = 0; o < 3; ++o) {
      const char* outcome = outcomes[o];
      const int marker = shapes[m % std::size(shapes)][o];
      const std::string word = std::string(outcome) == "neither" ? "creeps" : outcome;
      Curve curve{fmt::format("{} {}", shown[m], word), {style_of(shown[m]).colour, "1", marker}, {}, false, true};
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != shown[m] || number_at(table, i, "step") != step ||
            text_at(table, i, "verdict") != "ok" || text_at(table, i, "answer") != outcome)
          continue;
        curve.points.emplace_back(*number_at(table, i, "angle") +
                                      1.7 * (static_cast<double>(m) - (static_cast<double>(shown.size()) - 1) / 2),
                                  *number_at(table, i, "friction"));
      }
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
  if (f.curves.size() == 1) return std::nullopt;  // none of these was run
  f.finding =
      "Above the line it must stick (filled), below it slide (open); a triangle creeps steadily, which is neither.";
  f.caption = fmt::format("The same runs, methods side by side in the key's order; step {}; commit {}.",
                          step_text(step), commit);
  f.tier = "exact (Coulomb's law)";
  return Chart{"", std::move(f), "sphere"};
}

Chart rebound_chart(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-rebound";
  f.title = "Rebound of a particle: error of the height";
  f.x = {"time step / s", true, std::nullopt, std::nullopt};
  f.y = {"|rebound height - e² 0.3 m| / mm", true, 1e-2, 1e3};
  PageTable page{"Rebound height in mm at a time step of 1/240 s", {"method"}, {}};
  std::vector<double> parts;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const double e = *number_at(table, i, "restitution"); std::find(parts.begin(), parts.end(), e) == parts.end())
      parts.push_back(e);
  for (const double e : parts) page.header.push_back(fmt::format("e = {:g} (exact {:.4g})", e, 300 * e * e));
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, true, true};
    std::vector<std::string> row{method};
    bool refused = false;  // to return any speed: then its own rebound is drawn, where the scene has none
    for (size_t i = 0; i < table.rows.size(); ++i)
      refused |= text_at(table, i, "method") == method && text_at(table, i, "verdict") == "unsupported";
    const double of_curve = refused ? 0 : 0.5;
    for (const double e : parts) {
      std::string said = "";
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != method || number_at(table, i, "restitution") != e) continue;
        const double h = *number_at(table, i, "step");
        const auto height = number_at(table, i, "rebound");
        if (std::abs(h - 1. / 240) < 1e-9)
          said = height ? fmt::format("{:.4g}", 1e3 * *height) : failure_class(text_at(table, i, "verdict"));
        if (e == of_curve && height)
          if (const double off = std::abs(*height - 0.3 * e * e) * 1e3; off > 1e-2) curve.points.emplace_back(h, off);
      }
      row.push_back(said);
    }
    page.rows.push_back(std::move(row));
    if (refused) curve.title += " (e = 0)";
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "A rebound that lasts to the next step is late by up to one, so that the error falls with the step; below 0.01 "
      "mm "
      "nothing is drawn. Bullet's soft bodies have no restitution: drawn is how high they come back unasked.";
  f.caption = fmt::format("Dropped by 0.3 m on a ball, e = 0.5 where nothing is said; commit {}.", commit);
  f.tier = "exact (parabolas)";
  Chart chart{"", std::monostate{}, "sphere",
              "With a coefficient of restitution e a particle rebounds to e² of the height.", f.title};
  if (!f.curves.empty()) chart.figure = std::move(f);  // none where all are within 0.01 mm, or fail
  chart.tables.push_back(std::move(page));
  return chart;
}

/// Empty where no particle leaves.
std::optional<Chart> leaving_chart(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-leaving";
  f.title = "Separation angle of a frictionless particle on a ball";
  f.x = {"time step / s", true, std::nullopt, std::nullopt};
  f.y = {"error of separation angle / degrees", false, std::nullopt, std::nullopt};
  double exact = 0, speed = 0;
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, true, true};
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method) continue;
      exact = *number_at(table, i, "angle by theory"), speed = *number_at(table, i, "speed by theory");
      const auto angle = number_at(table, i, "angle");
      if (angle) curve.points.emplace_back(*number_at(table, i, "step"), *angle - exact);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  if (f.curves.empty()) return std::nullopt;
  f.floor = {"exact", 0};
  f.finding = fmt::format(
      "Contact ends at 48.2 degrees, where cos = 2/3; the gap must pass 1 mm at {:.2f} degrees and {:.3f} m/s.", exact,
      speed);
  f.caption = fmt::format(
      "A ball of 1.02 m, no friction, started 1 degree off its top; the gap of 1 mm is compared; commit {}.", commit);
  f.tier = "exact (energy on the ball, then free flight)";
  return Chart{"", std::move(f), "sphere"};
}

std::optional<Chart> contact_order_chart(const Table& table, const std::string& commit) {
  constexpr std::string_view probe = "leaves with friction", events = "+events";
  Figure f;
  f.name = "sphere-order";
  f.title = "Error against time step on a ball, with and without events";
  f.x = {"time step / s", true, std::nullopt, std::nullopt};
  f.y = {"largest position error / m", true, std::nullopt, std::nullopt};
  std::map<bool, std::pair<double, double>> slopes;  // of runs with events: least and largest
  std::vector<ContactOrderRow> rows = rows_of<ContactOrderRow>(table);
  std::erase_if(rows, [&](const ContactOrderRow& row) { return row.probe != probe; });
  for (const std::string& method : distinct(table, "method")) {
    const bool located = method.ends_with(events);
    const std::string other = located ? method.substr(0, method.size() - events.size()) : method + std::string(events);
    // a rule of order 1 has no option to be set beside
    if (std::ranges::find(rows, other, &ContactOrderRow::method) == rows.end()) continue;
    Curve curve{method, style_of(method), {}, true, true};
    std::optional<double> slope;  // of the two shortest steps at which the error is known
    for (const ContactOrderRow& row : rows)
      if (row.method == method && row.error && *row.error > 30 * row.truth_bar) {
        curve.points.emplace_back(row.step, *row.error);
        if (row.order) slope = row.order;
      }
    if (!slope) continue;
    curve.title = fmt::format("{}: order {:.2f}", short_name(method), *slope);
    const auto [found, first] = slopes.try_emplace(located, *slope, *slope);
    auto& [least, largest] = found->second;
    least = std::min(least, *slope), largest = std::max(largest, *slope);
    f.curves.push_back(std::move(curve));
  }
  if (slopes.size() < 2) return std::nullopt;
  const auto range = [&](bool located) {
    const std::string least = fmt::format("{:.2f}", slopes[located].first),
                      largest = fmt::format("{:.2f}", slopes[located].second);
    return least == largest ? least : least + " to " + largest;
  };
  f.finding =
      fmt::format("On a ball all rules fall to order {}; with +events the order is {}.", range(false), range(true));
  f.caption = fmt::format("A particle slides off a ball with friction 0.2; commit {}.", commit);
  f.tier = "exact (Coulomb's law)";
  return Chart{"", std::move(f), "sphere"};
}

}  // namespace crosscheck
