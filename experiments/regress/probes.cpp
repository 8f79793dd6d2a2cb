// Quantities that take runs of their own, and those of a ball.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/metrics.h"
#include "experiments/regress/rows.h"
#include "experiments/stability/trial.h"
#include "reference/exact/exact.h"

namespace crosscheck {

std::optional<Truth> exact_truth(const Scene& scene) {
  if (!exact_solution(scene)) return std::nullopt;
  const auto truth = truth_of(scene, default_run(scene));
  return truth && truth->tier == Tier::exact ? truth : std::nullopt;
}

void rebound_height(const Seen& seen, Quantities& out) {
  const auto* spheres = seen.scene().model.find<Spheres>();
  if (!spheres ||
      std::none_of(spheres->list.begin(), spheres->list.end(), [](const auto& s) { return s.restitution > 0; }))
    return;
  bool touched = false;
  double highest = 0;
  for (int i = 0; i < seen.path().frames(); ++i) {
    const double gap = *clearance(seen.scene(), seen.path().t[i], seen.path().x[i]);
    // a step's fall above the surface counts as touching: the very touch lies between two samples
    const double fall = i > 0 ? largest_column(seen.path().x[i] - seen.path().x[i - 1]) : 0;
    touched |= i > 0 && gap < fall;
    if (touched) highest = std::max(highest, gap);
  }
  if (touched) out.push_back({"rebound height", "m", highest});
}

void leaving_angle(const Seen& seen, Quantities& out) {
  constexpr double gap = 1e-3;  // m
  const auto* spheres = seen.scene().model.find<Spheres>();
  const auto* gravity = seen.scene().model.find<Gravity>();
  const Points& start = seen.scene().start.x;
  if (!spheres || spheres->list.size() != 1 || !gravity || start.cols() != 1) return;
  if (std::abs(*clearance(seen.scene(), 0, start)) > 1e-9) return;
  for (int i = 1; i < seen.path().frames(); ++i) {
    const double before = *clearance(seen.scene(), seen.path().t[i - 1], seen.path().x[i - 1]),
                 after = *clearance(seen.scene(), seen.path().t[i], seen.path().x[i]);
    if (after < gap) continue;
    const double part = (gap - before) / (after - before), t = std::lerp(seen.path().t[i - 1], seen.path().t[i], part);
    const Vec3 place = (1 - part) * seen.path().x[i - 1].col(0) + part * seen.path().x[i].col(0);
    const Vec3 up = -gravity->acceleration.normalized(),
               out_of_ball = (place - spheres->list[0].centre_at(t)).normalized();
    out.push_back({"leaving angle", "degrees", std::acos(up.dot(out_of_ball)) * 180 / std::numbers::pi});
    return;
  }
}

void change_at_half_the_step(const Seen& seen, Quantities& out) {
  const Scene& scene = seen.scene();
  const Method& method = seen.question.method;
  if (method.adaptive || !seen.question.without.empty() || exact_solution(scene)) return;
  Run half = run_over_window(scene);
  half.step = seen.answered.outcome.step / 2;
  Recorder recorder;
  if (run_method(method, scene, half, {&recorder}).verdict != Verdict::ok) return;
  out.push_back({halving_quantity, "m", largest_rms_distance(seen.path(), recorder.trajectory, scene.window)});
}

void order_of_error(const Seen& seen, Quantities& out) {
  const Scene& scene = seen.scene();
  const Stepper* rule = seen.question.method.stepper;
  if (!rule || rule->adaptive || scene.model.find<Spheres>()) return;
  const auto truth = exact_truth(scene);
  if (!truth) return;
  const Run run = run_over_window(scene);
  Run half = run;
  half.step = seen.answered.outcome.step / 2;
  Recorder recorder;
  if (run_method(seen.question.method, scene, half, {&recorder}).verdict != Verdict::ok) return;
  const double whole = largest_rms_distance(seen.path(), truth->trajectory, scene.window),
               halved = largest_rms_distance(recorder.trajectory, truth->trajectory, scene.window);
  // 1e3 times what rounding makes of places: elsewhere no order shows
  if (!(halved > 1e-10 * std::max(1.0, scene.size()))) return;
  out.push_back({"order of the error", "1", std::log2(whole / halved)});
  // each error is known to its bar
  out.back().bar = truth->bar / halved * 2 / std::log(2.);
}

void largest_stable_step(const Seen& seen, Quantities& out) {
  constexpr double precision = 2e-3;
  const Method& method = seen.question.method;
  const Particles& particles = seen.scene().model.particles;
  const Stepper* rule = rule_of(method);
  const bool small = 3 * (particles.size() - static_cast<int>(particles.pins.size())) <= 12;
  if (!small || method.adaptive || !rule || !std::isfinite(rule->limit(1, 0.1)) || !seen.scene().model.find<Springs>())
    return;
  const Subject subject = subject_of(seen.scene());
  if (!subject.at_rest) return;
  const Measured measured = measured_limit(method, subject, 4000, {}, precision);
  if (measured.kind != Measured::found) return;
  out.push_back({"largest stable step", "s", measured.limit()});
  out.back().bar = measured.limit() * measured.precision();
}

}  // namespace crosscheck
