#include "experiments/check/subject.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "experiments/check/compare.h"
#include "experiments/metrics.h"
#include "mysim/model/system.h"

namespace crosscheck {

Run run_for_relations(const Scene& scene) {
  Run run = default_run(scene);
  run.tolerance = 1e-9;
  run.timed = false;
  return run;
}

double lengths_in(const Scene& scene, const Trajectory& path) {
  double largest = 0;
  for (const Points& x : path.x) largest = std::max(largest, largest_column(x));
  return scene.size() + largest;
}

SubjectRun Subject::fresh_run(const Scene& scene, const Run& run) {
  Recorder recorder;
  SubjectRun made;
  made.outcome = run_method(method_, scene, run, {&recorder});
  made.path = std::move(recorder.trajectory);
  Outcome& out = made.outcome;
  const TimeGrid grid = time_grid(run);
  if (out.steps == 0) out.steps = static_cast<long>(grid.samples) * grid.steps_per_sample;  // not reported
  if (out.verdict == Verdict::unsupported) throw CannotBeAsked(out.reason);
  if (out.readback) single_ = out.readback->precision == "single";
  if (out.verdict != Verdict::ok)
    throw RunFailed(
        fmt::format("a run on {} {}{}", scene.name, in_words(out.verdict), out.reason.empty() ? "" : ": " + out.reason),
        out.end, out.verdict);
  if (made.path.frames() != run.samples + 1)
    throw RunFailed(
        fmt::format("a run on {} has {} frames, expected {}", scene.name, made.path.frames(), run.samples + 1), out.end,
        Verdict::crash);
  return made;
}

const SubjectRun& Subject::run(const Scene& scene, const Run& run) {
  const std::string key =
      fmt::format("{} {:a} {:a} {} {:a}", hash_of(scene), run.step, run.duration, run.samples, run.tolerance);
  const auto known = runs_.find(key);
  return known != runs_.end() ? known->second : runs_.emplace(key, fresh_run(scene, run)).first->second;
}

double Subject::unit_roundoff() const {
  return single_.value_or(method_.family().single_precision) ? 0x1p-24 : 0x1p-53;
}

double Subject::rounding(double lengths, long steps, bool projected) const {
  const double n = static_cast<double>(std::max(1L, steps)), u = unit_roundoff();
  return (10 * std::sqrt(n) + (projected ? n * std::sqrt(n) : 0)) * u * lengths;
}

namespace {

double largest_speed(const Trajectory& path) {
  double speed = 0;
  for (const Points& v : path.v) speed = std::max(speed, largest_column(v));
  return speed;
}

}  // namespace

Subject::Noise Subject::noise(const Scene& scene, double lengths) {
  const Run settings = run_for_relations(scene);
  const SubjectRun& plain = run(scene, settings);
  const double scale = std::max(lengths, lengths_in(scene, plain.path));
  Noise noise;
  noise.start = rounding(scale, plain.outcome.steps, method_.position_based || has_contact(scene.model));
  if (chooses_steps(method_)) noise.start = std::max(noise.start, settings.tolerance * scale * plain.outcome.steps);
  // the noise of velocities is proportional to that of positions
  const bool velocities = plain.path.v.back().cols() == plain.path.x.back().cols();
  noise.x.assign(plain.path.frames(), 3 * noise.start);
  if (velocities) noise.v.assign(plain.path.frames(), 3 * noise.start / scale * largest_speed(plain.path));
  for (const auto& [seed, way] : {std::pair{1U, 1}, {1U, -1}, {2U, 1}, {2U, -1}}) {
    const SubjectRun& moved = run(perturbed(scene, way * noise.start, seed), settings);
    double x = 0, v = 0;
    for (int i = 0; i < plain.path.frames(); ++i) {
      x = std::max(x, largest_column(moved.path.x[i] - plain.path.x[i]));
      noise.x[i] = std::max(noise.x[i], 3 * x);
      if (!velocities) continue;
      v = std::max(v, largest_column(moved.path.v[i] - plain.path.v[i]));
      noise.v[i] = std::max(noise.v[i], 3 * v);
    }
  }
  if (has_contact(scene.model))
    for (size_t i = 0; i < noise.x.size(); ++i)
      if (noise.x[i] > 3 * most_growth * noise.start) noise.x[i] = std::numeric_limits<double>::infinity();
  return noise;
}

Subject::Noise Subject::noise_with_unsolved(const Scene& scene, double lengths) {
  Noise noise = this->noise(scene, lengths);
  const Stepper* rule = stepper_of(method_);
  if (!rule || rule->solved_to == 0) return noise;
  const Particles& p = scene.model.particles;
  double heaviest = 0, lightest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < p.size(); ++i)
    if (!p.pinned[i]) heaviest = std::max(heaviest, p.mass[i]), lightest = std::min(lightest, p.mass[i]);
  if (heaviest == 0) return noise;
  const SubjectRun& plain = run(scene);
  const double omega = highest_frequency(scene.model, scene.start);
  const double rounded =
      48 * unit_roundoff() * omega * omega * std::max(lengths, lengths_in(scene, plain.path)) * plain.outcome.step;
  const double unsolved = std::max(rule->solved_to * largest_speed(plain.path) * heaviest / lightest, rounded) *
                          static_cast<double>(std::max(1L, plain.outcome.steps));
  // the error of positions, unsolved * duration, grows in the same way as the perturbation
  const double factor = 1 + unsolved * scene.duration / noise.start;
  for (double& x : noise.x) x *= factor;
  for (double& v : noise.v) v = v * factor + 3 * unsolved;
  noise.start *= factor;
  return noise;
}

namespace {

struct NamedIterations {
  std::string method;  // without the option n=
  int count = 1;
};

/// Reads the option n=, the number of iterations of position-based methods; the default is 1.
NamedIterations iterations_in(const std::string& name) {
  NamedIterations found;
  for (size_t at = 0; at <= name.size();) {
    const size_t end = std::min(name.find('+', at), name.size());
    const std::string part = name.substr(at, end - at);
    at = end + 1;
    if (!part.starts_with("n="))
      found.method += (found.method.empty() ? "" : "+") + part;
    else
      std::from_chars(part.data() + 2, part.data() + part.size(), found.count);
  }
  return found;
}

}  // namespace

std::optional<Method> Subject::with_iterations(int times) const {
  if (!method_.position_based) return std::nullopt;
  const NamedIterations own = iterations_in(method_.name);
  try {
    return find_method(fmt::format("{}+n={}", own.method, times * own.count));
  } catch (const std::exception&) {  // no such option
    return std::nullopt;
  }
}

std::optional<std::vector<double>> Subject::iteration_error(const Scene& scene) {
  const auto twice = with_iterations(2);
  if (!twice) return std::nullopt;
  if (!twice_) twice_ = std::make_shared<Subject>(*twice);
  const SubjectRun& here = run(scene);
  const SubjectRun& there = twice_->run(scene);
  std::vector<double> apart(here.path.frames());
  const double times = 2 + 1.0 / iterations_in(method_.name).count;
  double most = 0;
  for (size_t i = 0; i < apart.size(); ++i)
    apart[i] = most = std::max(most, times * largest_column(here.path.x[i] - there.path.x[i]));
  return apart;
}

}  // namespace crosscheck
