#include "experiments/measures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/metrics.h"
#include "experiments/period.h"
#include "mysim/model/energy.h"
#include "mysim/model/system.h"
#include "reference/method.h"

namespace crosscheck {
namespace {

bool has_rest(const Model& model) {
  const auto* wind = model.find<Wind>();
  const auto* air = model.find<Aerodynamics>();
  return !model.first_order() && !model.find<Constraints>() && !has_contact(model) && model.find<Springs>() &&
         !(wind && wind->acceleration.gusts) && !(air && air->velocity.gusts) && !model.particles.move &&
         !model.particles.pins.empty();
}

}  // namespace

std::optional<State> rest_of(const Scene& scene) {
  if (!has_rest(scene.model)) return std::nullopt;
  Model model = scene.model;
  std::erase_if(model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  System system(model);
  State s = scene.start;
  s.v.setZero();
  Points a(3, s.x.cols());
  const double omega = highest_frequency(model, s);
  if (!(omega > 0)) return std::nullopt;
  // 2 / omega is the stability limit at the start. The limit may change later, because a stretched spring also resists
  // sideways motion (but less than extension), so 0.8 / omega leaves a margin
  double h = 0.8 / omega, before = 0, scale = 0;
  constexpr int most_steps = 100000, check = 50;
  // rounding error of the acceleration at rest, where forces cancel: a few ulps of the force of a spring that is
  // stretched by the scene's size
  const double rounding = 1e-13 * omega * omega * scene.size();
  for (int i = 0; i < most_steps; ++i) {
    system.acceleration(s, a);
    if (i % check == 0) {
      if (!a.allFinite()) return std::nullopt;
      const double rms = a.norm();
      scale = std::max(scale, rms);
      if (rms <= std::max(rounding, 1e-5 * scale)) {
        s.v.setZero();
        return s;
      }
    }
    s.v += h * a;
    const double kinetic = (s.v.colwise().squaredNorm() * model.particles.mass).value();
    if (kinetic < before) {
      s.v.setZero();
      before = 0;
      continue;
    }
    before = kinetic;
    s.x += h * s.v;
  }
  return std::nullopt;
}

namespace {

class StepObserver : public Observer {
 public:
  explicit StepObserver(std::function<void(const State&)> look) : look_(std::move(look)) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    look_(state);
    return Verdict::ok;
  }

 private:
  std::function<void(const State&)> look_;
};

/// Observes every step of a run of `duration` (s); returns false if the run failed.
using MeasuringRun = std::function<bool(double duration, const std::function<void(const State&)>& look)>;

/// A run with leapfrog (xpbd for hard distances) and a step of h_omega divided by the highest frequency.
MeasuringRun run_at(const Scene& scene, double h_omega) {
  return [&scene, h_omega](double duration, const std::function<void(const State&)>& look) {
    const bool hard = scene.model.find<Constraints>() != nullptr;
    const double omega = highest_frequency(scene.model, scene.start);
    double h = omega > 0 ? h_omega / omega : h_omega * scene.step;
    if (hard) h = std::min(h, h_omega * scene.step);
    StepObserver observer(look);
    return run_method(find_method(hard ? "mysim/xpbd" : "mysim/leapfrog"), scene,
                      {std::min(h, h_omega * duration / 20), duration, 1}, {&observer})
               .verdict == Verdict::ok;
  };
}

MeasuringRun own_run(const Scene& scene) {
  return [&scene](double duration, const std::function<void(const State&)>& look) {
    Run run = default_run(scene);
    run.step = time_grid(run).h;
    run.duration = std::ceil(duration / run.step) * run.step, run.samples = 1;  // whole steps of this size
    StepObserver observer(look);
    return run_method(find_method(scene.method), scene, run, {&observer}).verdict == Verdict::ok;
  };
}

/// For converged runs, extrapolates an error of order 2 (order 1 for xpbd).
template <class Measure>
std::optional<double> measured(const Scene& scene, MeasuredBy by, Measure measure) {
  if (by == MeasuredBy::own_method) return measure(own_run(scene));
  if (by == MeasuredBy::one_run) return measure(run_at(scene, 0.5));
  const double gain = scene.model.find<Constraints>() ? 1 : 1. / 3;
  std::optional<double> value, better;
  constexpr int most_halvings = 5;  // the fastest vibration then has an error of 1e-5, slower ones less
  for (int i = 0; i <= most_halvings; ++i) {
    const auto finer = measure(run_at(scene, std::ldexp(0.5, -i)));
    if (!finer) return std::nullopt;
    const auto before = std::exchange(better, value ? std::optional(*finer + (*finer - *value) * gain) : std::nullopt);
    value = finer;
    if (before && std::abs(*better - *before) <= 1e-4 * std::abs(*better)) break;
  }
  return better;
}

}  // namespace

std::optional<double> sag_of(const Scene& scene) {
  const auto* gravity = scene.model.find<Gravity>();
  if (!gravity || gravity->acceleration.isZero(0)) return std::nullopt;
  const auto rest = rest_of(scene);
  if (!rest) return std::nullopt;
  return (gravity->acceleration.normalized().transpose() * (rest->x - scene.start.x)).maxCoeff();
}

std::optional<double> period_of(const Scene& scene, double about, MeasuredBy by) {
  if (scene.model.first_order()) return std::nullopt;
  return measured(scene, by, [&](const MeasuringRun& run) -> std::optional<double> {
    for (const double periods : {4.5, 18., 72.}) {
      std::vector<double> t;
      std::vector<Vec3> path;
      const bool held = run(periods * about, [&](const State& s) {
        t.push_back(s.t);
        path.push_back(centre_of_mass(scene, s.x));
      });
      if (!held || path.empty()) return std::nullopt;
      if (const auto period = period_of_path(t, path)) return period;
      if (std::ranges::count(path, path[0]) == std::ssize(path)) return std::nullopt;  // nothing moves
    }
    return std::nullopt;
  });
}

std::optional<double> settle_time_of(const Scene& scene, double about, MeasuredBy by) {
  const auto rest = rest_of(scene);
  if (!rest) return std::nullopt;
  const double lowest = energy_of(scene.model, *rest).total(), until = 1.5 * about;
  return measured(scene, by, [&](const MeasuringRun& run) -> std::optional<double> {
    std::vector<std::pair<double, double>> above;  // s, J
    const bool held =
        run(until, [&](const State& s) { above.emplace_back(s.t, energy_of(scene.model, s).total() - lowest); });
    if (!held) return std::nullopt;
    double largest = 0;
    for (const auto& [t, e] : above) largest = std::max(largest, e);
    if (!(largest > 0)) return std::nullopt;
    const double goal = 1e-3 * largest;
    size_t last = above.size();
    while (last > 0 && above[last - 1].second <= goal) --last;
    if (last == 0) return 0;
    if (last == above.size()) return until * std::log(1e3) / std::max(1e-3, std::log(largest / above.back().second));
    const auto [t0, e0] = above[last - 1];
    const auto [t1, e1] = above[last];
    return t0 + (t1 - t0) * (e0 - goal) / (e0 - e1);
  });
}

std::optional<double> max_stretch_of(const Scene& scene, MeasuredBy by) {
  const auto* springs = scene.model.find<Springs>();
  if (!springs) return std::nullopt;
  return measured(scene, by, [&](const MeasuringRun& run) -> std::optional<double> {
    double largest = -INFINITY;
    const bool held = run(scene.duration, [&](const State& s) {
      for (const Spring& e : springs->list)
        if (e.rest > 0) largest = std::max(largest, (s.x.col(e.a) - s.x.col(e.b)).norm() / e.rest - 1);
    });
    if (!held || !std::isfinite(largest)) return std::nullopt;
    return largest;
  });
}

}  // namespace crosscheck
