#include "experiments/stability/map.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/estimate.h"
#include "experiments/observers.h"
#include "experiments/scenes/cloths.h"
#include "experiments/tables/stability.h"
#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

Scene with_gamma(Scene scene, double gamma) {
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  scene.model.terms.emplace_back(Drag{gamma * scene.model.particles.mass});
  return scene;
}

/// Size of the perturbation relative to the springs' length. Cells show actual blow-ups: the perturbation grows until
/// the monitor detects it.
constexpr double visible = 1e-4;

/// Step of a column at relative position 0 <= part <= 1: h omega ranges from 1/50 to 20, with omega of the original
/// scene.
double step_at(double part, double omega) { return 0.02 / omega * std::pow(1000, part); }

}  // namespace

std::span<const MapKind> map_kinds() {
  static constexpr MapKind table[] = {
      {"stiffness", [](double part, double) { return std::pow(10, 4 * part - 2); }, with_stiffness},
      {"drag", [](double part, double omega) { return omega * std::pow(10, 3 * part - 2); }, with_gamma},
  };
  return table;
}

void add_map(const MapKind& kind, const Scene& scene, const Method& method, const MapSize& size, TableSet& tables,
             const RunCallback& on_runs) {
  Table cells = table_of<MapRow>(), limits = table_of<MapLimitRow>(), check = table_of<MapCheckRow>();
  const std::string map(kind.name);
  const BaseState as_it_is = base_state_of(scene);
  const double omega = as_it_is.spectrum.omega;
  if (!(omega > 0)) return;
  const auto no_map = [&](const std::string& why) {
    tables.notes.push_back(fmt::format("stability draws no map of step and {} for {} on {}: no cell has a result: {}",
                                       kind.name, method.name, scene.name, why));
  };
  // If the method does not support an ingredient, it would refuse every cell, so it is tried first, with a single step
  // of the shortest length.
  if (const PerturbedRun first = run_perturbed(method, as_it_is, step_at(0, omega), 1, {}); first.without_answer())
    return no_map(first.reason);
  long changed = 0, accepted = 0;
  std::string refusal;
  RecordedRuns recorded{map + "-map", scene, method.name, {}};
  for (int r = 0; r < size.rows; ++r) {
    const double value = kind.value(static_cast<double>(r) / (size.rows - 1), omega);
    const BaseState base = base_state_of(kind.with(scene, value));
    const PredictedLimit predicted = predicted_limit(method, base.spectrum);
    const Perturbation perturbation{predicted.mode, visible};
    double held = 0, failed = 0;  // s, longest step that held below the first step that failed, and that step
    for (int c = 0; c < size.columns; ++c) {
      const double h = step_at(static_cast<double>(c) / (size.columns - 1), omega);
      LastFrames pictures(base.spectrum.omega, h);
      const PerturbedRun trial = run_perturbed(method, base, h, size.steps, perturbation,
                                               on_runs ? std::vector<Observer*>{&pictures} : std::vector<Observer*>{});
      const bool refused = trial.without_answer();
      if (on_runs)
        recorded.runs.push_back({{.verdict = trial.verdict, .end = trial.end}, pictures.path(), base.scene.start.x});
      MapRow cell{scene.name, method.name, map, value, h, trial.effective_verdict(), {}, {}};
      if (!refused) cell.end = trial.end;
      if (!refused && std::isfinite(trial.growth)) cell.growth = trial.growth;
      add(cells, cell);
      if (refused) {
        refusal = trial.reason;
        continue;
      }
      ++accepted;
      if (failed == 0) (trial.held() ? held : failed) = h;
      if (size.check) changed += run_perturbed(method, base, h, 10 * size.steps, perturbation).held() != trial.held();
    }
    for (int i = 0; i < 5 && held > 0 && failed > 0; ++i) {
      const double middle = std::sqrt(held * failed);
      const PerturbedRun trial = run_perturbed(method, base, middle, size.steps, perturbation);
      if (trial.without_answer()) break;
      (trial.held() ? held : failed) = middle;
    }
    MapLimitRow limit{scene.name, method.name, map, value, {}, {}, {}};
    if (predicted.missing.empty() && std::isfinite(predicted.limit)) limit.predicted = predicted.limit;
    if (held > 0) limit.held = held;
    if (failed > 0) limit.failed = failed;
    add(limits, limit);
  }
  if (accepted == 0) return no_map(refusal);
  if (on_runs) on_runs(recorded);
  tables.add(cells);
  tables.add(limits);
  if (size.check) {
    add(check, MapCheckRow{scene.name, method.name, map, size.steps, accepted, changed});
    tables.add(check);
  }
}

std::optional<MapSize> map_size(const Method& method, const Scene& scene, bool full) {
  const bool few = scene.start.x.cols() <= 10;
  if (!full && method.stepper) return MapSize{9, 12, 1000, few};
  if (!full) return few ? MapSize{9, 12, 300, false} : MapSize{7, 9, 300, false};
  for (MapSize size : {MapSize{17, 25, 1000, false}, MapSize{9, 12, 1000, false}, MapSize{7, 9, 300, false}}) {
    const double cost = estimated_seconds(method, scene, size.steps * size.rows * size.columns);
    size.check = cost < 0.1;  // the check takes ten times as long, and tiny scenes cost more than estimated
    if (cost < 4) return size;
  }
  return std::nullopt;
}

std::optional<Scene> map_scene(const Scene& scene, bool full) {
  if (!scene.model.find<Springs>()) return std::nullopt;
  if (scene.start.x.cols() <= 64) return scene;
  if (cloth_grid_of(scene)) {
    try {
      Scene small = with_resolution(scene, 6);
      small.name += "-6";
      return small;
    } catch (const InputError&) {
      // the scene's text is valid for its own grid only
    }
  }
  return full ? std::optional(scene) : std::nullopt;
}

}  // namespace crosscheck
