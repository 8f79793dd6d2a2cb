// Thins trajectories and cuts what has left the picture.
#include "report/player/shown.h"

#include <fmt/format.h>

#include <algorithm>

namespace crosscheck {
namespace {

constexpr int most_places = 150 * 64 * 64;  // of one method: about a megabyte of the page
constexpr int fewest_frames = 25;
constexpr int numbers_of_16_bits = 1 << 16;

Shown thinned(const Answer* answer, const std::string& name, const Trajectory& path, int stride) {
  Shown shown{answer, name, {}, {}, {}};
  for (int i = 0; i < path.frames() && path.x[i].allFinite(); i += stride) {
    shown.t.push_back(path.t[i]);
    shown.x.push_back(path.x[i]);
    shown.v.push_back(i < std::ssize(path.v) ? path.v[i] : Points(3, 0));
  }
  return shown;
}

/// The farthest that a coordinate is from its start, m.
double moved(const Points& x, const Points& start) { return (x - start).cwiseAbs().maxCoeff(); }

/// A failed run is shown while it stays within three times the reach of the others: further out no camera sees it, and
/// the lattice of its places would be coarse.
void cut_failed(double size, std::vector<Shown>& all) {
  double reach = size;
  for (const Shown& s : all)
    for (const Points& x : s.x)
      if (s.ok()) reach = std::max(reach, moved(x, s.x[0]));
  for (Shown& s : all) {
    if (s.ok()) continue;
    size_t keep = 1;
    while (keep < s.x.size() && moved(s.x[keep], s.x[0]) < 3 * reach) ++keep;
    s.x.resize(keep), s.v.resize(keep), s.t.resize(keep);
  }
}

}  // namespace

int frame_stride(const Scene& scene) {
  const int particles = std::max(1, scene.model.particles.size());
  const int most = std::min(particles > 250 ? 150 : 300, most_places / particles);
  if (most < fewest_frames || particles >= numbers_of_16_bits) return 0;
  const int least = std::max(1, (scene.samples + most - 1) / most);
  for (int stride = least; stride < 2 * least; ++stride)
    if (scene.samples % stride == 0) return stride;
  return least;
}

Shown shown_of(const Truth& truth, int stride) {
  return thinned(nullptr,
                 truth.of_contact_rule ? "converged contact rule" : fmt::format("truth ({})", name_of(truth.tier)),
                 truth.trajectory, stride);
}

std::vector<Shown> shown_of(const Scene& scene, const std::vector<const Answer*>& answers,
                            const std::optional<Truth>& truth) {
  const int stride = frame_stride(scene);
  std::vector<Shown> all;
  if (stride == 0) return all;
  const auto add = [&](Shown shown) {
    if (!shown.x.empty()) all.push_back(std::move(shown));  // the first sample may fail already
  };
  for (const Answer* a : answers) add(thinned(a, a->method, a->trajectory, stride));
  if (truth && !all.empty()) add(shown_of(*truth, stride));
  cut_failed(scene.size(), all);
  return all;
}

Lattice lattice_of(const std::vector<Shown>& all) {
  if (!all.back().answer) return lattice_around(all.back().x);
  std::vector<Points> seen;
  for (const bool failed : {false, true})
    for (const Shown& s : all)
      if (s.ok() != failed && (!failed || seen.empty())) seen.insert(seen.end(), s.x.begin(), s.x.end());
  return lattice_around(seen);
}

}  // namespace crosscheck
