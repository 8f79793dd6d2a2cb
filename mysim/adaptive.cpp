// Step control (E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, II.4; proportional
// and integral parts as in II of the same, IV.2).
#include "mysim/adaptive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/errors.h"

namespace crosscheck {

AdaptiveWorld::AdaptiveWorld(const Scene& scene, const Run& run, ContactRule contact)
    : scene_(scene),
      f_(scene.model),
      contacts_(scene.model, contact),
      pair_(scene.start),
      tolerance_(run.tolerance),
      h_(std::min(run.step, run.duration)),
      fastest_(largest_column(scene.start.v)),
      before_(scene.start),
      s_(scene.start),
      seen_(scene.start) {}

/// Root mean square over the particles of estimated over allowed error.
double AdaptiveWorld::error_ratio() {
  const State &error = pair_.error(), &next = pair_.next();
  const auto part = [&](const Points& e, const Points& from, const Points& to, double scale) {
    double sum = 0;
    for (int i = 0; i < e.cols(); ++i) {
      const double allowed = tolerance_ * (scale + std::max(from.col(i).norm(), to.col(i).norm()));
      sum += e.col(i).squaredNorm() / (allowed * allowed);
    }
    return e.cols() > 0 ? sum / static_cast<double>(e.cols()) : 0;
  };
  // from rest: the speed that the forces at the start give in the step
  const double speed = std::max({fastest_, pair_.first_step_speed(), 1e-300});
  return std::sqrt(std::max(part(error.x, s_.x, next.x, scene_.size()), part(error.v, s_.v, next.v, speed)));
}

/// One accepted step that ends at `limit` at the latest.
void AdaptiveWorld::advance(double limit) {
  constexpr double safety = 0.9, most = 5, least = 0.2, integral = 0.04, proportional = 0.2 - 0.75 * integral;
  contacts_.begin(s_);
  double room = most;
  for (;;) {
    // a step that would leave a sliver before the limit takes the whole way
    const double h = s_.t + 1.01 * h_ >= limit ? limit - s_.t : h_;
    if (!(h > 1e-14 * std::max(1.0, s_.t)))
      throw SolverFailure(fmt::format("the step fell below round-off at t = {:.4g} s", s_.t));
    pair_.attempt(f_, s_, h);
    const double ratio = error_ratio();
    if (ratio <= 1) {
      before_ = s_;
      s_ = pair_.next();
      fastest_ = std::max(fastest_, largest_column(s_.v));
      s_.t = h == h_ ? before_.t + h : limit;
      last_h_ = h;
      const double kept = std::max(ratio, 1e-10);
      const double factor = safety * std::pow(kept, -proportional) * std::pow(last_ratio_, integral);
      // a step cut short to end at the limit says nothing against the one that was planned
      h_ = std::max(h == h_ ? 0.0 : h_, h * std::clamp(factor, least, room));
      last_ratio_ = std::max(ratio, 1e-4);
      ++accepted_;
      return;
    }
    h_ = h * (std::isfinite(ratio) ? std::max(least, safety * std::pow(ratio, -0.2)) : 0.1);
    room = 1;  // no growth right after a rejection
  }
}

void AdaptiveWorld::step(double, double t_next) {
  const Particles& particles = scene_.model.particles;
  constexpr double far = 1e300;
  lost_.reset();
  while (s_.t < t_next) {
    if (accepted_ > 0) pair_.accept();
    advance(contacts_.any() ? t_next : far);
    if (contacts_.any()) {
      particles.place_pins(s_);
      if (!contacts_.resolve(s_)) continue;
      pair_.forget();
      lost_ = lost_.value_or(0) + *contacts_.lost();
    }
  }
}

const State& AdaptiveWorld::state(double t) {
  if (contacts_.any() || accepted_ == 0) return s_;
  pair_.interpolate(before_, last_h_, (t - before_.t) / last_h_, seen_);
  seen_.t = t;
  if (!scene_.model.first_order()) scene_.model.particles.place_pins(seen_);
  return seen_;
}

}  // namespace crosscheck
