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

/// Three runs of one kind, each refined by the same factor from the one before.
struct Route {
  std::string how;
  double step;   // s, of the fine run; the mean under error control
  double ratio;  // by which one refinement lowers the error at best: what is seen beyond it is chance
  Trajectory coarse, middle, fine;
};

/// What a route says of its own error, sample by sample: the differences of its last two refinements up to there.
class OwnEstimate {
 public:
  explicit OwnEstimate(const Route& route) : route_(route) {}
  /// m, of the error up to sample i, to be asked in order. An order p divides the error by 2^p at each refinement (by
  /// r, where it is the tolerance that is refined), so that the last difference over r - 1 is left; three times that,
  /// for r is itself measured. Where the differences do not halve no order shows, and the whole difference stands.
  double up_to(size_t i) {
    before_ = std::max(before_, rms_distance(route_.coarse.x[i], route_.middle.x[i]));
    last_ = std::max(last_, rms_distance(route_.middle.x[i], route_.fine.x[i]));
    if (!std::isfinite(last_) || !std::isfinite(before_)) return INFINITY;
    const double r = std::min(before_ / last_, route_.ratio);
    return r >= 2 ? 3 * last_ / (r - 1) : last_;
  }

 private:
  const Route& route_;
  double before_ = 0, last_ = 0;
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
    Watch watch(scene, run);
    Watched look(watch, {&recorder});
    MultiplierWorld world(scene, plan(run).h);
    out = march(world, run, look);
  } else {
    out = run_method(find_method("mysim/rk4"), scene, run, {&recorder});
  }
  if (out.verdict != Verdict::ok) return std::nullopt;
  return std::move(recorder.trajectory);
}

/// Halves the step until that changes little; at least twice, so that an order can be seen.
std::optional<Route> by_mysim(const Scene& scene, const Run& run) {
  constexpr int most_halvings = 7;
  const double enough = 1e-8 * scene.size();  // far below what any scene asks for; a few particles reach 1e-11 at once
  const bool hard = scene.model.find<Constraints>() != nullptr;
  double h = first_step(scene, hard);
  const auto at = [&] { return by_rk4(scene, {h, run.duration, run.samples}, hard); };
  std::optional<Trajectory> coarse, middle = at();
  double change = INFINITY;
  for (int i = 0; i < most_halvings && middle; ++i) {
    h /= 2;
    auto fine = at();
    if (!fine) return std::nullopt;
    const double before = std::exchange(change, largest_rms_distance(*middle, *fine));
    // where halving no longer helps, round-off or chaos is what is left
    if (coarse && (change < enough || change > before / 2))
      return Route{fmt::format("mysim/rk4 at {:.3g} ms{}", 1e3 * h,
                               hard ? ", with Lagrange multipliers for the hard distances" : ""),
                   h,
                   16,
                   std::move(*coarse),
                   std::move(*middle),
                   std::move(*fine)};
    coarse = std::move(middle);
    middle = std::move(fine);
  }
  return std::nullopt;
}

std::optional<Route> by_others(const Scene& scene, const Run& run) {
  // a step's error, of the scene's size; round-off is at 1e-16
  const auto tolerances = few_particles(scene) ? std::array{1e-11, 1e-12, 1e-13} : std::array{1e-8, 1e-9, 1e-10};
  Route route{fmt::format("odeint (Boost {}), Bulirsch and Stoer's extrapolation, on a right-hand side written apart",
                          odeint_version()),
              0,
              tolerances[0] / tolerances[1],
              {},
              {},
              {}};
  Trajectory* const runs[] = {&route.coarse, &route.middle, &route.fine};
  for (size_t i = 0; i < tolerances.size(); ++i) {
    Recorder recorder;
    const Run to{scene.step, run.duration, run.samples, tolerances[i]};
    const Outcome out = run_odeint_bulirsch_stoer(scene, to, recorder);
    if (out.verdict != Verdict::ok) return std::nullopt;
    route.step = out.step;
    *runs[i] = std::move(recorder.trajectory);
  }
  return route;
}

}  // namespace

std::optional<Truth> converged_truth(const Scene& scene, const Run& run) try {
  auto ours = by_mysim(scene, run);
  if (!ours) return std::nullopt;
  const auto theirs = by_others(scene, run);
  if (!theirs) return std::nullopt;

  Truth truth{Tier::converged, fmt::format("{}, against {}", ours->how, theirs->how), ours->fine, 0};
  const auto& x = truth.trajectory.x;
  OwnEstimate of_ours(*ours), of_theirs(*theirs);
  // a rounding of each step's positions, adding up like a random walk
  const double walk = 0.5 * std::numeric_limits<double>::epsilon() * std::sqrt(run.duration / ours->step);
  double motion = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    motion = std::max(motion, rms_distance(x[i], x[0]));
    // and some units in the last place that each route has of its own, whatever it refines
    const double place = x[i].norm() / std::sqrt(x[i].cols());
    const double rounding = std::max(walk * place, 1e-15 * std::max(scene.size(), place));
    // an error of the first route is what it is apart from the second, and what that one errs the same way
    const double apart = rms_distance(x[i], theirs->fine.x[i]) + of_theirs.up_to(i), own = of_ours.up_to(i);
    const double bar = std::max(apart, own) + rounding;
    truth.bar = std::isfinite(bar) ? std::max(truth.bar, bar) : INFINITY;
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
