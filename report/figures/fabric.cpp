// Strips of cloth compared with the elastica, a clamped beam and the catenary, on several grids; skip-one springs
// compared with the bending term; a round cloth draped over a disc.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/fabric/disc.h"
#include "experiments/tables/fabric.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

constexpr const char* colours[] = {"#0072B2", "#7A3B00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#333333"};

MethodStyle style_at(size_t place) {
  return {colours[place % std::size(colours)], place < 5 ? "1" : "(6,3)", 4 + static_cast<int>(place)};
}

Curve& curve_of(Figure& f, const std::string& title) { return curve_of(f, title, style_at(f.curves.size())); }

/// Order of convergence from the deviations and cell numbers of the last two points.
double order_at_end(const Curve& curve) {
  const auto& [coarse, before] = curve.points[curve.points.size() - 2];
  const auto& [fine, after] = curve.points.back();
  return std::log(before / after) / std::log(fine / coarse);
}

/// True for the lightest, middle and heaviest weight, and the largest load at the tip. Curves of other loads would
/// coincide with these.
bool is_drawn(const CantileverRow& row) {
  return row.tip_load > 0 ? row.tip_load == 5 : row.gamma == 0.1 || row.gamma == 5 || row.gamma == 50;
}

Chart deviations(const std::vector<CantileverRow>& cantilevers, const std::vector<StripVibrationRow>& vibrations,
                 const std::string& commit) {
  Figure f;
  std::set<std::string> drawn;
  for (const CantileverRow& row : cantilevers) {
    const std::string title = row.tip_load > 0 ? fmt::format("drop, P L² / B = {:g}", row.tip_load)
                                               : fmt::format("drop, w L³ / B = {:g}", row.gamma);
    curve_of(f, title).points.emplace_back(static_cast<double>(row.cells), 100 * std::abs(row.deviation));
    if (is_drawn(row)) drawn.insert(title);
  }
  for (const StripVibrationRow& row : vibrations)
    if (row.mode <= 2) {
      const std::string title = fmt::format("frequency {}", row.mode);
      curve_of(f, title).points.emplace_back(static_cast<double>(row.cells), 100 * std::abs(row.deviation));
      drawn.insert(title);
    }
  double worst = 0, low = INFINITY, high = 0;
  for (const Curve& curve : f.curves) {
    worst = std::max(worst, curve.points.back().second);
    low = std::min(low, order_at_end(curve)), high = std::max(high, order_at_end(curve));
  }
  std::erase_if(f.curves, [&](const Curve& curve) { return !drawn.contains(curve.title); });
  for (size_t i = 0; i < f.curves.size(); ++i) f.curves[i].style = style_at(i);
  return described("fabric-grid", std::move(f), "worst"_a = nice(worst), "low"_a = low, "high"_a = high,
                   "commit"_a = commit);
}

Chart skip_one(const std::vector<SkipOneRow>& rows, const std::string& commit) {
  Figure f;
  f.y.low = 0;
  for (const SkipOneRow& row : rows)
    curve_of(f, row.net).points.emplace_back(static_cast<double>(row.cells), 100 * row.drop);
  f.floor = {"elastica", 100 * rows.front().truth};
  double low = INFINITY, high = 0;
  for (const SkipOneRow& row : rows)
    if (row.skip_one > 0) low = std::min(low, row.drop), high = std::max(high, row.drop);
  return described("fabric-skip-one", std::move(f), "low"_a = nice(100 * low), "high"_a = nice(100 * high),
                   "truth"_a = nice(100 * rows.front().truth), "commit"_a = commit);
}

Chart hanging(const std::vector<HangingStripRow>& rows, const std::vector<HangingShapeRow>& shapes,
              const std::string& commit) {
  Figure f;
  for (const HangingShapeRow& row : shapes)
    curve_of(f, row.gamma > 0 ? fmt::format("elastica, w L³ / B = {:g}", row.gamma) : "catenary")
        .points.emplace_back(100 * row.x, 100 * row.height);
  for (Curve& curve : f.curves) curve.style.marker = no_marker, curve.markers = false;
  Curve net{"nets of 16 cells", {"#333333", "1", 6}, {}, false, true};
  for (const HangingShapeRow& row : shapes)
    if (row.net_x && row.net_height) net.points.emplace_back(100 * *row.net_x, 100 * *row.net_height);
  f.curves.push_back(std::move(net));
  double worst = 0, low = INFINITY, high = 0;
  for (size_t i = 1; i < rows.size(); ++i) {
    const bool is_finest = i + 1 == rows.size() || rows[i + 1].gamma != rows[i].gamma;
    if (!is_finest) continue;
    const double order = std::log2(rows[i - 1].deviation / rows[i].deviation);
    worst = std::max(worst, std::abs(rows[i].deviation)), low = std::min(low, order), high = std::max(high, order);
  }
  return described("fabric-hanging", std::move(f), "worst"_a = nice(100 * worst), "low"_a = low, "high"_a = high,
                   "commit"_a = commit);
}

/// Snapshot of the drape, seen from `eye`. Its scene starts in the draped state.
Snapshot draped(const std::vector<DrapedParticleRow>& rows, const std::string& name, const Vec3& eye,
                const std::string& caption) {
  const DrapedDisc disc{static_cast<int>(rows.back().ring) - 1, 1};
  Scene scene = disc_scene(disc);
  for (size_t i = 0; i < rows.size(); ++i) scene.start.x.col(static_cast<int>(i)) << rows[i].x, rows[i].y, rows[i].z;
  // draw particles on the disc as cloth, not as pins
  const int n = static_cast<int>(scene.start.x.cols()), centre = n;
  for (Points* each : {&scene.start.x, &scene.start.v}) {
    each->conservativeResize(3, n + 1);
    each->col(centre).setZero();
  }
  Particles& particles = scene.model.particles;
  particles.mass.conservativeResize(n + 1);
  particles.mass[centre] = particles.mass[0];
  particles.pinned.assign(static_cast<size_t>(n) + 1, 0), particles.pins.clear(), particles.pin_home.resize(3, 0);
  for (int j = 0; j < disc.spokes(); ++j)
    scene.triangles.push_back({disc.particle(0, j + 1), disc.particle(0, j), centre});
  scene.camera = Camera{eye, Vec3::Zero(), std::nullopt};
  Snapshot s{.name = name, .caption = caption, .scene = scene, .panels = {}, .shot = {}};
  s.panels.push_back({"leapfrog", {.step = 1e-9, .duration = 1e-9, .samples = 1}});
  s.shot.width = 480, s.shot.height = 360;
  s.moments = {{0, caption}};
  return s;
}

Chart drape(const std::vector<DrapedDiscRow>& rows, const std::vector<DrapedParticleRow>& shape,
            const std::string& commit) {
  Figure f;
  f.x.low = 3.5, f.x.high = 9.5;
  for (int nodes = 4; nodes < 10; ++nodes) f.categories.emplace_back(nodes, std::to_string(nodes));
  f.y.low = 64, f.y.high = 80;
  f.floor = {"cotton, measured", 68.4};
  // the row with the finest grid and the first row's shear stiffness
  const DrapedDiscRow& lowest = *std::find_if(
      rows.rbegin(), rows.rend(), [&](const DrapedDiscRow& row) { return row.shear == rows.front().shear; });
  double least = INFINITY, most = 0, before = 0, sheared = 0;
  for (const DrapedDiscRow& row : rows) {
    if (row.shear != lowest.shear) {
      sheared = row.coefficient;
      continue;
    }
    curve_of(f, fmt::format("{} rings", row.rings))
        .points.emplace_back(static_cast<double>(row.nodes), row.coefficient);
    if (row.rings == rows.front().rings)
      least = std::min(least, row.coefficient), most = std::max(most, row.coefficient);
    if (2 * row.rings == lowest.rings && row.start == lowest.start) before = row.coefficient;
  }
  for (Curve& curve : f.curves) std::ranges::sort(curve.points);
  Chart chart =
      described("fabric-drape", std::move(f), "nodes"_a = lowest.nodes, "coefficient"_a = lowest.coefficient,
                "change"_a = std::abs(lowest.coefficient - before), "coarse"_a = lowest.rings / 2, "least"_a = least,
                "most"_a = most, "rigidity"_a = 1e6 * lowest.rigidity, "shear"_a = lowest.shear, "sheared"_a = sheared,
                "rings"_a = rows.front().rings, "commit"_a = commit);
  if (!shape.empty()) {
    chart.snapshots.push_back(draped(shape, "fabric-drape-above", {0.02, 1, 0}, "The drape, from above"));
    chart.snapshots.push_back(draped(shape, "fabric-drape-side", {0.3, 0.45, 1}, "and from the side"));
  }
  return chart;
}

}  // namespace

std::vector<Chart> fabric_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const auto cantilevers = rows_of<CantileverRow>(input.result);
  const auto vibrations = rows_of<StripVibrationRow>(input.result);
  if (!cantilevers.empty() && !vibrations.empty()) charts.push_back(deviations(cantilevers, vibrations, input.commit));
  if (const auto rows = rows_of<SkipOneRow>(input.result); !rows.empty())
    charts.push_back(skip_one(rows, input.commit));
  const auto hung = rows_of<HangingStripRow>(input.result);
  if (const auto shapes = rows_of<HangingShapeRow>(input.result); !hung.empty() && !shapes.empty())
    charts.push_back(hanging(hung, shapes, input.commit));
  if (const auto rows = rows_of<DrapedDiscRow>(input.result); !rows.empty())
    charts.push_back(drape(rows, rows_of<DrapedParticleRow>(input.result), input.commit));
  return charts;
}

}  // namespace crosscheck
