// Cells and limits of maps.
#include "experiments/stability/map.h"

#include <cmath>

namespace crosscheck {
namespace {

Scene with_stiffness(Scene scene, double factor) {
  if (auto* springs = scene.model.find<Springs>())
    for (Spring& s : springs->list) s.k *= factor;
  return scene;
}

Scene with_gamma(Scene scene, double gamma) {
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  scene.model.terms.emplace_back(Drag{gamma * scene.model.particles.mass});
  return scene;
}

/// Cells show blow-ups as they are: kicked by a ten-thousandth of the springs' length, so that growth comes to where
/// energy and finiteness judge it, and yet far below the stretch at rest, beside whose energy the swinging energy of
/// neutral rules at long steps must stay small.
constexpr double visible = 1e-4;

/// That kick, or a smaller one whose energy is a thousandth of what the springs hold at rest.
double kick_for(const Subject& subject, int mode) {
  const Model& model = subject.scene.model;
  const Energy rest = energy_of(model, subject.scene.start),
               moved = energy_of(model, kicked(subject, {mode, visible}).start);
  const double given = moved.total() - rest.total();
  return rest.elastic > 0 && given > 0 ? visible * std::min(1.0, std::sqrt(1e-3 * rest.elastic / given)) : visible;
}

}  // namespace

std::span<const MapKind> map_kinds() {
  static constexpr MapKind table[] = {
      {"stiffness", "1", [](double part, double) { return std::pow(10, 4 * part - 2); }, with_stiffness},
      {"drag", "1/s", [](double part, double omega) { return omega * std::pow(10, 3 * part - 2); }, with_gamma},
  };
  return table;
}

void map_on(const MapKind& kind, const Scene& scene, const Method& method, const MapSize& size, Rows& rows) {
  Table cells{"stability-map",
              {{"scene", "1"},
               {"method", "1"},
               {"map", "1"},
               {"value", "see map"},
               {"step", "s"},
               {"verdict", "1"},
               {"end", "s"},
               {"growth", "1"}},
              {}};
  Table limits{"stability-map-limit",
               {{"scene", "1"},
                {"method", "1"},
                {"map", "1"},
                {"value", "see map"},
                {"predicted limit", "s"},
                {"held", "s"},
                {"failed", "s"}},
               {}};
  Table check{"stability-map-check",
              {{"scene", "1"}, {"method", "1"}, {"map", "1"}, {"steps", "1"}, {"cells", "1"}, {"changed", "1"}},
              {}};
  const std::string map(kind.name);
  const double omega = subject_of(scene).spectrum.omega;
  if (!(omega > 0)) return;
  long changed = 0, all = 0;
  for (int r = 0; r < size.rows; ++r) {
    const double value = kind.value(static_cast<double>(r) / (size.rows - 1), omega);
    const Subject subject = subject_of(kind.with(scene, value));
    const Stepper* rule = rule_of(method);
    Prediction predicted{0, -1, "no rule"};
    if (rule) predicted = predicted_limit(*rule, subject.spectrum);
    const Kick kick{predicted.mode, kick_for(subject, predicted.mode)};
    double held = 0, failed = 0;  // the last cell that held before the first that failed
    for (int c = 0; c < size.columns; ++c) {
      // h omega from 1/50 to 20 of the scene as it is
      const double h = 0.02 / omega * std::pow(1000, static_cast<double>(c) / (size.columns - 1));
      const Trial trial = try_step(method, subject, h, size.steps, kick);
      if (trial.unsupported()) return;
      cells.add({scene.name, method.name, map, value, h, std::string(name_of(trial.fate())), trial.end,
                 std::isfinite(trial.growth) ? Cell(trial.growth) : Cell()});
      if (failed == 0) (trial.held() ? held : failed) = h;
      if (size.check) {
        ++all;
        changed += try_step(method, subject, h, 10 * size.steps, kick).held() != trial.held();
      }
    }
    if (held > 0 && failed > 0)
      for (int i = 0; i < 5; ++i) {
        const double middle = std::sqrt(held * failed);
        (try_step(method, subject, middle, size.steps, kick).held() ? held : failed) = middle;
      }
    const bool finite = predicted.missing.empty() && std::isfinite(predicted.limit);
    limits.add({scene.name, method.name, map, value, finite ? Cell(predicted.limit) : Cell(),
                held > 0 ? Cell(held) : Cell(), failed > 0 ? Cell(failed) : Cell()});
  }
  rows.add(cells);
  rows.add(limits);
  if (size.check) {
    check.add({scene.name, method.name, map, size.steps, all, changed});
    rows.add(check);
  }
}

}  // namespace crosscheck
