// Paths from the pins, and the bound that follows.
#include "mysim/observers/stretch.h"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>

namespace crosscheck {
namespace {

/// Springs and hard distances as one list, and which of them end at each particle: numbers only, as large cloths have
/// millions.
class Links {
 public:
  struct Link {
    int a, b;
    double length;  // m, at rest
  };

  Links(const Springs& springs, const Constraints* constraints, int particles)
      : springs_(springs), constraints_(constraints), begin_(particles + 1, 0) {
    const int count = static_cast<int>(springs.list.size() + (constraints ? constraints->list.size() : 0));
    at_.resize(2L * count);
    for (int i = 0; i < count; ++i) ++begin_[link(i).a], ++begin_[link(i).b];
    for (int i = 0, sum = 0; i <= particles; ++i) sum += begin_[i], begin_[i] = sum;  // where those of i end
    for (int i = 0; i < count; ++i) at_[--begin_[link(i).a]] = i, at_[--begin_[link(i).b]] = i;
  }

  Link link(int i) const {
    const int springs = static_cast<int>(springs_.list.size());
    if (i < springs) return {springs_.list[i].a, springs_.list[i].b, springs_.list[i].rest};
    const auto& [a, b, length] = constraints_->list[i - springs];
    return {a, b, length};
  }
  std::span<const int> at(int particle) const {
    return std::span(at_).subspan(begin_[particle], begin_[particle + 1] - begin_[particle]);
  }

 private:
  const Springs& springs_;
  const Constraints* constraints_;
  std::vector<int> begin_, at_;
};

/// What a stable symplectic rule's swing adds half a per cent below its limit: 1 / sqrt(1 - 0.995^2).
constexpr double swing = 10;

/// m/s^2.
double strongest(const Blowing& wind) {
  const auto& gusts = wind.gusts;
  return gusts ? (1 + std::abs(gusts->variation)) * wind.mean.norm() + gusts->side.norm() : wind.mean.norm();
}

}  // namespace

StretchBound::StretchBound(const Model& model, const State& start) : model_(model) {
  const auto* springs = model.find<Springs>();
  const Particles& particles = model.particles;
  if (!springs || particles.pins.empty() || model.find<Aerodynamics>()) return;
  const int n = particles.size();
  const Links links(*springs, model.find<Constraints>(), n);
  double softest = std::numeric_limits<double>::infinity();
  for (const Spring& s : springs->list) softest = std::min(softest, s.k);

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
    for (const int i : links.at(at)) {
      const Links::Link link = links.link(i);
      const int to = link.a == at ? link.b : link.a;
      if (length + link.length < reached[to].length) {
        reached[to] = {length + link.length, reached[at].pin, reached[at].hops + 1};
        open.push({length + link.length, to});
      }
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
    if (const auto* wind = model.find<Wind>()) weight_ += particles.mass[i] * strongest(wind->acceleration);
  }
  if (particles.move) led_ = 2 * particles.move->amplitude.norm();
  deepest += led_;
  sunk_ = weight_ * deepest + hops * weight_ * weight_ / (2 * softest);
  active_ = std::isfinite(sunk_);
}

bool StretchBound::exceeded(const State& state, double energy) const {
  if (!active_) return false;
  for (const Spring& s : model_.find<Springs>()->list) {
    const double most = (weight_ + std::sqrt(weight_ * weight_ + 2 * s.k * (energy + sunk_))) / s.k;
    if ((state.x.col(s.a) - state.x.col(s.b)).norm() > swing * (s.rest + most) + led_) return true;
  }
  return false;
}

}  // namespace crosscheck
