// Sixteen runs and two moments.
#include "experiments/statistics.h"

#include <algorithm>
#include <cmath>

#include "experiments/metrics.h"
#include "mysim/energy.h"
#include "mysim/observers/trajectory.h"

namespace crosscheck {
namespace {

Statistic moments(const char* quantity, const char* unit, const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double n = static_cast<double>(values.size()), mean = sum / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {quantity, unit, mean, std::sqrt(squares / (n - 1))};
}

}  // namespace

std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run) {
  std::vector<double> height, lowest, kinetic, elastic;
  for (unsigned seed = 1; seed <= ContactStatistics::runs; ++seed) {
    const Scene start = perturbed(scene, ContactStatistics::perturbation, seed);
    Recorder recorder;
    if (run_method(method, start, run, {&recorder}).verdict != Verdict::ok) return {};
    const Trajectory& path = recorder.trajectory;
    const State end{path.t.back(), path.x.back(), path.v.back()};
    const Energy energy = energy_of(scene.model, end);
    height.push_back(centre_of_mass(scene, end.x).y());
    kinetic.push_back(energy.kinetic);
    elastic.push_back(energy.elastic);
    double least = INFINITY;
    for (int i = 0; i < path.frames(); ++i) least = std::min(least, *clearance(scene, path.t[i], path.x[i]));
    lowest.push_back(least);
  }
  return {moments("height of the centre of mass at the end", "m", height), moments("smallest clearance", "m", lowest),
          moments("kinetic energy at the end", "J", kinetic), moments("elastic energy at the end", "J", elastic)};
}

}  // namespace crosscheck
