// Experiment `adequacy`: the model ladder of each scene, the least model within its tolerance, and how cloth depends on
// its grid.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/adequacy/ablation.h"
#include "experiments/adequacy/resolution.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

constexpr unsigned unseen_starts = 3;

Table ablations_table() {
  return {"adequacy",
          {{"scene", "1"},
           {"rung", "1"},
           {"left out", "1"},
           {"kind", "1"},  // full, single or cumulative
           {"error", "m"},
           {"tolerance", "m"},
           {"within", "1"},
           {"motion", "m"},
           {"truth bar", "m"},
           {"truth", "1"},
           {"verdict", "1"},
           {"evaluations", "1"},
           {"springs", "1"},
           {"cost", "spring evaluations"}},
          {}};
}

Table least_table() {
  return {"adequacy-least",
          {{"scene", "1"},
           {"tolerance", "m"},
           {"tolerance is", "1"},
           {"least model", "1"},
           {"left out", "1"},
           {"error", "m"},
           {"unseen error 1", "m"},
           {"unseen error 2", "m"},
           {"unseen error 3", "m"},
           {"holds", "1"},
           {"cost of full", "1"}},
          {}};
}

/// RMS speed of the particles, its largest value over the run, m/s.
double largest_speed(const Trajectory& t) {
  double largest = 0;
  for (const Points& v : t.v)
    if (v.cols() > 0) largest = std::max(largest, v.norm() / std::sqrt(static_cast<double>(v.cols())));
  return largest;
}

/// The scene without the ingredients of that name, in their order.
Scene without_all(Scene scene, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    for (const Ingredient& i : ingredients_of(scene))
      if (i.name == name) {
        scene = without(scene, i);
        break;
      }
  return scene;
}

/// What the least model errs by on another start, against the full model by the same rule and step. Where nothing can
/// be left out: the least error of leaving anything out. Empty where the full model itself fails.
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
  return least.value_or(INFINITY);  // no model but the full one runs
}

std::string truth_text(const Truth& truth) {
  return truth.under_contact_rule ? "what the in-house contact rule converges to: a difference"
                                  : std::string(name_of(truth.tier));
}

void ladder_on(const Request&, const Scene& scene, Rows& rows) {
  Table table = ablations_table(), least = least_table();
  try {
    const ReferenceSolution y = reference_solution_of(scene, scene.tolerance);
    Trajectory seen = y.truth.trajectory;
    const size_t frames = static_cast<size_t>(y.run.samples) + 1;
    seen.t.resize(frames), seen.x.resize(frames);
    const double motion = motion_of(seen);
    const std::vector<AblatedModel> ladder = ablations_of(scene, y, 0.3 * motion);
    const double full_cost = ladder.front().cost();
    for (const AblatedModel& r : ladder)
      table.add({scene.name, r.name, fmt::format("{}", fmt::join(r.out, ", ")),
                 r.out.empty() ? "full"
                 : r.single    ? "single"
                               : "cumulative",
                 r.error ? Cell(*r.error) : Cell(), scene.tolerance, r.error && *r.error <= scene.tolerance ? 1l : 0l,
                 motion, y.truth.error_bar, truth_text(y.truth), std::string(name_of(r.outcome.verdict)),
                 r.outcome.evaluations, springs_of(r.scene.model), r.cost()});
    const double speed = 0.2 * largest_speed(y.truth.trajectory);
    const std::pair<double, const char*> tolerances[] = {{scene.tolerance, "the scene's own"},
                                                         {0.01 * motion, "1 % of its motion"},
                                                         {0.1 * motion, "10 % of its motion"}};
    std::map<std::vector<std::string>, std::vector<std::optional<double>>> unseen;  // by what is left out
    for (const auto& [tolerance, what] : tolerances) {
      const AblatedModel& l = least_model(ladder, tolerance);
      std::vector<Cell> row{scene.name,
                            tolerance,
                            std::string(what),
                            l.out.empty() ? "nothing can be left out" : l.name,
                            fmt::format("{}", fmt::join(l.out, ", ")),
                            l.error ? Cell(*l.error) : Cell()};
      bool holds = true;
      auto& errors = unseen[l.out];
      for (unsigned seed = 1; errors.size() < unseen_starts; ++seed)
        errors.push_back(unseen_error(unseen_start(scene, speed, seed), y, l.out));
      for (const auto& e : errors) {
        row.push_back(e && std::isfinite(*e) ? Cell(*e) : Cell());
        holds = holds && e && (l.out.empty() ? *e > tolerance : *e <= tolerance);
      }
      row.push_back(holds ? 1l : 0l);
      row.push_back(full_cost > 0 ? l.cost() / full_cost : 1);
      least.add(std::move(row));
    }
  } catch (const Unsupported& why) {
    rows.notes.push_back(fmt::format("adequacy leaves out {}: {}", scene.name, why.what()));
  }
  rows.add(table);
  rows.add(least);
}

void resolution_on(const Request& request, const Scene& scene, Rows& rows) {
  Table table{"adequacy-resolution",
              {{"scene", "1"},
               {"particles along a side", "1"},
               {"cells", "1"},
               {"error against the finest", "m"},
               {"sag", "m"},
               {"stiffness factor for the finest's sag", "1"},
               {"verdict", "1"},
               {"evaluations", "1"},
               {"springs", "1"},
               {"cost", "spring evaluations"}},
              {}};
  std::vector<int> sizes{8, 12, 16, 24};
  if (request.full) sizes.insert(sizes.end(), {32, 48, 64, 96, 128});
  for (const GridResult& r : grid_convergence(scene, sizes))
    table.add({scene.name, static_cast<long>(r.n), r.n - 1., r.error ? Cell(*r.error) : Cell(),
               r.sag ? Cell(*r.sag) : Cell(), r.factor ? Cell(*r.factor) : Cell(), r.verdict, r.evaluations, r.springs,
               static_cast<double>(r.evaluations) * static_cast<double>(r.springs)});
  rows.add(table);
}

void bending_on(const Request& request, Rows& rows) {
  Table table{"adequacy-bending",
              {{"particles along a line", "1"}, {"cells", "1"}, {"stiffness of bend springs", "N/m"}, {"droop", "m"}},
              {}};
  std::vector<int> sizes{8, 10, 12, 16};
  if (request.full) sizes.insert(sizes.end(), {20, 24});
  for (const Bending& b : bending_stiffness(sizes)) table.add({static_cast<long>(b.n), b.cells, b.stiffness, b.droop});
  rows.add(table);
}

}  // namespace

std::vector<Point> adequacy_points(const Request& request) {
  std::vector<Point> points;  // the longest first: side by side, none is left that others must wait for
  for (const Scene& scene : request.scenes) {
    if (!cloth_grid_of(scene) || scene.model.find<Spheres>()) continue;
    Request alone = request;
    alone.scenes = {scene};
    points.push_back({fmt::format("adequacy: grids of {}", scene.name), content_of(request, scene) + scene.source,
                      [alone = std::move(alone)](Rows& rows) { resolution_on(alone, alone.scenes[0], rows); }});
  }
  if (!points.empty() && !request.scenes_only)
    points.push_back({"adequacy: bend springs", fmt::format("full={}", request.full),
                      [request](Rows& rows) { bending_on(request, rows); }});
  for (Point& ladder : one_point_per_scene(request, "adequacy", ladder_on)) points.push_back(std::move(ladder));
  return points;
}

void conclude_adequacy(Rows& rows) {
  Table table{"adequacy-scaling",
              {{"scene", "1"}, {"quantity", "1"}, {"exponent", "1"}, {"standard error", "1"}, {"derived", "1"}},
              {}};
  const auto fit = [&](const Table& t, const std::string& scene, const char* column, const char* what, Cell derived) {
    std::vector<std::pair<double, double>> points;
    for (size_t i = 0; i < t.rows.size(); ++i) {
      if (!scene.empty() && std::get<std::string>(t.at(i, "scene")) != scene) continue;
      if (const auto* y = std::get_if<double>(&t.at(i, column)); y && *y > 0)
        points.emplace_back(std::get<double>(t.at(i, "cells")), *y);
    }
    if (const auto law = power_law(points))
      table.add({scene, std::string(what), law->exponent, law->deviation, std::move(derived)});
  };
  if (const Table* grids = rows.table("adequacy-resolution")) {
    std::vector<std::string> scenes;
    for (size_t i = 0; i < grids->rows.size(); ++i)
      if (const auto& s = std::get<std::string>(grids->at(i, "scene")); scenes.empty() || scenes.back() != s)
        scenes.push_back(s);
    for (const std::string& s : scenes) {
      fit(*grids, s, "error against the finest", "error of the motion against cells along a side", Cell());
      fit(*grids, s, "stiffness factor for the finest's sag", "stiffness of all springs for the same sag", Cell());
    }
  }
  if (const Table* bending = rows.table("adequacy-bending"))
    fit(*bending, "", "stiffness of bend springs", "stiffness of bend springs for the same droop", 4.);
  if (!table.rows.empty()) rows.add(table);
}

}  // namespace crosscheck
