#include "experiments/adequacy/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/measures.h"
#include "reference/method.h"
#include "reference/truth/truth.h"

namespace crosscheck {
namespace {

constexpr int material_points = 17;  // along each side of the cloth: twice as fine as the coarsest grid

/// Keeps only the terms with which a scene can come to rest: springs, gravity and fixed pins.
Scene for_rest(Scene scene) {
  std::erase_if(scene.model.terms, [](const Term& t) {
    return std::holds_alternative<Wind>(t) || std::holds_alternative<Aerodynamics>(t) ||
           std::holds_alternative<Drag>(t);
  });
  scene.model.particles.move.reset();
  return scene;
}

/// Height difference between the highest and the lowest point of the cloth at rest, m. Moves the scene's start to the
/// state of rest, a good initial guess for similar stiffnesses.
std::optional<double> settle_and_sag(Scene& scene) {
  const auto* gravity = scene.model.find<Gravity>();
  if (!gravity || gravity->acceleration.isZero(0)) return std::nullopt;
  const auto rest = rest_of(for_rest(scene));
  if (!rest) return std::nullopt;
  scene.start.x = rest->x;
  const Eigen::RowVectorXd depth = gravity->acceleration.normalized().transpose() * rest->x;
  return depth.maxCoeff() - depth.minCoeff();
}

/// Stiffness factor that gives a desired sag, by the secant method in 1 / k (the sag is nearly linear in 1 / k).
std::optional<double> factor_for(const Scene& at_rest, double wished, double sag_at_1) {
  double a = 1, of_a = sag_at_1, b = 1.1;
  for (int i = 0; i < 12; ++i) {
    Scene stiffer = with_stiffness(at_rest, b);
    const auto of_b = settle_and_sag(stiffer);
    if (!of_b) return std::nullopt;
    if (std::abs(*of_b - wished) < 2e-6 * wished) return b;
    const double slope = (*of_b - of_a) / (1 / b - 1 / a), inverse = 1 / b + (wished - *of_b) / slope;
    if (!(inverse > 0) || !std::isfinite(inverse)) return std::nullopt;
    a = b, of_a = *of_b;
    b = std::clamp(1 / inverse, b / 2, b * 2);
    if (std::abs(b / a - 1) < 2e-3) return b;  // precise enough: the exponent fitted to these factors is less certain
  }
  return std::nullopt;
}

}  // namespace

std::vector<GridResult> grid_convergence(const Scene& scene, const std::vector<int>& sizes) {
  std::vector<GridResult> list;
  std::vector<Trajectory> surfaces;
  std::vector<Scene> scenes;
  const double interval = scene.duration / scene.samples;
  const int samples = std::max(1, static_cast<int>(scene.window / interval * (1 + 1e-9)));
  for (const int n : sizes) {
    Scene& now = scenes.emplace_back(with_resolution(scene, n));
    const Grid grid = *cloth_grid_of(now);
    Recorder recorder;
    Run run{std::min(now.step, interval), samples * interval, samples};
    run.timed = false;
    const Outcome out = run_method(find_method("mysim/leapfrog"), now, run, {&recorder});
    Trajectory surface = std::move(recorder.trajectory);
    for (Points& x : surface.x) x = at_material_points(x, grid.nu, grid.nv, material_points);
    const auto* springs = now.model.find<Springs>();
    list.push_back(
        {n, {}, settle_and_sag(now), {}, out.verdict, out.evaluations, springs ? std::ssize(springs->list) : 0});
    if (out.verdict != Verdict::ok) surface = {};
    surfaces.push_back(std::move(surface));
  }
  const GridResult& finest = list.back();
  for (size_t i = 0; i + 1 < list.size(); ++i) {
    if (surfaces[i].frames() > 0 && surfaces.back().frames() > 0)
      list[i].error = largest_rms_distance(surfaces[i], surfaces.back());
    if (list[i].sag && finest.sag) list[i].factor = factor_for(scenes[i], *finest.sag, *list[i].sag);
  }
  if (finest.sag) list.back().factor = 1;
  return list;
}

std::optional<PowerLaw> power_law(const std::vector<std::pair<double, double>>& points) {
  const auto n = static_cast<double>(points.size());
  if (n < 3) return std::nullopt;
  double mx = 0, my = 0;
  for (const auto& [x, y] : points) mx += std::log(x) / n, my += std::log(y) / n;
  double xx = 0, xy = 0, yy = 0;
  for (const auto& [x, y] : points) {
    const double dx = std::log(x) - mx, dy = std::log(y) - my;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  const double slope = xy / xx;
  return PowerLaw{slope, std::sqrt(std::max(0., yy - slope * xy) / (n - 2) / xx)};
}

std::vector<BendSprings> bending_stiffness(const std::vector<int>& sizes) {
  const auto line = [](int n, double bend) {
    const double d = 1 / (n - 1.5);
    std::string text = fmt::format(
        "question = \"How stiff must bend springs be?\"\nparameters = \"One line of a sheet.\"\n[time]\nduration = 1\n"
        "samples = 1\nstep = 1e-3\nwindow = 1\ntolerance = 1e-3\nmethod = \"leapfrog\"\n[pins]\nparticles = [0, 1]\n"
        "[gravity]\nacceleration = [0, -9.81, 0]\n");
    for (int i = 0; i < n; ++i)
      text += fmt::format("[[particle]]\nposition = [{}, 0, 0]\nmass = {}\n", (i - 0.5) * d,
                          (i == n - 1 ? 0.05 : 0.1) * d * d);
    // structural springs are ten times as stiff as the bend springs for every n, so that the relative extension is the
    // same on every grid
    for (int i = 0; i + 1 < n; ++i)
      text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\n", i, i + 1, 10 * bend);
    for (int i = 0; i + 2 < n; ++i)
      text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\n", i, i + 2, bend);
    Scene scene = parse_scene(text, "bending");
    // does not start flat: a flat line is unstable, because its bend springs do not resist infinitesimal turns
    for (int i = 2; i < n; ++i) scene.start.x(1, i) -= 0.1 * (i - 1) * (i - 1) * d * d;
    return scene;
  };
  const auto droop = [&](int n, double bend) -> std::optional<double> {
    const auto rest = rest_of(line(n, bend));
    return rest ? std::optional(-rest->x(1, n - 1)) : std::nullopt;
  };
  std::vector<BendSprings> list;
  for (const int n : sizes) {
    if (list.empty()) {
      constexpr double first = 40;  // N/m; at this stiffness the droop is some tenths of the length
      if (const auto d = droop(n, first)) list.push_back({n, n - 1.5, first, *d});
      if (list.empty()) return list;
      continue;
    }
    // bisection in the logarithm of the stiffness
    const BendSprings& last = list.back();
    double low = last.stiffness, high = last.stiffness * std::pow(double(n - 1) / (last.n - 1), 7);
    std::optional<double> d;
    for (int i = 0; i < 18 && high / low > 1.002; ++i) {
      const double middle = std::sqrt(low * high);
      d = droop(n, middle);
      if (!d) return list;
      (*d > list.front().droop ? low : high) = middle;
    }
    list.push_back({n, n - 1.5, std::sqrt(low * high), *d});
  }
  return list;
}

}  // namespace crosscheck
