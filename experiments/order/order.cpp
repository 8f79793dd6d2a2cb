// Experiment `order`: error versus time step, and its slope compared with the declared order. The distance of each run
// from the method's own run at its smallest step reveals methods that converge to a different solution.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/tables/order.h"
#include "reference/engines/engines.h"

namespace crosscheck {
namespace {

struct ErrorAtStep {
  double step, error;
};

struct Refinement {
  Outcome outcome;
  Trajectory trajectory;
  bool ok() const { return outcome.verdict == Verdict::ok; }
};

struct Fit {
  double order, from, to;  // order: the slope; from, to: the steps (s) between which it was fitted
};

/// The slope of the finest three points if it is steady (two consecutive slopes differ by less than 0.3). Otherwise the
/// error is not yet, or no longer, a power of the step, and there is no order.
std::optional<Fit> asymptotic_order(const std::vector<ErrorAtStep>& points) {
  if (points.size() < 3) return std::nullopt;
  const ErrorAtStep *p = &points[points.size() - 3], *q = p + 1, *r = p + 2;
  const auto slope = [](const ErrorAtStep* a, const ErrorAtStep* b) {
    return std::log(a->error / b->error) / std::log(a->step / b->step);
  };
  // an error that hardly decreases comes from a different law, and has no order
  if (!(std::abs(slope(p, q) - slope(q, r)) < 0.3) || slope(p, r) < 0.5) return std::nullopt;
  return Fit{slope(p, r), p->step, r->step};
}

std::string why_not(const Scene& scene) {
  if (has_contact(scene.model)) return "contact makes every rule first order, erratically after impacts";
  if (scene.start.x.cols() > 50) return "its runs would take too long; speed-accuracy shows its error at each step";
  return "";
}

void order_on(const Request& request, const Scene& scene, TableSet& tables) {
  Table points = table_of<OrderRow>();
  Table slopes = table_of<OrderSlopeRow>();
  std::set<std::string> adaptive;  // adaptive methods, which are left out with one note for all
  const int halvings = request.full ? 9 : 7;
  if (const std::string why = why_not(scene); !why.empty()) {
    tables.notes.push_back(fmt::format("order leaves out {}: {}", scene.name, why));
    return;
  }
  Run base = run_of(request, scene);
  base.timed = false;
  const auto truth = truth_of(scene, base);
  if (!truth) {
    tables.notes.push_back(fmt::format("order leaves out {}: no reference solution is known for it", scene.name));
    return;
  }
  const double motion = motion_of(truth->trajectory);
  for (const Method& method : methods_of(request, scene)) {
    if (method.family().role == Role::truth || (method.stepper && method.name.find('+') != std::string::npos)) continue;
    if (method.adaptive) {
      adaptive.insert(method.name);
      continue;
    }
    // at most five halvings for other engines, whose steps cost ten times as much
    const int steps = method.stepper ? halvings : std::min(halvings, 5);
    std::vector<Refinement> runs;
    for (int i = 0; i < steps; ++i) {
      Run run = base;
      run.step = 4 * base.step / (1 << i);
      Recorder recorder;
      Outcome out = run_method(method, scene, run, {&recorder});
      if (out.verdict == Verdict::unsupported) break;
      runs.push_back({std::move(out), std::move(recorder.trajectory)});
    }
    if (runs.empty()) continue;
    std::vector<ErrorAtStep> good;
    for (const Refinement& r : runs) {
      const Outcome& out = r.outcome;
      const double error = largest_rms_distance(r.trajectory, truth->trajectory, scene.window);
      const bool finest = &r == &runs.back();
      OrderRow row{.scene = scene.name,
                   .method = method.name,
                   .step = out.step,
                   .truth = truth->how,
                   .truth_tier = truth->tier,
                   .truth_bar = truth->error_bar,
                   .evaluations = out.evaluations,
                   .verdict = out.verdict};
      if (r.ok()) row.error = error;
      if (r.ok() && runs.back().ok() && !finest)
        row.distance_to_finest = largest_rms_distance(r.trajectory, runs.back().trajectory, scene.window);
      add(points, row);
      // errors below 30 error bars would make the slope uncertain by more than 0.05; large errors are not yet a power
      // of the step
      if (r.ok() && error > 30 * truth->error_bar && error < 0.1 * motion) good.push_back({out.step, error});
    }
    const auto fit = asymptotic_order(good);
    if (fit) {
      const Stepper* rule = stepper_of(method);
      add(slopes, OrderSlopeRow{scene.name, method.name, rule ? std::optional<long>(rule->order) : std::nullopt,
                                fit->order, fit->from, fit->to});
    } else
      tables.notes.push_back(
          fmt::format("order finds no steady slope for {} on {}", without_folders(method.name), scene.name));
  }
  if (!adaptive.empty())
    tables.notes.push_back(fmt::format("order leaves out {}: adaptive steps", fmt::join(adaptive, ", ")));
  tables.add(points);
  tables.add(slopes);
}

}  // namespace

std::vector<Point> order_points(const Request& request) { return one_point_per_scene(request, "order", order_on); }

}  // namespace crosscheck
