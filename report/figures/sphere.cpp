// Experiment `sphere`: its chapter, and cloths on a ball.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/sphere/probes.h"
#include "experiments/tables/table.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// A depth in %; rounding on the surface counts as zero.
std::string depth_text(double percent) { return percent < 1e-9 ? "0" : nice(percent); }

/// Penetration depth of particles and triangles by method and time step; empty where nothing penetrates.
std::optional<Chart> depth_chart(const Table& table, const std::string& scene, const std::string& commit) {
  Figure f;
  f.name = scene + "-penetration";
  f.title = scene + ": largest penetration depth";
  f.x = {"", false, std::nullopt, std::nullopt};
  f.y = {"penetration depth / % of the radius", true, 1e-3, 10};
  double place = 0;
  std::vector<std::string> failed;                                   // without a mark
  std::map<const MethodFamily*, std::pair<double, double>> deepest;  // particles and triangles, %
  std::map<double, std::pair<Curve, Curve>> by_step;
  // of each time step: its colour, and its marks for particles and triangles
  static constexpr struct {
    const char* colour;
    int particles, triangles;
  } looks[] = {{"#0072B2", 6, 9}, {"#D55E00", 4, 11}, {"#009E73", 12, 8}, {"#CC79A7", 14, 10}, {"#E69F00", 7, 13}};
  for (const std::string& method : distinct(table, "method")) {
    bool any = false;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "scene") != scene || text_at(table, i, "method") != method) continue;
      if (!any) f.categories.emplace_back(++place, method == sticky_sphere ? "sticky sphere" : short_name(method));
      any = true;
      const auto h = number_at(table, i, "step"), nodes = number_at(table, i, "particles"),
                 triangles = number_at(table, i, "triangles");
      if (const std::string& verdict = text_at(table, i, "verdict"); verdict != "ok") {
        const std::string which = fmt::format("{} ({})", name_in_sentence(method), failure_class(verdict));
        if (std::ranges::find(failed, which) == failed.end()) failed.push_back(which);
        continue;
      }
      if (method != sticky_sphere && family_of(method).by_default()) {
        auto& [particles, flat] = deepest[&family_of(method)];
        particles = std::max(particles, nodes.value_or(0)), flat = std::max(flat, triangles.value_or(0));
      }
      if (const Method* m = builtin_without_options(method); m && m->adaptive)
        continue;  // an adaptive method has no fixed step
      if (!by_step.contains(*h)) {
        const auto& [colour, particles, flat] = looks[by_step.size() % std::size(looks)];
        by_step[*h] = {
            {fmt::format("particles, time step {}", step_text(*h)), {colour, "1", particles}, {}, false, true},
            {fmt::format("triangles, time step {}", step_text(*h)), {colour, "1", flat}, {}, false, true}};
      }
      if (nodes && *nodes > 1e-3) by_step[*h].first.points.emplace_back(place - 0.12, *nodes);
      if (triangles && *triangles > 1e-3) by_step[*h].second.points.emplace_back(place + 0.12, *triangles);
    }
  }
  for (auto& [h, curves] : by_step)
    for (Curve* curve : {&curves.first, &curves.second})
      if (!curve->points.empty()) f.curves.push_back(std::move(*curve));
  if (f.curves.empty()) return std::nullopt;
  f.x.low = 0.4, f.x.high = place + 0.6;
  std::string particles_of_peers, triangles_of_peers;
  for (const MethodFamily* peer : default_peers()) {
    particles_of_peers += fmt::format(", of {} by {} %", peer->title, depth_text(deepest[peer].first));
    triangles_of_peers += fmt::format(", {} % in {}", depth_text(deepest[peer].second), peer->title);
  }
  f.finding = fmt::format(
      "Particles of mysim are inside by at most {} % of the radius{}; the triangles between them by {} % "
      "in mysim{}. Below 0.001 % nothing is drawn.",
      depth_text(deepest[&subject()].first), particles_of_peers, depth_text(deepest[&subject()].second),
      triangles_of_peers);
  f.caption =
      fmt::format("Scene {}, largest at any sample, in per cent of the contact radius; commit {}.{}", scene, commit,
                  failed.empty() ? "" : fmt::format(" Without a mark at some steps: {}.", joined(failed)));
  f.tier = "exact (a ball's surface)";
  return Chart{"", std::move(f), "sphere"};
}

/// The final state of a scene with a draped body, by method, at the step that all share (usual_step()); methods that
/// choose their steps stand at their own.
PageTable drape_table(const Table& table, const std::string& scene) {
  const double step = usual_step(table);
  PageTable page{fmt::format("{}: final state, at time steps of {}", scene, step_text(step)),
                 {"method", "settled after / s", "height of the centre of mass / m", "sideways displacement / mm",
                  "creep / (mm/s)", "dissipated in contact / J", "asymmetry / m"},
                 {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene || std::abs(number_at(table, i, "step", step) / step - 1) > 1e-6) continue;
    const std::string& method = text_at(table, i, "method");
    if (text_at(table, i, "verdict") != "ok") {
      const std::string why = text_at(table, i, "verdict") == "unsupported"
                                  ? "cannot: " + text_at(table, i, "reason")
                                  : fmt::format("{} at {:.3g} s", failure_class(text_at(table, i, "verdict")),
                                                number_at(table, i, "end").value_or(0));
      page.rows.push_back({method, why, "", "", "", "", ""});
      continue;
    }
    auto said = [&](const char* column, double factor, const char* otherwise) {
      const auto value = number_at(table, i, column);
      return value ? nice(factor * *value) : std::string(otherwise);
    };
    const bool inferred = flag_at(table, i, "contact inferred");
    page.rows.push_back({method, said("settled after", 1, "not at rest"), said("centre height", 1, ""),
                         said("centre moved aside", 1e3, ""), said("creep", 1e3, "off the ball"),
                         said("contact took", 1, "") + (inferred ? " (inferred)" : ""), said("asymmetry", 1, "")});
  }
  return page;
}

/// The cloth that slides off, by four methods with different results.
Chart drape_snapshot(const Table& table) {
  Snapshot s;
  s.name = "sphere-drop-aside";
  s.scene = drop_aside();
  Run run = default_run(s.scene);
  // ends before the cloth leaves the picture
  run.duration = 1.16, run.samples = 58;
  for (const std::string& method : representatives_in_contact())
    if (const auto all = distinct(table, "method"); std::find(all.begin(), all.end(), method) != all.end())
      s.panels.push_back({method, run});
  s.shot.mode = Mode::stretch;
  s.shot.width = 1200, s.shot.height = 400;
  s.caption =
      "The cloth that is dropped 0.12 m aside with a friction of 0.25, after 1.16 s: by Coulomb's law it slides off.";
  Chart chart{"", std::monostate{}, "sphere",
              "Dropped beside the middle, with a friction coefficient that cannot hold it.",
              "A cloth that should slide off"};
  if (!s.panels.empty()) chart.snapshots.push_back(std::move(s));
  return chart;
}

struct TimeSeries {
  const char *column, *name, *title, *label;
  double factor;
  bool logarithmic;
  const char* tier;
};

/// A quantity over time, at the usual step.
std::optional<Chart> time_series_chart(const Table& table, const std::string& scene, const TimeSeries& what,
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

/// Says which methods still slide at the end, at the usual step.
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

/// Methods a micrometre and more from their mirror image, and since when, at the usual step.
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
  const TableSet& rows = input.result;
  const auto add = [&](std::optional<Chart> chart) {
    if (chart) charts.push_back(std::move(*chart));
  };
  if (const Table* table = rows.table("sphere-cone")) {
    add(cone_law(*table, input.commit));
    add(cone_map(*table, input.commit));
  }
  if (const Table* table = rows.table("sphere-rebound")) add(rebound_chart(*table, input.commit));
  if (const Table* table = rows.table("sphere-leaving")) add(leaving_chart(*table, input.commit));
  if (const Table* table = rows.table("sphere-order")) add(contact_order_chart(*table, input.commit));
  const Table *drapes = rows.table("sphere-drape"), *deep = rows.table("sphere-penetration");
  if (!drapes || !deep) return charts;
  for (const std::string& scene : distinct(*drapes, "scene")) {
    const Table* over_time = rows.table(scene + "-drape");
    if (scene == "drop-aside") {
      add(drape_snapshot(*drapes));
    }
    bool cloth = false, symmetric = false;
    for (size_t i = 0; i < over_time->rows.size(); ++i) {
      cloth |= number_at(*over_time, i, "triangles inside").has_value();
      symmetric |= number_at(*over_time, i, "asymmetry").has_value();
    }
    if (!cloth) continue;  // single particles have their scenes' own parts of the page
    add(time_series_chart(
        *over_time, scene,
        {"creep", "sliding", "sliding speed of the particles in contact", "sliding speed / (mm/s)", 1e3, true,
         "another engine: contact rules differ, so that these are differences and no errors"},
        "How fast the touching particles slide. " + still_sliding(*over_time, end_of(*over_time)), input.commit));
    if (symmetric) {
      add(time_series_chart(
          *over_time, scene,
          {"asymmetry", "asymmetry", "distance from its mirror image", "asymmetry / m", 1, true, "exact (zero)"},
          "The scene is symmetric in two planes: a rule that looks at all particles alike parts from it by "
          "rounding only, which grows. " +
              broken_symmetry(*over_time),
          input.commit));
    }
    if (scene != "drop-aside") {
      Chart ends{"", std::monostate{}, "sphere", "", scene + ": final state"};
      ends.tables.push_back(drape_table(*drapes, scene));
      add(std::move(ends));
    }
    add(depth_chart(*deep, scene, input.commit));
  }
  return charts;
}

}  // namespace crosscheck
