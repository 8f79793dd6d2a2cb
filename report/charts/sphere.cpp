// Experiment `sphere`: friction, rebound, leaving, depth, and cloths that fall on a ball.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cells.h"
#include "report/charts/sphere_parts.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

struct Course {
  const char *column, *name, *title, *label;
  double factor;
  bool logarithmic;
  const char* tier;
};

/// A quantity over time, at the usual step.
std::optional<Chart> course(const Table& table, const std::string& scene, const Course& what,
                            const std::string& finding, const std::string& commit) {
  Figure f;
  f.name = fmt::format("{}-{}", scene, what.name);
  f.title = fmt::format("{}: {}", scene, what.title);
  f.x = {"t / s", false, 0.0, std::nullopt};
  f.y = {what.label, what.logarithmic, std::nullopt, std::nullopt};
  const double step = usual_step(table);
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}};
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method || std::abs(*number_at(table, i, "step") / step - 1) > 1e-6) continue;
      const auto value = number_at(table, i, what.column);
      if (value && (!what.logarithmic || *value > 0))
        curve.points.emplace_back(*number_at(table, i, "t"), *value * what.factor);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  if (f.curves.empty()) return std::nullopt;
  f.finding = finding;
  f.caption = fmt::format("Scene {}, step {}; commit {}.", scene, step_text(step), commit);
  f.tier = what.tier;
  return Chart{"", std::move(f), "sphere"};
}

/// The last time of any run, s.
double end_of(const Table& table) {
  double end = 0;
  for (size_t i = 0; i < table.rows.size(); ++i) end = std::max(end, *number_at(table, i, "t"));
  return end;
}

/// Who slides on at the end, at the usual step.
std::string still_sliding(const Table& table, double end) {
  const double step = usual_step(table);
  std::vector<std::string> sliding;
  for (const std::string& method : distinct(table, "method")) {
    std::optional<double> last;
    double until = 0;
    for (size_t i = 0; i < table.rows.size(); ++i)
      if (text_at(table, i, "method") == method && std::abs(*number_at(table, i, "step") / step - 1) < 1e-6)
        last = number_at(table, i, "creep"), until = *number_at(table, i, "t");
    if (until < end * (1 - 1e-9)) continue;  // it failed before
    if (last && *last > 1e-3) sliding.push_back(fmt::format("{} ({} mm/s)", method, nice(1e3 * *last)));
  }
  return sliding.empty() ? "At the end nothing that touches slides by more than 1 mm/s."
                         : fmt::format("Still above 1 mm/s at the end: {}.", joined(sliding));
}

/// Who is a micrometre and more from its mirror image, from when on, at the usual step.
std::string broken_symmetry(const Table& table) {
  const double step = usual_step(table);
  std::vector<std::string> broken;
  double others = 0;
  for (const std::string& method : distinct(table, "method")) {
    std::optional<double> since;
    double most = 0;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method || std::abs(*number_at(table, i, "step") / step - 1) > 1e-6) continue;
      const double skew = number_at(table, i, "asymmetry", 0);
      most = std::max(most, skew);
      if (skew > 1e-6 && !since) since = number_at(table, i, "t");
    }
    if (since) broken.push_back(fmt::format("{} (after {:.2g} s)", method, *since));
    if (!since) others = std::max(others, most);
  }
  return (broken.empty() ? "" : fmt::format("More than a micrometre off are {}. ", joined(broken))) +
         fmt::format("{} at most {} off.", broken.empty() ? "All are" : "The others are", nice_length(others));
}

}  // namespace

double usual_step(const Table& table) {
  double best = 0;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const auto h = number_at(table, i, "step"); h && (best == 0 || std::abs(*h - 1e-3) < std::abs(best - 1e-3)))
      best = *h;
  return best;
}

std::vector<Chart> sphere_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Rows& rows = input.result;
  const auto add = [&](std::optional<Chart> chart) {
    if (chart) charts.push_back(std::move(*chart));
  };
  if (const Table* table = rows.table("sphere-cone")) {
    add(cone_law(*table, input.commit));
    add(cone_map(*table, input.commit));
  }
  if (const Table* table = rows.table("sphere-rebound")) add(rebound_chart(*table, input.commit));
  if (const Table* table = rows.table("sphere-leaving")) add(leaving_chart(*table, input.commit));
  const Table *drapes = rows.table("sphere-drape"), *deep = rows.table("sphere-penetration");
  if (!drapes || !deep) return charts;
  for (const std::string& scene : distinct(*drapes, "scene")) {
    const Table* over_time = rows.table(scene + "-drape");
    if (scene == "drop-aside") {
      Chart picture = drape_snapshot(*drapes);
      picture.tables.push_back(drape_table(*drapes, scene));
      add(std::move(picture));
    }
    bool cloth = false, symmetric = false;
    for (size_t i = 0; i < over_time->rows.size(); ++i) {
      cloth |= number_at(*over_time, i, "triangles inside").has_value();
      symmetric |= number_at(*over_time, i, "asymmetry").has_value();
    }
    if (!cloth) continue;  // single particles have their scenes' own parts of the page
    add(course(*over_time, scene,
               {"creep", "sliding", "sliding speed of what touches", "speed / (mm/s)", 1e3, true,
                "another engine: contact rules differ, so that these are differences and no errors"},
               "How fast the touching particles slide. " + still_sliding(*over_time, end_of(*over_time)),
               input.commit));
    if (symmetric) {
      add(course(*over_time, scene,
                 {"asymmetry", "asymmetry", "how far it is from its own mirror image", "asymmetry / m", 1, true,
                  "exact (zero)"},
                 "The scene is symmetric in two planes: a rule that looks at all particles alike parts from it by "
                 "rounding only, which grows. " +
                     broken_symmetry(*over_time),
                 input.commit));
    }
    if (scene != "drop-aside") {
      Chart ends{"", std::monostate{}, "sphere", "", scene + ": how it ends"};
      ends.tables.push_back(drape_table(*drapes, scene));
      add(std::move(ends));
    }
    add(depth_chart(*deep, scene, input.commit));
  }
  return charts;
}

}  // namespace crosscheck
