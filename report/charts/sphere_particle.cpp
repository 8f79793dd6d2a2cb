// A particle and a ball: the height of its rebound, and where it leaves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/charts/sphere_parts.h"
#include "report/findings_text.h"
#include "report/leaving_told.h"

namespace crosscheck {
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
    double of_curve = 0.5;  // Bullet returns nothing: its own rebound where none is asked
    if (method.starts_with("bullet/")) of_curve = 0;
    for (const double e : parts) {
      std::string said = "";
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != method || number_at(table, i, "restitution") != e) continue;
        const double h = *number_at(table, i, "step");
        const auto height = number_at(table, i, "rebound");
        if (std::abs(h - 1. / 240) < 1e-9)
          said = height ? fmt::format("{:.4g}", 1e3 * *height) : failure_or_cannot(text_at(table, i, "verdict"));
        if (e == of_curve && height)
          if (const double off = std::abs(*height - 0.3 * e * e) * 1e3; off > 1e-2) curve.points.emplace_back(h, off);
      }
      row.push_back(said);
    }
    page.rows.push_back(std::move(row));
    if (method.starts_with("bullet/")) curve.title += " (e = 0)";
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
      page.rows.push_back({method, step_text(h),
                           angle                                  ? fmt::format("{:.2f}", *angle)
                           : text_at(table, i, "verdict") == "ok" ? "does not leave"
                                                                  : failure_or_cannot(text_at(table, i, "verdict")),
                           angle ? off_text(*angle - exact) : "",
                           angle ? fmt::format("{:.3f}", *number_at(table, i, "speed")) : ""});
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
