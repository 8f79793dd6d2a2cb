// Experiment `contact`: its chapter, and cloths on a ball.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/contact/probes.h"
#include "experiments/tables/contact.h"
#include "report/figures/chapter_parts.h"
#include "report/findings/findings.h"
#include "report/findings/findings_text.h"
#include "report/findings/summaries.h"

namespace crosscheck {
namespace {

/// Depth in %. Round-off on the surface counts as zero.
std::string depth_text(double percent) { return percent < 1e-9 ? "0" : nice(percent); }

/// Penetration by method and time step; nullopt if nothing penetrates.
std::optional<Chart> depth_chart(const std::vector<PenetrationRow>& rows, const std::string& scene,
                                 const std::string& commit) {
  Figure f;
  f.y.low = 1e-3, f.y.high = 10;
  std::vector<std::string> failed;
  std::map<const MethodFamily*, std::pair<double, double>> deepest;  // particles and triangles, %
  std::map<double, std::pair<Curve, Curve>> by_step;
  // colour of each time step, and its marks for particles and triangles
  static constexpr struct {
    const char* colour;
    int particles, triangles;
  } looks[] = {{"#0072B2", 6, 9}, {"#D55E00", 4, 11}, {"#009E73", 12, 8}, {"#CC79A7", 14, 10}, {"#E69F00", 7, 13}};
  std::string method;
  for (const PenetrationRow& row : rows | with(&PenetrationRow::scene, scene)) {
    if (row.method != method) {
      method = row.method;
      f.categories.emplace_back(f.categories.size() + 1,
                                method == sticky_sphere ? "sticky sphere" : short_name(method));
    }
    const auto place = static_cast<double>(f.categories.size());
    if (row.verdict != Verdict::ok) {
      const std::string which = fmt::format("{} ({})", name_in_sentence(method), failure_class(row.verdict));
      if (std::ranges::find(failed, which) == failed.end()) failed.push_back(which);
      continue;
    }
    const double particles = row.particles.value_or(0), triangles = row.triangles.value_or(0);
    if (method != sticky_sphere && family_of(method).by_default()) {
      auto& [deep, flat] = deepest[&family_of(method)];
      deep = std::max(deep, particles), flat = std::max(flat, triangles);
    }
    if (const Method* m = builtin_without_options(method); m && m->adaptive) continue;
    if (!by_step.contains(row.step)) {
      const auto& [colour, deep, flat] = looks[by_step.size() % std::size(looks)];
      const std::string step = step_text(row.step);
      by_step[row.step] = {{"particles, time step " + step, {colour, "1", deep}, {}, false, true},
                           {"triangles, time step " + step, {colour, "1", flat}, {}, false, true}};
    }
    auto& [deep, flat] = by_step[row.step];
    if (particles > 1e-3) deep.points.emplace_back(place - 0.12, particles);
    if (triangles > 1e-3) flat.points.emplace_back(place + 0.12, triangles);
  }
  for (auto& [h, curves] : by_step)
    for (Curve* curve : {&curves.first, &curves.second})
      if (!curve->points.empty()) f.curves.push_back(std::move(*curve));
  if (f.curves.empty()) return std::nullopt;
  f.x.low = 0.4, f.x.high = static_cast<double>(f.categories.size()) + 0.6;
  std::string particles_of_peers, triangles_of_peers;
  for (const MethodFamily* peer : default_peers()) {
    particles_of_peers += fmt::format(", those of {} by {} %", peer->title, depth_text(deepest[peer].first));
    triangles_of_peers += fmt::format(", {} % in {}", depth_text(deepest[peer].second), peer->title);
  }
  f.finding = fmt::format(
      "Particles of mysim penetrate by at most {} % of the radius{}; the triangles between them by {} % "
      "in mysim{}. Depths below 0.001 % are not drawn.",
      depth_text(deepest[&subject()].first), particles_of_peers, depth_text(deepest[&subject()].second),
      triangles_of_peers);
  return described("{scene}-penetration", std::move(f), "scene"_a = scene, "commit"_a = commit,
                   "failed"_a = failed.empty() ? "" : fmt::format(" Not marked at some steps: {}.", joined(failed)));
}

bool is_step(double h, double step) { return std::abs(h / step - 1) < 1e-6; }

/// Final state of a scene with a draped body, for each method, at the step that all methods share; adaptive methods
/// choose their steps.
Chart ends_chart(const std::vector<DrapeRow>& rows, const std::string& scene) {
  const double step = usual_step(rows);
  PageTable page{fmt::format("{}: final state, at time steps of {}", scene, step_text(step)),
                 {"method", "settled after / s", "height of the centre of mass / m", "sideways displacement / mm",
                  "creep / (mm/s)", "dissipated in contact / J", "asymmetry / m"},
                 {}};
  for (const DrapeRow& row : rows | with(&DrapeRow::scene, scene)) {
    if (!is_step(row.step, step)) continue;
    if (row.verdict != Verdict::ok) {
      page.rows.push_back({row.method,
                           row.verdict == Verdict::unsupported
                               ? "cannot: " + row.reason
                               : fmt::format("{} at {:.3g} s", failure_class(row.verdict), row.end),
                           "", "", "", "", ""});
      continue;
    }
    const auto said = [](const OptionalNumber& value, double factor, const char* otherwise = "") {
      return value ? nice(factor * *value) : otherwise;
    };
    page.rows.push_back({row.method, said(row.settled_after, 1, "not at rest"), said(row.centre_height, 1),
                         said(row.moved_aside, 1e3), said(row.creep, 1e3, "off the ball"),
                         said(row.contact, 1) + (row.contact_inferred ? " (inferred)" : ""), said(row.asymmetry, 1)});
  }
  Chart chart = described("{scene}-ends", std::monostate{}, "scene"_a = scene);
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart drape_snapshot(const std::vector<DrapeRow>& rows) {
  Snapshot s;
  s.name = "sphere-drop-aside";
  s.scene = drop_aside();
  Run run = default_run(s.scene);
  // the run ends before the cloth leaves the picture
  run.duration = 1.16, run.samples = 58;
  for (const std::string& method : representatives_in_contact())
    if (std::ranges::find(rows, method, &DrapeRow::method) != rows.end()) s.panels.push_back({method, run});
  s.shot.mode = Mode::stretch;
  s.shot.width = 1200, s.shot.height = 400;
  s.caption = filled_text(s.name, "caption");
  Chart chart = described(s.name, std::monostate{});
  if (!s.panels.empty()) chart.snapshots.push_back(std::move(s));
  return chart;
}

/// Rows of each method's run at the usual step.
using RunsOverTime = std::vector<std::pair<std::string, std::vector<DrapeTimeRow>>>;

RunsOverTime runs_over_time(const std::vector<DrapeTimeRow>& rows, double step) {
  RunsOverTime runs;
  for (const std::string& method : distinct(rows, &DrapeTimeRow::method)) {
    auto& own = runs.emplace_back(method, std::vector<DrapeTimeRow>()).second;
    std::ranges::copy_if(rows, std::back_inserter(own),
                         [&](const DrapeTimeRow& row) { return row.method == method && is_step(row.step, step); });
  }
  std::erase_if(runs, [](const auto& run) { return run.second.empty(); });
  return runs;
}

/// Curves of a quantity over time. Omits values that are not positive.
Figure curves_over_time(const RunsOverTime& runs, OptionalNumber DrapeTimeRow::*value, double factor) {
  Figure f;
  f.x.low = 0;
  for (const auto& [method, rows] : runs) {
    Curve curve{method, style_of(method), {}};
    for (const DrapeTimeRow& row : rows)
      if (row.*value && *(row.*value) > 0) curve.points.emplace_back(row.t, *(row.*value) * factor);
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  return f;
}

std::string still_sliding(const RunsOverTime& runs, double end) {
  std::vector<std::string> sliding;
  for (const auto& [method, rows] : runs)
    if (const DrapeTimeRow& last = rows.back(); last.t >= end * (1 - 1e-9) && last.creep.value_or(0) > 1e-3)
      sliding.push_back(fmt::format("{} ({} mm/s)", method, nice(1e3 * *last.creep)));
  return sliding.empty() ? "At the end nothing in contact slides faster than 1 mm/s."
                         : fmt::format("Still above 1 mm/s at the end: {}.", joined(sliding));
}

/// Methods that deviate from mirror symmetry by a micrometre or more, each with the time of the first such deviation.
std::string broken_symmetry(const RunsOverTime& runs) {
  std::vector<std::string> broken;
  double others = 0;
  for (const auto& [method, rows] : runs) {
    const auto skew = [](const DrapeTimeRow& row) { return row.asymmetry.value_or(0); };
    if (const auto since = std::ranges::find_if(rows, [&](const auto& row) { return skew(row) > 1e-6; });
        since != rows.end())
      broken.push_back(fmt::format("{} (after {:.2g} s)", method, since->t));
    else
      others = std::max(others, std::ranges::max(rows | std::views::transform(skew)));
  }
  return (broken.empty() ? "" : fmt::format("More than a micrometre off: {}. ", joined(broken))) +
         fmt::format("{} at most {} off.", broken.empty() ? "All are" : "The others are", nice_length(others));
}

}  // namespace

std::vector<Chart> probe_charts(const ChartInput& input) {
  const TableSet& tables = input.result;
  std::vector<Chart> charts = particle_charts(tables, input.commit);
  const auto ends = rows_of<DrapeRow>(tables);
  const auto deep = rows_of<PenetrationRow>(tables);
  for (const std::string& scene : distinct(ends, &DrapeRow::scene)) {
    const auto rows = rows_of<DrapeTimeRow>(*tables.table(scene + "-drape"));
    if (scene == "drop-aside") charts.push_back(drape_snapshot(ends));
    const auto has = [&](OptionalNumber DrapeTimeRow::*value) {
      return std::ranges::any_of(rows, [&](const DrapeTimeRow& row) { return (row.*value).has_value(); });
    };
    if (!has(&DrapeTimeRow::triangles_inside)) continue;  // single particles have cards of their own
    const double step = usual_step(rows);
    const RunsOverTime runs = runs_over_time(rows, step);
    if (Figure f = curves_over_time(runs, &DrapeTimeRow::creep, 1e3); !f.curves.empty())
      charts.push_back(described("{scene}-sliding", std::move(f), "scene"_a = scene, "step"_a = step_text(step),
                                 "sliding"_a = still_sliding(runs, std::ranges::max(rows, {}, &DrapeTimeRow::t).t),
                                 "commit"_a = input.commit));
    if (Figure f = curves_over_time(runs, &DrapeTimeRow::asymmetry, 1); !f.curves.empty())
      charts.push_back(described("{scene}-asymmetry", std::move(f), "scene"_a = scene, "step"_a = step_text(step),
                                 "broken"_a = broken_symmetry(runs), "commit"_a = input.commit));
    if (scene != "drop-aside") charts.push_back(ends_chart(ends, scene));
    if (auto chart = depth_chart(deep, scene, input.commit)) charts.push_back(std::move(*chart));
  }
  return charts;
}

}  // namespace crosscheck
