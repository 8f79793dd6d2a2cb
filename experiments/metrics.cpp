#include "experiments/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mysim/base/random.h"
#include "mysim/model/energy.h"
#include "mysim/run/observers.h"
#include "reference/truth/truth.h"
#include "reference/which_rule.h"

namespace crosscheck {

Vec3 centre_of_mass(const Scene& scene, const Points& x) {
  const Particles& p = scene.model.particles;
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (int i = 0; i < p.size(); ++i)
    if (!p.pinned[i]) {
      sum += p.mass[i] * x.col(i);
      mass += p.mass[i];
    }
  return sum / mass;
}

double motion_of(const Trajectory& trajectory) {
  double largest = 0;
  for (const Points& x : trajectory.x) largest = std::max(largest, rms_distance(x, trajectory.x.front()));
  return largest;
}

std::optional<double> clearance(const Scene& scene, double t, const Points& x) {
  const std::vector<Surface> surfaces = surfaces_of(scene.model);
  if (surfaces.empty()) return std::nullopt;
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < x.cols(); ++i)
    if (!scene.model.particles.pinned[i]) smallest = std::min(smallest, clearance_from(surfaces, t, x.col(i)));
  return smallest;
}

std::optional<double> creep(const Scene& scene, double t, const Points& x, const Points& v) {
  const std::vector<Surface> surfaces = surfaces_of(scene.model);
  if (surfaces.empty() || v.cols() != x.cols()) return std::nullopt;
  double sum = 0;
  int touching = 0;
  for (const Surface& surface : surfaces) {
    const Vec3 origin = surface.origin_at(t), u = surface.velocity_at(t);
    const double near = 1e-3 * (surface.flat() ? scene.size() : surface.radius());
    for (int i = 0; i < x.cols(); ++i) {
      const Vec3 d = x.col(i) - origin, seen = v.col(i) - u;
      if (scene.model.particles.pinned[i] || surface.gap(d) > near) continue;
      const Vec3 n = surface.normal(d);
      sum += (seen - seen.dot(n) * n).norm();
      ++touching;
    }
  }
  if (touching == 0) return std::nullopt;
  return sum / touching;
}

std::optional<double> round_off_bound(const Scene& scene, double motion, double growth) {
  if (!(growth < 1e6)) return std::nullopt;
  return 1e-13 * (scene.size() + motion) * std::max(1.0, growth);
}

std::optional<double> single_precision_bound(const Scene& scene, double motion, double growth, long steps) {
  if (!(growth < 1e6)) return std::nullopt;
  return 10 * 6e-8 * (scene.size() + motion) * std::sqrt(static_cast<double>(steps)) * std::max(1.0, growth);
}

std::optional<double> round_off_bound_of(const Method& method, const Scene& scene, double motion, double growth,
                                         long steps) {
  return method.identify && method.identify().single ? single_precision_bound(scene, motion, growth, steps)
                                                     : round_off_bound(scene, motion, growth);
}

Scene perturbed(const Scene& scene, double size, unsigned seed) {
  Scene moved = scene;
  std::mt19937_64 engine(seed);
  auto part = [&] { return 2 * uniform(engine) - 1; };
  for (int i = 0; i < scene.start.x.cols(); ++i) {
    Vec3 direction;
    do direction = Vec3(part(), part(), part());
    while (direction.norm() > 1 || direction.norm() < 0.1);
    if (!scene.model.particles.pinned[i]) moved.start.x.col(i) += size * direction.normalized();
  }
  return moved;
}

double Growth::until(double time) const {
  double largest = 0;
  for (size_t i = 0; i < t.size() && t[i] <= time * (1 + 1e-9); ++i) largest = factor[i];
  return largest;
}

double Growth::window() const {
  double last = 0;
  for (size_t i = 0; i < t.size() && factor[i] <= 1e3; ++i) last = t[i];
  return last;
}

Growth growth_of(const Method& method, const Scene& scene, const Run& given, const Trajectory* unperturbed) {
  constexpr double size = 1e-10;  // m: far above round-off (1e-16), and far below the scale of any nonlinearity
  Run run = given;
  run.timed = false;
  Recorder a, b;
  if (!unperturbed) {
    run_method(method, scene, run, {&a});
    unperturbed = &a.trajectory;
  }
  run_method(method, perturbed(scene, size, 1), run, {&b});
  Growth growth;
  double largest = 0;
  for (int i = 0; i < std::min(unperturbed->frames(), b.trajectory.frames()); ++i) {
    largest = std::max(largest, largest_column(unperturbed->x[i] - b.trajectory.x[i]));
    growth.t.push_back(b.trajectory.t[i]);
    growth.factor.push_back(largest / size);
  }
  return growth;
}

double perturbation_growth(const Method& method, const Scene& scene, double step, double until) {
  const int samples = std::max(1, static_cast<int>(std::lround(scene.samples * until / scene.duration)));
  return growth_of(method, scene, {step, until, samples}).until(until);
}

std::vector<Statistic> contact_quantities(const Scene& scene, const Trajectory& path) {
  const State end{path.t.back(), path.x.back(), path.v.back()};
  const Energy energy = energy_of(scene.model, end);
  const Vec3 centre = centre_of_mass(scene, end.x);
  double lowest = INFINITY, aside = 0;
  for (int i = 0; i < path.frames(); ++i) lowest = std::min(lowest, *clearance(scene, path.t[i], path.x[i]));
  int free = 0;
  for (int i = 0; i < end.x.cols(); ++i)
    if (!scene.model.particles.pinned[i]) {
      const Vec3 d = end.x.col(i) - centre;
      aside += d.x() * d.x() + d.z() * d.z(), ++free;
    }
  return {{"height of the centre of mass at the end", "m", centre.y(), 0},
          {"smallest clearance", "m", lowest, 0},
          {"kinetic energy at the end", "J", energy.kinetic, 0},
          {"elastic energy at the end", "J", energy.elastic, 0},
          {"outline at the end", "m", std::sqrt(aside / free), 0}};
}

std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run) {
  std::vector<std::vector<Statistic>> runs;
  for (unsigned seed = 1; seed <= ContactStatistics::runs; ++seed) {
    Recorder recorder;
    const Scene start = perturbed(scene, ContactStatistics::perturbation, seed);
    if (run_method(method, start, run, {&recorder}).verdict != Verdict::ok) return {};
    runs.push_back(contact_quantities(start, recorder.trajectory));
  }
  std::vector<Statistic> all = runs.front();
  const double n = static_cast<double>(runs.size());
  for (size_t q = 0; q < all.size(); ++q) {
    double sum = 0, squares = 0;
    for (const auto& values : runs) sum += values[q].mean;
    all[q].mean = sum / n;
    for (const auto& values : runs) squares += std::pow(values[q].mean - all[q].mean, 2);
    all[q].deviation = std::sqrt(squares / (n - 1));
  }
  return all;
}

}  // namespace crosscheck
