// Intersections of edges with triangles, found by a spatial hash.
#include "mysim/run/crossings.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace crosscheck {
namespace {

double volume(const Vec3& a, const Vec3& b, const Vec3& c) { return a.cross(b).dot(c); }

/// True if the edge from p to q passes through the triangle by more than a millionth of the lengths involved on both
/// sides. The limit is far above the rounding of the volumes, about 1e-15, and far below any visible depth.
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, normal = ab.cross(ac), d = q - p;
  const double above = normal.dot(p - a), below = normal.dot(q - a);
  if ((above > 0) == (below > 0)) return false;
  const double length = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), d.squaredNorm()}));
  if (std::min(std::abs(above), std::abs(below)) <= 1e-6 * length * length * length) return false;
  // the line passes all three sides of the triangle with the same orientation
  const double one = volume(d, a - p, b - p), two = volume(d, b - p, c - p), three = volume(d, c - p, a - p);
  return (one > 0 && two > 0 && three > 0) || (one < 0 && two < 0 && three < 0);
}

}  // namespace

CrossingDetector::CrossingDetector(std::vector<std::array<int, 3>> triangles) : triangles_(std::move(triangles)) {
  for (const auto& t : triangles_)
    for (int side = 0; side < 3; ++side) edges_.push_back(std::minmax(t[side], t[(side + 1) % 3]));
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  begin_.assign(std::bit_ceil(4 * triangles_.size() + 2), 0);
  last_edge_.resize(triangles_.size());
}

std::size_t CrossingDetector::bucket_of(const Cell& cell) const {
  // M. Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects (VMV 2003)
  const auto part = [&](int axis, std::uint32_t prime) { return static_cast<std::uint32_t>(cell.at[axis]) * prime; };
  return (part(0, 73856093u) ^ part(1, 19349663u) ^ part(2, 83492791u)) % (begin_.size() - 1);
}

template <class Visit>
void CrossingDetector::for_each_cell(const Vec3& low, const Vec3& high, const Visit& visit) const {
  Cell from, to, at;
  for (int axis = 0; axis < 3; ++axis) {
    from.at[axis] = static_cast<int>(std::floor(low[axis] / cell_));
    to.at[axis] = static_cast<int>(std::floor(high[axis] / cell_));
  }
  for (at.at[0] = from.at[0]; at.at[0] <= to.at[0]; ++at.at[0])
    for (at.at[1] = from.at[1]; at.at[1] <= to.at[1]; ++at.at[1])
      for (at.at[2] = from.at[2]; at.at[2] <= to.at[2]; ++at.at[2]) visit(bucket_of(at));
}

int CrossingDetector::piercing_edges(const Points& x) {
  if (edges_.empty() || !x.allFinite()) return 0;
  double mean = 0, longest = 0;
  for (const auto& [a, b] : edges_) {
    const double length = (x.col(a) - x.col(b)).norm();
    mean += length / static_cast<double>(edges_.size()), longest = std::max(longest, length);
  }
  // in cells of this size, a triangle covers at most 5 cells along an axis, and cell indices fit into 31 bits
  cell_ = std::max({mean, longest / 4, x.cwiseAbs().maxCoeff() * 0x1p-30});
  if (!(cell_ > 0)) return 0;
  std::fill(begin_.begin(), begin_.end(), 0);
  unsorted_.clear();
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
    const Vec3 a = x.col(triangles_[i][0]), b = x.col(triangles_[i][1]), c = x.col(triangles_[i][2]);
    for_each_cell(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), [&](std::size_t bucket) {
      ++begin_[bucket];
      unsorted_.emplace_back(bucket, i);
    });
  }
  for (std::size_t bucket = 1; bucket < begin_.size(); ++bucket) begin_[bucket] += begin_[bucket - 1];
  entries_.resize(unsorted_.size());
  for (const auto& [bucket, i] : unsorted_) entries_[--begin_[bucket]] = i;
  std::fill(last_edge_.begin(), last_edge_.end(), -1);
  int piercing = 0;
  for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
    const int p = edges_[e].first, q = edges_[e].second;
    const Vec3 from = x.col(p), to = x.col(q);
    bool found = false;
    for_each_cell(from.cwiseMin(to), from.cwiseMax(to), [&](std::size_t bucket) {
      for (int k = begin_[bucket]; k < begin_[bucket + 1] && !found; ++k) {
        const int i = entries_[k];
        const auto& [a, b, c] = triangles_[i];
        if (last_edge_[i] == e || a == p || b == p || c == p || a == q || b == q || c == q) continue;
        last_edge_[i] = e;
        found = pierces(from, to, x.col(a), x.col(b), x.col(c));
      }
    });
    piercing += found;
  }
  return piercing;
}

CrossingObserver::CrossingObserver(const Scene& scene, int samples)
    : detector_(scene.triangles),
      has_surface_(!scene.triangles.empty()),
      left_(samples),
      stride_((samples + 31) / 32) {}

Verdict CrossingObserver::observe(const State& state, bool sample) {
  if (!has_surface_ || !sample || left_-- % stride_ != 0) return Verdict::ok;
  if (const int now = detector_.piercing_edges(state.x); now > 0) {
    if (most_ == 0) first_ = state.t;
    most_ = std::max(most_, now);
  }
  return Verdict::ok;
}

void CrossingObserver::note(Outcome& outcome) const {
  if (most_ == 0) return;
  outcome.remark += fmt::format(
      "{}the surface crosses itself, first seen at {:.4g} s, with at most {} edges at a time: "
      "self-contact of cloth is not modelled",
      outcome.remark.empty() ? "" : "; ", first_, most_);
}

}  // namespace crosscheck
