// Experiment `order`: error against step, and the slope beside the declared order.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/experiment.h"

namespace crosscheck {
namespace {

struct Point {
  double step, error;
};

/// Largest RMS error over the samples of the run.
double error_against(const Trajectory& trajectory, const Truth& truth) {
  double largest = 0;
  for (int i = 0; i < trajectory.frames(); ++i)
    largest = std::max(largest, rms_distance(trajectory.x[i], truth.trajectory.x[i]));
  return largest;
}

/// Why a scene is left out, or nothing.
std::string why_not(const Scene& scene) {
  if (scene.model.find<Sphere>()) return "contact makes every rule first order, erratically after impacts";
  if (scene.start.x.cols() > 50)
    return "its stiffest modes sit at the stability limit of the steps in use, where no order shows";
  return "";
}

}  // namespace

void order_experiment(const Request& request, Progress& progress, Result& result) {
  Table points{"order",
               {{"scene", "1"},
                {"method", "1"},
                {"step", "s"},
                {"error", "m"},
                {"truth bar", "m"},
                {"evaluations", "1"},
                {"verdict", "1"}},
               {}};
  Table slopes{"order-slopes",
               {{"scene", "1"},
                {"method", "1"},
                {"declared order", "1"},
                {"measured order", "1"},
                {"from step", "s"},
                {"to step", "s"}},
               {}};
  const int halvings = request.full ? 9 : 7;
  for (const Scene& scene : request.scenes) {
    progress.begin("order: " + scene.name);
    if (const std::string why = why_not(scene); !why.empty()) {
      result.notes.push_back(fmt::format("order leaves out {}: {}", scene.name, why));
      continue;
    }
    const Run base = run_of(request, scene);
    const auto truth = truth_of(scene, base);
    if (!truth) {
      result.notes.push_back(fmt::format("order leaves out {}: no truth is known for it", scene.name));
      continue;
    }
    for (const Method& method : methods_of(request, scene)) {
      if (!method.stepper || method.name.find('+') != std::string::npos) continue;
      std::vector<Point> good;
      for (int i = 0; i < halvings; ++i) {
        Run run = base;
        run.step = 4 * base.step / (1 << i);
        Recorder recorder;
        const Outcome out = run_method(method, scene, run, {&recorder});
        if (out.verdict == Verdict::unsupported) break;
        const double error = error_against(recorder.trajectory, *truth);
        const bool ok = out.verdict == Verdict::ok;
        points.add({scene.name, method.name, out.step, ok ? Cell(error) : Cell(), truth->bar, out.evaluations,
                    std::string(name_of(out.verdict))});
        // below 30 truth bars the bar, and below round-off the round-off, bends the slope by more than 0.05
        if (ok && error > 30 * truth->bar && error < 0.1 * scene.size()) good.push_back({out.step, error});
      }
      if (good.size() < 2) continue;
      // least squares through the finest three points that count: the asymptotic end
      const std::vector<Point> fine(good.end() - std::min<long>(3, static_cast<long>(good.size())), good.end());
      double sx = 0, sy = 0, sxx = 0, sxy = 0;
      for (const Point& p : fine) {
        const double x = std::log(p.step), y = std::log(p.error);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
      }
      const double n = static_cast<double>(fine.size());
      slopes.add({scene.name, method.name, static_cast<long>(method.stepper->order),
                  (n * sxy - sx * sy) / (n * sxx - sx * sx), fine.front().step, fine.back().step});
    }
  }
  result.tables.push_back(std::move(points));
  result.tables.push_back(std::move(slopes));
}

}  // namespace crosscheck
