// Experiment `stability`: the largest stable step of every method on every scene, measured and predicted; growth rates
// where no step is stable; and maps of what becomes of a run.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "experiments/estimate.h"
#include "experiments/experiment.h"
#include "experiments/stability/map.h"

namespace crosscheck {
namespace {

std::string text_of(Measured::Kind kind) {
  switch (kind) {
    case Measured::found:
      return "limit";
    case Measured::no_step:
      return "no stable step";
    case Measured::every_step:
      return "every step tried";
    default:
      return "unsupported";
  }
}

std::string text_of(const Prediction& p) {
  if (!p.missing.empty()) return "none";
  return p.limit == 0 ? "no stable step" : std::isinf(p.limit) ? "every step" : "limit";
}

/// Why theory, which looks at small motion about one state, may say something else than the run.
std::string why_apart(const Subject& subject, const Method& method) {
  const Model& model = subject.scene.model;
  std::vector<std::string> reasons;
  if (model.find<Spheres>()) reasons.emplace_back("contact");
  if (model.particles.move) reasons.emplace_back("moved pins");
  if (!subject.at_rest) reasons.emplace_back("the motion stretches and turns the springs of the start");
  if (model.find<Aerodynamics>()) reasons.emplace_back("air damps too");
  if (method.name.starts_with("bullet"))
    reasons.emplace_back("Bullet clamps speeds to the body's diagonal over the step");
  if (reasons.empty()) reasons.emplace_back("nonlinearity of the springs");
  std::string all;
  for (const std::string& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return all;
}

struct Effort {
  long steps;
  double precision;
};
/// CPU time of so many steps near the limit, s.
double seconds_of(const Method& method, const Scene& scene, long steps) {
  return estimated_seconds(method, scene, {scene.step, scene.step * static_cast<double>(steps), 1});
}

Effort effort_for(const Method& method, const Scene& scene, bool full) {
  if (full) {
    // a bisection takes about 25 runs: as long as 5 s pay for
    const long steps = std::lround(5. / 25 / seconds_of(method, scene, 1));
    if (steps < 500) return {100, 0.5};
    return {std::min(20000L, steps), steps < 4000 ? 0.005 : 0.001};
  }
  const bool small = scene.start.x.cols() <= 50, theirs = !method.stepper;
  const Stepper* rule = rule_of(method);
  // who is stable at every step solves an equation in each, and is asked coarsely whether it is so
  if (!small && (!rule || std::isinf(rule->limit(1, 0)))) return {100, 0.5};
  return theirs && !small ? Effort{1000, 0.01} : Effort{4000, 0.002};
}

/// Growth per step of the binding mode around the limit, or at a few steps where none is stable: the excess is tiny
/// beside the step's own factor, and runs to a blow-up would take millions of steps.
void add_growth(const Method& method, const Stepper& rule, const Subject& subject, const Prediction& predicted,
                Rows& rows) {
  const Spectrum& s = subject.spectrum;
  if (!subject.at_rest || !s.commuting || s.shapes.cols() == 0 || !is_runge_kutta(rule)) return;
  const int mode = predicted.mode >= 0 ? predicted.mode : static_cast<int>(s.modes.size()) - 1;
  const Vibration& vibration = s.modes[mode];
  Table table{"stability-growth",
              {{"scene", "1"},
               {"method", "1"},
               {"omega", "rad/s"},
               {"gamma", "1/s"},
               {"step", "s"},
               {"h omega", "1"},
               {"share of limit", "1"},
               {"predicted growth", "1"},
               {"measured growth", "1"},
               {"deviation", "1"}},
              {}};
  std::vector<double> steps;
  for (const double z : {0.1, 0.2, 0.5})
    if (predicted.limit == 0) steps.push_back(z / vibration.omega);
  for (const double part : {0.9, 0.98, 1.02, 1.1})
    if (predicted.limit > 0) steps.push_back(part * predicted.limit);
  for (const double h : steps) {
    const double expected = growth_per_step(rule, vibration, h);
    if (expected == 1) continue;
    // as many steps as change the amplitude tenfold, but enough to average over rounding and few enough to pay for
    const long count = std::clamp(std::lround(2.3 / std::abs(std::log(expected))), 100L, 2000L);
    const Trial trial = try_step(method, subject, h, count, {mode});
    if (!trial.of_mode) continue;
    table.add({subject.scene.name, method.name, vibration.omega, vibration.gamma, h, h * vibration.omega,
               predicted.limit > 0 ? Cell(h / predicted.limit) : Cell(), expected - 1, trial.per_step - 1,
               (trial.per_step - 1) / (expected - 1) - 1});
  }
  rows.add(table);
}

void limit_on(const Scene& scene, const Method& method, bool full, Rows& rows) {
  Table table{"stability",
              {{"scene", "1"},
               {"method", "1"},
               {"state", "1"},
               {"prediction", "1"},
               {"predicted limit", "s"},
               {"binding omega", "rad/s"},
               {"binding gamma", "1/s"},
               {"measurement", "1"},
               {"measured limit", "s"},
               {"held", "s"},
               {"failed", "s"},
               {"deviation", "1"},
               {"verdict above", "1"},
               {"steps", "1"},
               {"reason", "1"}},
              {}};
  const Subject subject = subject_of(scene);
  const Spectrum& s = subject.spectrum;
  const Stepper* rule = rule_of(method);
  Prediction predicted{0, -1, "no linear theory: a rule of its own"};
  if (rule) predicted = predicted_limit(*rule, s);
  const bool finite = predicted.missing.empty() && std::isfinite(predicted.limit);
  const Effort effort = effort_for(method, scene, full);
  const Kick kick{predicted.mode};
  const Measured measured = measured_limit(method, subject, effort.steps, kick, effort.precision);
  Cell deviation, above;
  std::string reason = measured.reason;
  if (measured.kind == Measured::found) {
    // a twentieth above, kicked so that it is seen
    above =
        std::string(name_of(try_step(method, subject, 1.05 * measured.failed, effort.steps, {kick.mode, 1e-3}).fate()));
    if (finite && predicted.limit > 0) {
      deviation = measured.limit() / predicted.limit - 1;
      if (std::abs(std::get<double>(deviation)) > 0.01) reason = why_apart(subject, method);
    } else {
      reason = predicted.missing.empty() ? why_apart(subject, method) : predicted.missing;
    }
  } else if (measured.kind == Measured::no_step && !(finite && predicted.limit == 0)) {
    reason = predicted.missing.empty() ? why_apart(subject, method) : predicted.missing;
  } else if (measured.kind == Measured::every_step && finite) {
    reason = why_apart(subject, method);
  }
  const bool binds = predicted.mode >= 0 && finite;
  table.add({scene.name, method.name, std::string(subject.at_rest ? "rest" : "start"), text_of(predicted),
             finite ? Cell(predicted.limit) : Cell(), binds ? Cell(s.modes[predicted.mode].omega) : Cell(),
             binds ? Cell(s.modes[predicted.mode].gamma) : Cell(), text_of(measured.kind),
             measured.kind == Measured::found ? Cell(measured.limit()) : Cell(),
             measured.held > 0 ? Cell(measured.held) : Cell(), measured.failed > 0 ? Cell(measured.failed) : Cell(),
             deviation, above, effort.steps, reason});
  rows.add(table);
  if (rule && measured.kind != Measured::unsupported) add_growth(method, *rule, subject, predicted, rows);
}

/// Why a method is not asked, or nothing.
std::string why_not(const Method& method) {
  if (method.name.starts_with("truth/")) return "truth takes no steps";
  if (method.adaptive) return "steps that follow a tolerance";
  if (method.name.ends_with("+sticky")) return "its contact rule changes no limit";
  return "";
}

/// Nothing where the map would cost more than 10 s of CPU time.
std::optional<MapSize> map_size(const Method& method, const Scene& scene, bool full) {
  const bool small = scene.start.x.cols() <= 10;
  if (!full && method.stepper) return MapSize{9, 12, 1000, small};
  if (!full) return small ? MapSize{9, 12, 300, false} : MapSize{7, 9, 300, false};
  for (MapSize size : {MapSize{17, 25, 1000, false}, MapSize{9, 12, 1000, false}, MapSize{7, 9, 300, false}}) {
    const double cost = seconds_of(method, scene, size.steps * size.rows * size.columns);
    size.check = cost < 1;  // tenfold
    if (cost < 10) return size;
  }
  return std::nullopt;
}

/// The methods whose maps are drawn: the explicit rules that differ, and Bullet's worlds.
bool mapped(const Request& request, const Method& method) {
  if (!request.methods.empty() || request.full) return true;
  for (const char* name : {"mysim/explicit-euler", "mysim/rk4", "mysim/symplectic-euler", "bullet/deformable-explicit",
                           "bullet/deformable-implicit", "bullet/pbd"})
    if (method.name == name) return true;
  return false;
}

}  // namespace

std::vector<Point> stability_points(const Request& request) {
  std::vector<Point> points;
  for (const Scene& scene : request.scenes) {
    const auto small = map_scene(scene, request.full);
    for (const Method& method : methods_of(request, scene)) {
      const std::string name = fmt::format("{} on {}", method.name, scene.name);
      if (const std::string why = why_not(method); !why.empty()) {
        points.push_back({"stability: " + name, "", [=](Rows& rows) {
                            rows.notes.push_back(fmt::format("stability leaves out {}: {}", method.name, why));
                          }});
        continue;
      }
      const Stepper* rule = rule_of(method);
      Request alone = request;
      alone.methods = {method};
      if (request.methods.empty() && !request.full && scene.start.x.cols() > 50 &&
          (!rule || std::isinf(rule->limit(1, 0)))) {
        points.push_back(
            {"stability: " + name, "", [name](Rows& rows) {
               rows.notes.push_back(fmt::format(
                   "stability leaves out {}: no linear limit, and every run costs much; --full has it", name));
             }});
      } else {
        points.push_back({"stability: " + name, content_of(alone, scene),
                          [=, full = request.full](Rows& rows) { limit_on(scene, method, full, rows); }});
      }
      if (!small || !mapped(request, method) || scene.model.first_order()) continue;
      const auto size = map_size(method, *small, request.full);
      if (!size) {
        points.push_back({"stability: maps, " + name, "", [name](Rows& rows) {
                            rows.notes.push_back(fmt::format("stability draws no map of {}: its runs cost much", name));
                          }});
        continue;
      }
      const std::string content = content_of(alone, *small);
      for (const MapKind& kind : map_kinds())
        points.push_back({fmt::format("stability: map of step and {}, {}", kind.name, name), content,
                          [=, &kind](Rows& rows) { map_on(kind, *small, method, *size, rows); }});
    }
    if (!small && scene.model.find<Springs>())
      points.push_back({"stability: maps of " + scene.name, "", [name = scene.name](Rows& rows) {
                          rows.notes.push_back(fmt::format(
                              "stability draws no map of {}: its hundreds of runs cost much; --full has them", name));
                        }});
  }
  return points;
}

std::optional<Scene> map_scene(const Scene& scene, bool full) {
  if (!scene.model.find<Springs>()) return std::nullopt;
  if (scene.name == "cloth-hang")
    return read_scene(std::filesystem::path(CROSSCHECK_SCENES) / "stability/cloth-hang-6.toml");
  if (scene.start.x.cols() <= 64 || full) return scene;
  return std::nullopt;
}

}  // namespace crosscheck
