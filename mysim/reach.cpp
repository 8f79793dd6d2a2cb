// A run of our own beside the one in doubt.
#include "mysim/reach.h"

#include <algorithm>
#include <cmath>

#include "mysim/engine.h"
#include "mysim/errors.h"
#include "mysim/frequency.h"
#include "mysim/steppers/stepper.h"

namespace crosscheck {
namespace {

class ReachObserver : public Observer {
 public:
  explicit ReachObserver(const Scene& scene) : scene_(scene) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    if (!state.x.allFinite() || !state.v.allFinite()) return Verdict::nan;
    const Particles& particles = scene_.model.particles;
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i]) reach.speed = std::max(reach.speed, state.v.col(i).norm());
    reach.stretch = std::max(reach.stretch, largest_stretch(scene_.model, scene_.start, state.x));
    return Verdict::ok;
  }
  Reach reach;

 private:
  const Scene& scene_;
};

/// The fastest decay that drag and dashpots can give, 1/s, by the largest row sum (S. Gershgorin, 1931).
double fastest_decay(const Model& model) {
  const Particles& particles = model.particles;
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(particles.size());
  if (const auto* drag = model.find<Drag>()) rate += Eigen::VectorXd(drag->c).cwiseQuotient(particles.mass);
  if (const auto* dashpots = model.find<Dashpots>())
    for (const auto& d : dashpots->list)
      for (const auto& [a, b] : {std::pair{d.a, d.b}, std::pair{d.b, d.a}})
        rate[a] += d.c / particles.mass[a] +
                   (particles.pinned[b] ? 0 : d.c / std::sqrt(particles.mass[a] * particles.mass[b]));
  for (const int pin : particles.pins) rate[pin] = 0;
  return rate.size() > 0 ? rate.maxCoeff() : 0;
}

}  // namespace

double largest_stretch(const Model& model, const State& start, const Points& x) {
  const auto* springs = model.find<Springs>();
  double most = 0;
  if (springs)
    for (const Spring& s : springs->list) {
      const double rest = s.rest > 0 ? s.rest : (start.x.col(s.a) - start.x.col(s.b)).norm();
      if (rest > 0) most = std::max(most, (x.col(s.a) - x.col(s.b)).norm() / rest);
    }
  return most;
}

std::optional<Reach> reach_of(const Scene& scene, const Run& run) {
  const auto rules = steppers();
  const Stepper& rule =
      *std::find_if(rules.begin(), rules.end(), [](const Stepper& s) { return s.name == "leapfrog"; });
  const double omega = stretched_frequency(scene.model, scene.start), decay = fastest_decay(scene.model),
               limit = std::min(rule.limit(omega, 0), rule.limit(omega, decay));
  const double sampling = run.duration / run.samples;
  const Run fine{std::min(std::isfinite(limit) ? limit / 4 : sampling, sampling / 4), run.duration, run.samples, 1e-6,
                 false};
  ReachObserver observer(scene);
  try {
    if (simulate(rule, ContactRule::coulomb, scene, fine, observer).verdict != Verdict::ok) return std::nullopt;
  } catch (const Unsupported&) {
    return std::nullopt;
  } catch (const InputError&) {  // more steps than a run may have
    return std::nullopt;
  }
  return observer.reach;
}

}  // namespace crosscheck
