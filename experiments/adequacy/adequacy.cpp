// Experiment `adequacy`: ablations of each scene's model, its smallest sufficient model, and the grid dependence of
// cloth.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/adequacy/ablation.h"
#include "experiments/adequacy/resolution.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/tables/adequacy.h"
#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

constexpr unsigned unseen_starts = 3;

double largest_speed(const Trajectory& t) {
  double largest = 0;
  for (const Points& v : t.v)
    if (v.cols() > 0) largest = std::max(largest, v.norm() / std::sqrt(static_cast<double>(v.cols())));
  return largest;
}

Scene without_all(Scene scene, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    for (const Ingredient& i : ingredients_of(scene))
      if (i.name == name) {
        scene = without(scene, i);
        break;
      }
  return scene;
}

/// Error (m) of the model without the ingredients `out`: its distance from a run of the full model with the same start,
/// method and step. If `out` is empty, returns the smallest error of a single removal. Empty if the full model fails.
std::optional<double> unseen_error(const Scene& scene, const ReferenceSolution& y,
                                   const std::vector<std::string>& out) {
  Recorder full;
  if (run_method(y.method, scene, y.run, {&full}).verdict != Verdict::ok) return std::nullopt;
  Outcome ignored;
  if (!out.empty()) return model_error(without_all(scene, out), y, full.trajectory, ignored);
  std::optional<double> least;
  for (const Ingredient& i : ingredients_of(scene))
    if (const auto e = model_error(without(scene, i), y, full.trajectory, ignored))
      least = std::min(*e, least.value_or(*e));
  return least.value_or(INFINITY);  // every removal failed
}

std::string truth_text(const Truth& truth) {
  return truth.under_contact_rule ? "limit of mysim's contact rule: a difference" : std::string(name_of(truth.tier));
}

void ablations_on(const Request&, const Scene& scene, TableSet& tables) {
  Table table = table_of<AdequacyRow>(), least = table_of<LeastModelRow>();
  try {
    const ReferenceSolution y = reference_solution_of(scene, scene.tolerance);
    Trajectory seen = y.truth.trajectory;
    const size_t frames = static_cast<size_t>(y.run.samples) + 1;
    seen.t.resize(frames), seen.x.resize(frames);
    const double motion = motion_of(seen);
    const std::vector<AblatedModel> models = ablations_of(scene, y, 0.3 * motion);
    const double full_cost = models.front().cost();
    for (const AblatedModel& r : models)
      add(table, AdequacyRow{.scene = scene.name,
                             .model = r.name,
                             .left_out = fmt::format("{}", fmt::join(r.out, ", ")),
                             .kind = r.out.empty() ? ModelKind::full
                                     : r.single    ? ModelKind::single
                                                   : ModelKind::cumulative,
                             .error = r.error,
                             .tolerance = scene.tolerance,
                             .within = r.error && *r.error <= scene.tolerance,
                             .motion = motion,
                             .truth_bar = y.truth.error_bar,
                             .truth = truth_text(y.truth),
                             .verdict = r.outcome.verdict,
                             .evaluations = r.outcome.evaluations,
                             .springs = springs_of(r.scene.model),
                             .cost = r.cost()});
    const double speed = 0.2 * largest_speed(y.truth.trajectory);
    const std::pair<double, ToleranceKind> tolerances[] = {{scene.tolerance, ToleranceKind::of_scene},
                                                           {0.01 * motion, ToleranceKind::hundredth_of_motion},
                                                           {0.1 * motion, ToleranceKind::tenth_of_motion}};
    std::map<std::vector<std::string>, std::vector<std::optional<double>>> unseen;  // by ingredients left out
    for (const auto& [tolerance, what] : tolerances) {
      const AblatedModel& l = least_model(models, tolerance);
      LeastModelRow row{.scene = scene.name,
                        .tolerance = tolerance,
                        .tolerance_is = what,
                        .least_model = l.out.empty() ? "nothing can be left out" : l.name,
                        .left_out = fmt::format("{}", fmt::join(l.out, ", ")),
                        .error = l.error,
                        .holds = true,
                        .cost_of_full = full_cost > 0 ? l.cost() / full_cost : 1};
      auto& errors = unseen[l.out];
      for (unsigned seed = 1; errors.size() < unseen_starts; ++seed)
        errors.push_back(unseen_error(unseen_start(scene, speed, seed), y, l.out));
      std::optional<double>* const cells[unseen_starts] = {&row.unseen_error_1, &row.unseen_error_2,
                                                           &row.unseen_error_3};
      for (size_t i = 0; i < errors.size(); ++i) {
        const auto& e = errors[i];
        if (e && std::isfinite(*e)) *cells[i] = e;
        row.holds = row.holds && e && (l.out.empty() ? *e > tolerance : *e <= tolerance);
      }
      add(least, row);
    }
  } catch (const Unsupported& why) {
    tables.notes.push_back(fmt::format("adequacy leaves out {}: {}", scene.name, why.what()));
  }
  tables.add(table);
  tables.add(least);
}

void resolution_on(const Request& request, const Scene& scene, TableSet& tables) {
  Table table = table_of<GridRow>();
  std::vector<int> sizes{8, 12, 16, 24};
  if (request.full) sizes.insert(sizes.end(), {32, 48, 64, 96, 128});
  for (const GridResult& r : grid_convergence(scene, sizes))
    add(table, GridRow{.scene = scene.name,
                       .particles = r.n,
                       .cells = r.n - 1.,
                       .error = r.error,
                       .sag = r.sag,
                       .stiffness_factor = r.factor,
                       .verdict = r.verdict,
                       .evaluations = r.evaluations,
                       .springs = r.springs,
                       .cost = static_cast<double>(r.evaluations) * static_cast<double>(r.springs)});
  tables.add(table);
}

void bending_on(const Request& request, TableSet& tables) {
  Table table = table_of<BendingRow>();
  std::vector<int> sizes{8, 10, 12, 16};
  if (request.full) sizes.insert(sizes.end(), {20, 24});
  for (const BendSprings& b : bending_stiffness(sizes)) add(table, BendingRow{b.n, b.cells, b.stiffness, b.droop});
  tables.add(table);
}

}  // namespace

std::vector<Point> adequacy_points(const Request& request) {
  std::vector<Point> points;  // the most expensive points first, so that no core waits at the end
  for (const Scene& scene : request.scenes) {
    if (!cloth_grid_of(scene) || has_contact(scene.model)) continue;
    Request alone = request;
    alone.scenes = {scene};
    points.push_back({fmt::format("adequacy: grids of {}", scene.name), content_of(request, scene) + scene.source,
                      [alone = std::move(alone)](TableSet& tables) { resolution_on(alone, alone.scenes[0], tables); }});
  }
  if (!points.empty() && !request.scenes_only)
    points.push_back({"adequacy: bend springs", fmt::format("full={}", request.full),
                      [request](TableSet& tables) { bending_on(request, tables); }});
  for (Point& point : one_point_per_scene(request, "adequacy", ablations_on)) points.push_back(std::move(point));
  return points;
}

void conclude_adequacy(TableSet& tables) {
  Table table = table_of<ScalingRow>();
  using Curve = std::vector<std::pair<double, double>>;
  const auto fit = [&](const std::string& scene, ScalingQuantity what, const Curve& points,
                       std::optional<double> derived = {}) {
    if (const auto law = power_law(points)) add(table, ScalingRow{scene, what, law->exponent, law->deviation, derived});
  };
  if (const Table* grids = tables.table("adequacy-resolution")) {
    const auto all = rows_of<GridRow>(*grids);
    for (size_t i = 0; i < all.size();) {
      const std::string& scene = all[i].scene;
      Curve errors, stiffnesses;
      for (; i < all.size() && all[i].scene == scene; ++i) {
        if (all[i].error && *all[i].error > 0) errors.emplace_back(all[i].cells, *all[i].error);
        if (all[i].stiffness_factor && *all[i].stiffness_factor > 0)
          stiffnesses.emplace_back(all[i].cells, *all[i].stiffness_factor);
      }
      fit(scene, ScalingQuantity::error, errors);
      fit(scene, ScalingQuantity::stiffness_for_sag, stiffnesses);
    }
  }
  if (const Table* bending = tables.table("adequacy-bending")) {
    Curve stiffnesses;
    for (const BendingRow& row : rows_of<BendingRow>(*bending)) stiffnesses.emplace_back(row.cells, row.stiffness);
    fit("", ScalingQuantity::bend_stiffness_for_droop, stiffnesses, 4.);
  }
  if (!table.rows.empty()) tables.add(table);
}

}  // namespace crosscheck
