#include "experiments/advise/dense_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/advise/advice.h"
#include "mysim/model/system.h"

namespace crosscheck {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double samples_per_period = 8;
constexpr double most_numbers = 6e7;  // samples times coordinates; the two solutions of a truth of this size take 2 GB

double fastest_gust(const WindSignal& wind_signal) {
  double omega = 0;
  if (wind_signal.gusts)
    for (const Gust* gust : {&wind_signal.gusts->along, &wind_signal.gusts->across})
      for (const Gust::Wave& wave : gust->waves) omega = std::max(omega, wave.omega);
  return omega;
}

/// Initial spacing of the dense samples, s. If nothing vibrates: the scene's step or its sampling interval.
double first_spacing(const Scene& scene) {
  const double interval = scene.duration / scene.samples, omega = fastest_motion(scene);
  const bool resolved_by_step = scene.model.first_order() || scene.model.find<Constraints>();
  const double own = resolved_by_step ? std::min(interval, scene.step) : interval;
  return omega > 0 ? std::min(own, turn / omega / samples_per_period) : own;
}

/// Number of dense samples per sample of the scene. Throws CannotGuarantee if they do not fit in memory.
int samples_at(const Scene& scene, double spacing) {
  const double samples = std::ceil(scene.duration / scene.samples / spacing * (1 - 1e-9));
  const double all = samples * scene.samples * static_cast<double>(scene.start.x.size());
  if (!(all <= most_numbers))
    throw CannotGuarantee(
        fmt::format("to resolve the motion between samples, the reference solution of {} would be needed at {:.3g} "
                    "times of {:.3g} numbers each; shorten its duration",
                    scene.name, samples * scene.samples, static_cast<double>(scene.start.x.size())));
  return std::max(1, static_cast<int>(samples));
}

Truth dense_truth_of(const Scene& dense) {
  auto truth = truth_of(dense, default_run(dense));
  if (!truth) throw CannotGuarantee("no reference solution is known for the scene, so no advice can be guaranteed");
  return std::move(*truth);
}

}  // namespace

double fastest_motion(const Scene& scene) {
  const Model& model = scene.model;
  double omega = model.first_order() ? 0 : highest_frequency(model, scene.start);
  if (model.particles.move) omega = std::max(omega, turn * model.particles.move->frequency);
  if (const auto* spheres = model.find<Spheres>())
    for (const Sphere& sphere : spheres->list)
      if (sphere.motion) omega = std::max(omega, turn * sphere.motion->frequency);
  if (const auto* wind = model.find<Wind>()) omega = std::max(omega, fastest_gust(wind->acceleration));
  if (const auto* air = model.find<Aerodynamics>()) omega = std::max(omega, fastest_gust(air->velocity));
  return omega;
}

DenseTruth::DenseTruth(const Scene& scene, double tolerance) : dense_(scene), exact_(exact_solution(scene)) {
  double spacing = first_spacing(scene);
  constexpr int most_doublings = 8;
  for (int i = 0;; ++i, spacing /= 2) {
    dense_.samples = scene.samples * samples_at(scene, spacing);
    truth_ = dense_truth_of(dense_);
    measure();
    if (exact_) break;
    const double lost = interpolation_error();
    bar_ += lost;
    if (lost <= tolerance / 30) break;
    // the error falls as the square of the spacing where forces jump at a contact, and as its fourth power elsewhere
    if (has_contact(scene.model))
      for (double left = lost / 4; left > tolerance / 30 && i + 1 < most_doublings; left /= 4, ++i) spacing /= 2;
    if (i == most_doublings && bar_ <= tolerance / 3) break;  // accurate enough for advice
    if (i == most_doublings)
      throw CannotGuarantee(
          fmt::format("between samples the reference solution is known to {:.2g} m only, but {:.2g} m is requested",
                      bar_, tolerance));
  }
  const double omega = fastest_motion(scene);
  time_resolution_ = omega > 0 ? 1 / (16 * omega) : scene.duration / dense_.samples / 8;
}

void DenseTruth::measure() {
  until_ = std::min({dense_.window, dense_.duration, truth_.until});
  bar_ = motion_ = 0;
  const Trajectory& path = truth_.trajectory;
  for (int i = 0; i < path.frames() && path.t[i] <= until_ * (1 + 1e-9); ++i) {
    bar_ = std::max(bar_, truth_.error_bars.empty() ? truth_.error_bar : truth_.error_bars[i]);
    motion_ = std::max(motion_, rms_distance(path.x[i], path.x[0]));
  }
  impact_.assign(path.t.size(), false);
  for (int i = 0; has_contact(dense_.model) && i + 1 < path.frames(); ++i) {
    const Points end = free_path(i, path.t[i + 1]);
    for (int k = 0; k < end.cols(); ++k)
      if (runs_in(path.t[i], path.x[i].col(k), path.t[i + 1], end.col(k))) impact_[i] = true;
  }
}

/// The path from a sample to time t with constant acceleration, ignoring surfaces.
Points DenseTruth::free_path(int sample, double t) const {
  const Trajectory& path = truth_.trajectory;
  const double s = t - path.t[sample];
  State state{path.t[sample], path.x[sample], path.v[sample]};
  Points a(3, state.x.cols());
  System(dense_.model).acceleration(state, a);
  return state.x + s * state.v + s * s / 2 * a;
}

/// Cubic interpolation between two samples, using the velocities at both (Hermite); linear in a first-order scene,
/// which has no velocities. A particle that enters a solid on its free path follows this path up to the impact, and
/// then the free path traced back from the later sample, so that nothing is interpolated across the impact.
Points DenseTruth::interpolated(int from, int to, double t) const {
  const Trajectory& path = truth_.trajectory;
  const double span = path.t[to] - path.t[from], s = (t - path.t[from]) / span;
  const Points &a = path.x[from], &b = path.x[to];
  if (path.v[from].cols() == 0) return a + s * (b - a);
  const double left = 1 - s;
  Points x = left * left * (1 + 2 * s) * a + s * s * (3 - 2 * s) * b +
             span * s * left * (left * path.v[from] - s * path.v[to]);
  if (std::none_of(impact_.begin() + from, impact_.begin() + to, [](char impact) { return impact; })) return x;
  const std::vector<Surface> surfaces = surfaces_of(dense_.model);
  const Points before = free_path(from, t), after = free_path(to, t), beyond = free_path(from, path.t[to]);
  for (int i = 0; i < x.cols(); ++i) {
    if (!runs_in(path.t[from], a.col(i), path.t[to], beyond.col(i))) continue;
    x.col(i) = before.col(i);
    if (clearance_from(surfaces, t, x.col(i)) > 0) continue;
    x.col(i) = after.col(i);
    for (const Surface& surface : surfaces) {
      const Vec3 origin = surface.origin_at(t), d = x.col(i) - origin;
      if (surface.gap(d) < 0) x.col(i) = surface.put_on(origin, x.col(i), surface.normal(d));
    }
  }
  return x;
}

/// True if a path starts outside all solids, by more than rounding error, and ends in one of them.
bool DenseTruth::runs_in(double t, const Vec3& x, double t_end, const Vec3& end) const {
  const std::vector<Surface> surfaces = surfaces_of(dense_.model);
  return clearance_from(surfaces, t, x) > 1e-9 * dense_.size() && clearance_from(surfaces, t_end, end) < 0;
}

/// Interpolation error, m, estimated at twice the spacing. There, the error of a smooth path is 16 times as large; 8 is
/// assumed. With contact, forces can jump anywhere between two samples, and the midpoint may show only half the error.
double DenseTruth::interpolation_error() const {
  const Trajectory& path = truth_.trajectory;
  double most = 0;
  for (int i = 1; i + 1 < path.frames() && path.t[i + 1] <= until_ * (1 + 1e-9); ++i)
    most = std::max(most, rms_distance(interpolated(i - 1, i + 1, path.t[i]), path.x[i]));
  const bool smooth = !has_contact(dense_.model) && path.v.front().cols() > 0;
  return smooth ? most / 8 : 2 * most;
}

Points DenseTruth::at(double t) const {
  if (exact_) return exact_->at(t).x;
  const Trajectory& path = truth_.trajectory;
  const auto after = std::upper_bound(path.t.begin(), path.t.end(), t);
  const int to = std::clamp(static_cast<int>(after - path.t.begin()), 1, path.frames() - 1);
  return interpolated(to - 1, to, t);
}

Run observed_run(const Method& method, const Scene& scene, const DenseTruth& path) {
  Run run = default_run(scene);
  if (method.adaptive && !has_contact(scene.model)) run.step = std::min(run.step, path.time_resolution());
  return run;
}

Verdict MaxErrorObserver::observe(const State& state, bool sample) {
  if (state.t > path_.until() * (1 + 1e-9) || (!sample && state.t < last_ + path_.time_resolution()))
    return Verdict::ok;
  last_ = state.t;
  distance_ = std::max(distance_, rms_distance(state.x, path_.at(state.t)));
  return Verdict::ok;
}

}  // namespace crosscheck
