// Paths from the pins, and the bound that follows.
#include "mysim/observers/stretch.h"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace crosscheck {
namespace {

struct Link {
  int to;
  double length;  // m, at rest
};

/// Room for round-off, of a bound that no true motion comes near.
constexpr double room = 1 + 1e-9;

}  // namespace

StretchBound::StretchBound(const Model& model, const State& start) : model_(model) {
  const auto* springs = model.find<Springs>();
  const Particles& particles = model.particles;
  if (!springs || particles.pins.empty()) return;
  const int n = particles.size();
  std::vector<std::vector<Link>> links(n);
  double softest = std::numeric_limits<double>::infinity();
  for (const Spring& s : springs->list) {
    softest = std::min(softest, s.k);
    links[s.a].push_back({s.b, s.rest});
    links[s.b].push_back({s.a, s.rest});
  }
  if (const auto* constraints = model.find<Constraints>())
    for (const auto& [a, b, length] : constraints->list) {
      links[a].push_back({b, length});
      links[b].push_back({a, length});
    }

  // shortest paths from the pins (E. W. Dijkstra, 1959)
  struct Reached {
    double length = std::numeric_limits<double>::infinity();
    int pin = -1, hops = 0;
  };
  std::vector<Reached> reached(n);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const int pin : particles.pins) {
    reached[pin] = {0, pin, 0};
    open.push({0, pin});
  }
  while (!open.empty()) {
    const auto [length, at] = open.top();
    open.pop();
    if (length > reached[at].length) continue;
    for (const Link& link : links[at])
      if (length + link.length < reached[link.to].length) {
        reached[link.to] = {length + link.length, reached[at].pin, reached[at].hops + 1};
        open.push({length + link.length, link.to});
      }
  }
  double deepest = 0;
  int hops = 0;
  for (int i = 0; i < n; ++i) {
    if (particles.pinned[i]) continue;
    if (reached[i].pin < 0) return;
    deepest = std::max(deepest, reached[i].length + (start.x.col(i) - start.x.col(reached[i].pin)).norm());
    hops = std::max(hops, reached[i].hops);
    if (const auto* gravity = model.find<Gravity>()) weight_ += particles.mass[i] * gravity->acceleration.norm();
  }
  if (particles.move) deepest += 2 * particles.move->amplitude.norm();
  sunk_ = weight_ * deepest + hops * weight_ * weight_ / (2 * softest);
  active_ = std::isfinite(sunk_);
}

bool StretchBound::exceeded(const State& state, double energy) const {
  if (!active_) return false;
  for (const Spring& s : model_.find<Springs>()->list) {
    const double most = (weight_ + std::sqrt(weight_ * weight_ + 2 * s.k * (energy + sunk_))) / s.k;
    if ((state.x.col(s.a) - state.x.col(s.b)).norm() > (s.rest + most) * room) return true;
  }
  return false;
}

}  // namespace crosscheck
