// Two loops.
#include "experiments/regress/plain_loop.h"

#include <algorithm>
#include <cmath>

#include "mysim/clock.h"

namespace crosscheck {

PlainLoop::PlainLoop(const Scene& scene) : h_(1e-3 * scene.step) {
  const auto& particles = scene.model.particles;
  const auto n = static_cast<size_t>(particles.size());
  start_x_.assign(scene.start.x.data(), scene.start.x.data() + scene.start.x.size());
  start_v_.assign(scene.start.v.data(), scene.start.v.data() + scene.start.v.size());
  start_v_.resize(3 * n);  // first-order scenes have none
  force_.resize(3 * n);
  for (size_t i = 0; i < n; ++i) {
    per_mass_.push_back(particles.pinned[i] ? 0 : 1 / particles.mass[static_cast<Eigen::Index>(i)]);
    falls_.push_back(particles.pinned[i] ? 0 : 1);
  }
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) edges_.push_back({s.a, s.b, s.k, s.rest});
  if (const auto* gravity = scene.model.find<Gravity>())
    std::copy_n(gravity->acceleration.data(), 3, std::begin(gravity_));
}

double PlainLoop::seconds_of(long steps) {
  x_ = start_x_, v_ = start_v_;
  CpuClock clock;
  clock.start();
  advance(steps);
  clock.stop();
  return clock.seconds();
}

// aligned: what stands before it in the program must not change how fast it is
[[gnu::noinline, gnu::aligned(64)]] void PlainLoop::advance(long steps) {
  const size_t numbers = x_.size();
  for (long step = 0; step < steps; ++step) {
    std::fill(force_.begin(), force_.end(), 0.);
    for (const Edge& edge : edges_) {
      const double *a = &x_[3 * static_cast<size_t>(edge.a)], *b = &x_[3 * static_cast<size_t>(edge.b)];
      const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
      const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
      const double pull = length > 0 ? edge.stiffness * (length - edge.rest) / length : 0;
      double *on_a = &force_[3 * static_cast<size_t>(edge.a)], *on_b = &force_[3 * static_cast<size_t>(edge.b)];
      on_a[0] -= pull * dx, on_a[1] -= pull * dy, on_a[2] -= pull * dz;
      on_b[0] += pull * dx, on_b[1] += pull * dy, on_b[2] += pull * dz;
    }
    for (size_t i = 0; i < numbers; ++i) {
      v_[i] += h_ * (force_[i] * per_mass_[i / 3] + gravity_[i % 3] * falls_[i / 3]);
      x_[i] += h_ * v_[i];
    }
  }
}

}  // namespace crosscheck
