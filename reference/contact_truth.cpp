// Three runs, and how far their differences fall.
#include "reference/contact_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "reference/method.h"

namespace crosscheck {
namespace {

std::optional<Trajectory> by_leapfrog(const Scene& scene, const Run& run) {
  Recorder recorder;
  if (run_method(find_method("mysim/leapfrog"), scene, run, {&recorder}).verdict != Verdict::ok) return std::nullopt;
  return std::move(recorder.trajectory);
}

bool touches(const Spheres& spheres, const Particles& particles, double t, const Points& x) {
  for (int i = 0; i < x.cols(); ++i)
    if (!particles.pinned[i] && clearance_from(spheres, t, x.col(i)) < 1e-9) return true;
  return false;
}

/// The sample of the first touch and the last one up to which single positions are followed; none without a touch.
struct Span {
  int touch, end;
};
std::optional<Span> followed(const Scene& scene, const Trajectory& path) {
  const auto& spheres = *scene.model.find<Spheres>();
  const Particles& particles = scene.model.particles;
  int touch = 0;
  while (touch < path.frames() && !touches(spheres, particles, path.t[touch], path.x[touch])) ++touch;
  if (touch == path.frames()) return std::nullopt;
  const bool several = particles.size() - static_cast<int>(particles.pins.size()) > 1;
  const double until = several ? std::min(scene.window, path.t[touch] + 0.3) : scene.window;
  int end = 0;
  while (end + 1 < path.frames() && path.t[end + 1] <= until * (1 + 1e-9)) ++end;
  return Span{touch, end};
}

}  // namespace

std::optional<Truth> contact_truth(const Scene& scene, const Run& run) {
  if (scene.model.find<Constraints>() || scene.model.first_order()) return std::nullopt;
  const auto rough = by_leapfrog(scene, {scene.step, run.duration, run.samples});
  const auto span = rough ? followed(scene, *rough) : std::nullopt;
  if (!span || span->end <= span->touch) return std::nullopt;
  const int end = span->end;
  std::optional<Trajectory> paths[3];
  double h = scene.step / 4;
  for (auto& path : paths) {
    h /= 2;
    if (!(path = by_leapfrog(scene, {h, run.duration * end / run.samples, end}))) return std::nullopt;
  }
  const auto& [coarse, middle, fine] = paths;

  Truth truth{Tier::converged, "", {}, 1e-15 * scene.size()};
  truth.of_contact_rule = true;
  // a rounding of each step's positions at worst: what is below it tells nothing of the order
  const double noise = std::numeric_limits<double>::epsilon() * scene.size() * run.duration / h;
  double before = 0, last = 0, motion = 0, least = 4;
  for (int i = 0; i <= end; ++i) {
    before = std::max(before, rms_distance(coarse->x[i], middle->x[i]));
    last = std::max(last, rms_distance(middle->x[i], fine->x[i]));
    const double ratio = last > noise ? before / last : 2;
    if (!(ratio >= 1.5)) break;
    least = std::min(least, ratio);
    motion = std::max(motion, rms_distance(fine->x[i], fine->x[0]));
    truth.bar = std::max(truth.bar, last / (std::min(ratio, 2.0) - 1));
    truth.bars.push_back(truth.bar);
    truth.until = fine->t[i];
  }
  // what ends before anything was touched for a while tells nothing of contact
  if (static_cast<int>(truth.bars.size()) <= span->touch + 1 || !(truth.bar < 0.01 * motion)) return std::nullopt;
  truth.trajectory = std::move(*paths[2]);
  truth.trajectory.t.resize(truth.bars.size());
  truth.trajectory.x.resize(truth.bars.size());
  truth.trajectory.v.resize(truth.bars.size());
  truth.how = fmt::format(
      "mysim/leapfrog at {:.3g} ms, converged in the step (to order {:.2g} at least) under the in-house contact rule; "
      "other rules differ",
      1e3 * h, std::log2(least));
  return truth;
}

}  // namespace crosscheck
