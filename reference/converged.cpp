// Runs the routes and compares them.
#include "reference/converged.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mysim/errors.h"
#include "mysim/frequency.h"
#include "mysim/observers/watch.h"
#include "reference/independent/integrators.h"
#include "reference/method.h"
#include "reference/multipliers.h"

namespace crosscheck {
namespace {

struct Route {
  std::string how;
  double step;  // s, of the fine run; the mean under error control
  Trajectory coarse, fine;
};

bool few_particles(const Scene& scene) { return scene.model.particles.size() < 50; }

/// Steps of the scene's own, whatever the run's: truth must not depend on what is compared with it.
double first_step(const Scene& scene, bool hard) {
  // rk4 follows a vibration well below h omega = 0.7 and is stable up to 2.83: the first run is at most at 1.4
  const double omega = scene.model.first_order() ? 0 : fastest_frequency(scene.model, scene.start);
  // a few particles cost little: there the bar is pushed down to where order can be seen; hard distances cost much
  const double part = hard ? 1 : few_particles(scene) ? 16 : 4;
  return std::min(2 * scene.step / part, omega > 0 ? 1.4 / omega : scene.step);
}

/// mysim's run at one step, under a watch for failures; nothing if it failed. Throws Unsupported where the hard
/// distances depend on each other.
std::optional<Trajectory> by_rk4(const Scene& scene, const Run& run, bool hard) {
  Recorder recorder;
  Outcome out;
  if (hard) {
    Watch watch(scene.model);
    Observers look({&recorder, &watch});
    MultiplierWorld world(scene, plan(run).h);
    out = march(world, run, look);
  } else {
    out = run_method(find_method("mysim/rk4"), scene, run, {&recorder});
  }
  if (out.verdict != Verdict::ok) return std::nullopt;
  return std::move(recorder.trajectory);
}

/// Halves the step until that changes little.
std::optional<Route> by_mysim(const Scene& scene, const Run& run) {
  constexpr int most_halvings = 7;
  const double enough = 1e-8 * scene.size();  // far below what any scene asks for; a few particles reach 1e-11 at once
  const bool hard = scene.model.find<Constraints>() != nullptr;
  double h = first_step(scene, hard);
  auto coarse = by_rk4(scene, {h, run.duration, run.samples}, hard);
  double change = INFINITY;
  for (int i = 0; i < most_halvings && coarse; ++i) {
    h /= 2;
    auto fine = by_rk4(scene, {h, run.duration, run.samples}, hard);
    if (!fine) return std::nullopt;
    const double before = std::exchange(change, largest_rms_distance(*coarse, *fine));
    // where halving no longer helps, round-off or chaos is what is left
    if (change < enough || change > before / 2)
      return Route{fmt::format("mysim/rk4 at {:.3g} ms{}", 1e3 * h,
                               hard ? ", with Lagrange multipliers for the hard distances" : ""),
                   h, std::move(*coarse), std::move(*fine)};
    coarse = std::move(fine);
  }
  return std::nullopt;
}

std::optional<Route> by_others(const Scene& scene, const Run& run) {
  // a step's error, of the scene's size; round-off is at 1e-16
  const auto tolerances = few_particles(scene) ? std::array{1e-11, 1e-13} : std::array{1e-9, 1e-10};
  const auto sundials = sundials_version();
  const Engine engine = sundials ? run_arkode : run_odeint_fehlberg78;
  Route route{fmt::format("{} on a right-hand side written apart",
                          sundials ? fmt::format("SUNDIALS ARKODE {}, Fehlberg 7(8)", *sundials)
                                   : fmt::format("odeint (Boost {}), Fehlberg 7(8)", odeint_version())),
              0,
              {},
              {}};
  for (const double tolerance : tolerances) {
    Recorder recorder;
    const Run to{scene.step, run.duration, run.samples, tolerance};
    const Outcome out = engine(scene, to, recorder);
    if (out.verdict != Verdict::ok) return std::nullopt;
    route.step = out.step;
    (tolerance == tolerances.front() ? route.coarse : route.fine) = std::move(recorder.trajectory);
  }
  return route;
}

}  // namespace

std::optional<Truth> converged_truth(const Scene& scene, const Run& run) try {
  auto ours = by_mysim(scene, run);
  if (!ours) return std::nullopt;
  const auto theirs = by_others(scene, run);
  if (!theirs) return std::nullopt;

  Truth truth{
      Tier::converged,
      fmt::format("{}, against {}{}", ours->how, theirs->how, sundials_version() ? "" : " (SUNDIALS is not there)"),
      std::move(ours->fine), 0};
  const auto& x = truth.trajectory.x;
  // a rounding of each step's positions, adding up like a random walk
  const double walk = 0.5 * std::numeric_limits<double>::epsilon() * std::sqrt(run.duration / ours->step);
  double motion = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    motion = std::max(motion, rms_distance(x[i], x[0]));
    const double rounding = walk * x[i].norm() / std::sqrt(x[i].cols());
    truth.bar = std::max({truth.bar, 1e-15 * scene.size(), rounding});
    for (const double apart : {rms_distance(x[i], theirs->fine.x[i]), rms_distance(x[i], ours->coarse.x[i]),
                               rms_distance(theirs->fine.x[i], theirs->coarse.x[i])})
      truth.bar = std::isfinite(apart) ? std::max(truth.bar, apart) : INFINITY;
    truth.bars.push_back(truth.bar);
  }
  if (!(truth.bar < 0.01 * motion)) return std::nullopt;
  return truth;
} catch (const Unsupported&) {
  return std::nullopt;
} catch (const SolverFailure&) {
  return std::nullopt;
}

}  // namespace crosscheck
