// Experiment `disagreements`: runs them all, measures, writes tables.
#include "experiments/disagreements/disagreements.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/disagreements.h"
#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

std::vector<DirectionError> direction_errors(const std::string& method, Scene scene,
                                             const std::vector<double>& angles) {
  Sphere& ball = scene.model.find<Spheres>()->list.at(0);
  ball.friction = 0;
  const Vec3 g = scene.model.find<Gravity>()->acceleration;
  const Method chosen = find_method(method);
  constexpr double duration = 4e-3, step = 2e-4;  // s
  constexpr double inside = 1.2e-4;               // m: a grid of 20 mm puts the surface up to a^2 / 4R = 0.1 mm too low

  std::vector<DirectionError> errors;
  for (const double angle : angles) {
    const Vec3 normal(std::sin(angle), std::cos(angle), 0), down(std::cos(angle), -std::sin(angle), 0);
    scene.start.x.col(0) = ball.centre + (ball.contact_radius() - inside) * normal;
    scene.start.v.setZero();
    auto pushed = [&](double h) {
      Recorder recorder;
      const Outcome out = run_method(chosen, scene, {h, duration, 1}, {&recorder});
      if (out.verdict != Verdict::ok) throw std::runtime_error(method + ": " + out.reason);
      const Vec3 impulse = recorder.trajectory.v.back().col(0) - g * duration;
      return Vec3(std::atan2(impulse.dot(down), impulse.dot(normal)), std::atan2(impulse.z(), impulse.dot(normal)), 0);
    };
    const Vec3 found = 2 * pushed(step / 2) - pushed(step);
    errors.push_back({angle, found[0], found[1]});
  }
  return errors;
}

Scene scene_of(const Disagreement& disagreement) { return read_scene(file_of_disagreement(disagreement.name)); }

std::vector<Series> run_variants(const Disagreement& disagreement, const Scene& scene) {
  std::vector<Series> all;
  Trajectory first;
  for (const Variant& variant : disagreement.variants) {
    Scene own = scene;
    if (auto* springs = own.model.find<Springs>()) springs->law = variant.law;
    Run run = default_run(own);
    if (variant.step > 0) run.step = variant.step;
    Recorder recorder;
    Series series{variant, run_method(find_method(variant.method), own, run, {&recorder}), {}};
    const Trajectory& path = recorder.trajectory;
    if (all.empty()) first = path;
    for (int i = 0; i < path.frames() && i < first.frames(); ++i)
      series.points.emplace_back(path.t[i], disagreement.value
                                                ? disagreement.value(own, {path.t[i], path.x[i], path.v[i]})
                                                : largest_column(path.x[i] - first.x[i]));
    all.push_back(std::move(series));
  }
  return all;
}

std::vector<Point> disagreements_points(const Request& request) {
  if (request.scenes_only) return {};
  std::vector<Point> points;
  for (const Disagreement& d : disagreements())
    points.push_back({"disagreement: " + d.name, scene_of(d).hash, [d](TableSet& tables) {
                        const Scene scene = scene_of(d);
                        const std::vector<Series> all = run_variants(d, scene);
                        Table table = table_of<DisagreementCurveRow>(d.name + "-disagreement");
                        table.columns.back() = {d.quantity, d.unit};
                        for (const Series& s : all)
                          for (const auto& [t, value] : s.points)
                            add(table, DisagreementCurveRow{s.variant.label, s.variant.method, s.outcome.step,
                                                            s.outcome.verdict, t, value});
                        Table summary = table_of<DisagreementRow>();
                        std::string effect = d.effect(all);
                        if (d.measured) {
                          const TableWithSentence more = d.measured(d);
                          tables.add(more.table);
                          effect += " " + more.sentence;
                        }
                        add(summary, DisagreementRow{d.name, d.world, d.what, d.cause, effect, scene.hash});
                        tables.add(table);
                        tables.add(summary);
                      }});
  return points;
}

}  // namespace crosscheck
