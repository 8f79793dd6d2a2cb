#include "experiments/adequacy/ablation.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mysim/base/errors.h"
#include "mysim/base/random.h"
#include "mysim/model/system.h"
#include "mysim/run/observers.h"

namespace crosscheck {
namespace {

/// Cheapest method that supports the scene without changes and has an observable order.
std::string rule_for(const Scene& scene) {
  if (scene.model.find<Constraints>()) return "mysim/xpbd";
  return scene.model.first_order() ? "mysim/rk4" : "mysim/leapfrog";
}

Run run_until(const Scene& scene, double until, double step) {
  Run run = default_run(scene);
  const double interval = scene.duration / scene.samples;
  run.samples = std::clamp(static_cast<int>(std::floor(until / interval * (1 + 1e-9))), 1, scene.samples);
  run.duration = run.samples * interval;
  run.step = std::min(step, interval);
  run.timed = false;
  return run;
}

double first_step(const Scene& scene) {
  if (scene.model.first_order() || scene.model.find<Constraints>()) return scene.step;
  const double omega = highest_frequency(scene.model, scene.start);
  return omega > 0 ? std::min(scene.step, 1.4 / omega) : scene.step;  // 0.7 of leapfrog's limit
}

std::string name_without(const std::vector<std::string>& out) {
  return out.empty() ? "full" : fmt::format("without {}", fmt::join(out, ", "));
}

}  // namespace

std::optional<double> model_error(const Scene& model, const ReferenceSolution& y, const Trajectory& truth,
                                  Outcome& outcome) {
  Recorder recorder;
  if (model.start.v.cols() == 0 && !model.model.first_order()) {  // its only term was removed: nothing moves
    outcome = {};
    double largest = 0;
    for (int i = 0; i < truth.frames() && truth.t[i] <= y.run.duration * (1 + 1e-9); ++i)
      largest = std::max(largest, rms_distance(truth.x[i], model.start.x));
    return largest;
  }
  outcome = run_method(y.method, model, y.run, {&recorder});
  if (outcome.verdict != Verdict::ok) return std::nullopt;
  return largest_rms_distance(recorder.trajectory, truth, y.run.duration);
}

ReferenceSolution reference_solution_of(const Scene& scene, double tolerance) {
  auto truth = truth_of(scene, default_run(scene));
  if (!truth) throw Unsupported("no reference solution is known for it");
  ReferenceSolution y{find_method(rule_for(scene)), {}, std::move(*truth), 0};
  const double until = std::min(scene.window, y.truth.until);
  constexpr int most_halvings = 7;
  double step = first_step(scene);
  for (int i = 0; i <= most_halvings; ++i, step /= 2) {
    y.run = run_until(scene, until, step);
    Outcome out;
    const auto error = model_error(scene, y, y.truth.trajectory, out);
    if (!error) continue;
    y.floor = *error;
    if (y.floor <= tolerance / 5) return y;
  }
  throw Unsupported(fmt::format("the error of {} exceeds a fifth of {:.2g} m even at a step of {:.2g} s", y.method.name,
                                tolerance, 2 * step));
}

std::vector<AblatedModel> ablations_of(const Scene& scene, const ReferenceSolution& y, double most) {
  std::vector<AblatedModel> models;
  const auto ablated = [&](const Scene& scene_of_model, std::vector<std::string> out, bool single) {
    AblatedModel model{name_without(out), std::move(out), single, scene_of_model, {}, {}};
    model.error = model_error(scene_of_model, y, y.truth.trajectory, model.outcome);
    return model;
  };
  models.push_back(ablated(scene, {}, false));
  AblatedModel now = models.front();
  for (bool first = true;; first = false) {
    std::optional<AblatedModel> best;
    for (const Ingredient& ingredient : ingredients_of(now.scene)) {
      std::vector<std::string> out = now.out;
      out.push_back(ingredient.name);
      AblatedModel next = ablated(without(now.scene, ingredient), std::move(out), first);
      if (first) models.push_back(next);
      if (next.error && (!best || *next.error < *best->error)) best = std::move(next);
    }
    if (!best) break;
    if (!first) models.push_back(*best);
    if (*best->error > most) break;
    now = std::move(*best);
  }
  return models;
}

const AblatedModel& least_model(const std::vector<AblatedModel>& models, double tolerance) {
  const AblatedModel* least = &models.front();
  for (const AblatedModel& model : models) {
    if (!model.error || *model.error > tolerance) continue;
    const size_t left_out = model.out.size(), most = least->out.size();
    if (left_out > most || (left_out == most && *model.error < *least->error)) least = &model;
  }
  return *least;
}

Scene unseen_start(const Scene& scene, double speed, unsigned seed) {
  Scene other = scene;
  std::mt19937_64 engine(seed);
  const auto part = [&] { return 2 * uniform(engine) - 1; };
  const auto direction = [&] {
    Vec3 v;
    do
      for (double& p : v) p = part();
    while (v.norm() > 1 || v.norm() < 0.1);
    return Vec3(v.normalized());
  };
  const Vec3 along = direction(), wave = 2 * std::numbers::pi / scene.size() * direction();
  const double phase = std::numbers::pi * part();
  State& s = other.start;
  Points field = Points::Zero(3, s.x.cols());
  const Particles& particles = scene.model.particles;
  for (int i = 0; i < s.x.cols(); ++i) {
    if (particles.pinned[i]) continue;
    double from_pin = scene.size();
    for (const int pin : particles.pins) from_pin = std::min(from_pin, (s.x.col(i) - s.x.col(pin)).norm());
    field.col(i) = from_pin / scene.size() * std::cos(wave.dot(s.x.col(i)) + phase) * along;
  }
  if (scene.model.first_order()) {
    for (int i = 0; i < s.x.cols(); ++i) s.x.col(i) += 0.1 * s.x.col(i).norm() * along;
  } else if (const double rms = field.norm() / std::sqrt(static_cast<double>(field.cols())); rms > 0) {
    s.v += speed / rms * field;
  }
  other.hash = hash_of(other);
  return other;
}

}  // namespace crosscheck
