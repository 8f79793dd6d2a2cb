// Finds the truth of a scene.
#include "reference/truth.h"

#include <algorithm>
#include <cmath>

#include "reference/contact_truth.h"
#include "reference/converged.h"
#include "reference/exact/exact.h"
#include "reference/truth_cache.h"

namespace crosscheck {
namespace {

Truth from_closed_form(const ExactSolution& exact, const Scene& scene, const Run& run) {
  const StepPlan steps = plan(run);
  Truth truth{Tier::exact, "closed form: " + exact.formula, {}, 0};
  double path = 0;
  for (int sample = 0; sample <= steps.samples; ++sample) {
    const State s = exact.at(steps.time(sample, 0));
    if (sample > 0) path += (s.x - truth.trajectory.x.back()).norm();
    truth.trajectory.t.push_back(s.t);
    truth.trajectory.x.push_back(s.x);
    truth.trajectory.v.push_back(s.v);
  }
  // an angle of many radians is known to eps times itself only: the round-off grows with the path
  truth.bar = 1e-15 * (scene.size() + path);
  return truth;
}

}  // namespace

std::string_view name_of(Tier tier) {
  switch (tier) {
    case Tier::exact:
      return "exact";
    case Tier::exact_discrete:
      return "exact for the discrete rule";
    case Tier::converged:
      return "converged";
    case Tier::another_engine:
      return "another engine";
  }
  return "unknown";
}

double rms_distance(const Points& a, const Points& b) { return (a - b).norm() / std::sqrt(double(a.cols())); }

double largest_rms_distance(const Trajectory& a, const Trajectory& b, double until) {
  double largest = 0;
  for (int i = 0; i < std::min(a.frames(), b.frames()) && a.t[i] <= until * (1 + 1e-9); ++i)
    largest = std::max(largest, rms_distance(a.x[i], b.x[i]));
  return largest;
}

std::optional<Truth> truth_of(const Scene& scene, const Run& run) {
  if (const auto exact = exact_solution(scene)) return from_closed_form(*exact, scene, run);
  const auto find = [&] {
    return scene.model.find<Spheres>() ? contact_truth(scene, run) : converged_truth(scene, run);
  };
  const auto cache = TruthCache::of_environment();
  return cache ? cache->find_or(scene, run, find) : find();
}

}  // namespace crosscheck
