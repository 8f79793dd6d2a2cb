#include "report/lab/live_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/run/contacts.h"

namespace crosscheck {

double LiveRun::omega() const {
  if (!omega_) omega_ = scene_.model.first_order() ? 0 : highest_frequency(scene_.model, scene_.start);
  return *omega_;
}

std::optional<double> LiveRun::critical_step(const Stepper& stepper) const {
  const std::optional<double> gamma = uniform_drag_rate(scene_.model);
  if (scene_.model.first_order() || stepper.adaptive || !gamma || (omega() == 0 && *gamma == 0)) return std::nullopt;
  return stepper.limit(omega(), *gamma);
}

void LiveRun::start(const Settings& settings) {
  const std::vector<std::string> words = split(settings.rule, '+');
  std::vector<std::string> names;
  for (const Stepper& stepper : steppers()) names.emplace_back(stepper.name);
  const auto found = std::find(names.begin(), names.end(), words[0]);
  if (found == names.end())
    throw InputError(fmt::format("unknown stepper '{}'{}", words[0], did_you_mean(words[0], names)));
  Stepper rule = steppers()[found - names.begin()];
  ContactRule contact = ContactRule::coulomb;
  for (size_t i = 1; i < words.size(); ++i) {
    if (const auto asked = contact_rule_of_option(words[i]);
        asked && (asked != ContactRule::events || locates_events(rule)))
      contact = *asked;
    else if (words[i] == "linear" && rule.linear)
      rule.step = rule.linear;
    else
      refuse_option(words[0], words[i],
                    rule.linear            ? "+linear, +sticky or none"
                    : locates_events(rule) ? "+events, +sticky or none"
                                           : "+sticky or none");
  }
  rule_ = rule, contact_ = contact, keep_ledger_ = settings.keep_ledger;
  const double interval = scene_.duration / scene_.samples;
  const double samples = std::max(1.0, std::round(settings.duration / interval));
  run_ = {.step = settings.step,
          .duration = samples == scene_.samples ? scene_.duration : samples * interval,
          .samples = static_cast<int>(samples),
          .tolerance = settings.tolerance,
          .timed = false};
  begin();
}

void LiveRun::begin() {
  loop_.reset(), world_.reset(), observers_.reset(), ledger_.reset(), monitor_.reset();
  // bounds cover the scene's own duration, even if the run is shorter or longer
  const auto bounds = [this](const Scene& scene, const Run&) { return bounds_(scene, default_run(scene)); };
  monitor_ = std::make_unique<DivergenceMonitor>(scene_, run_, bounds);
  std::vector<Observer*> others;
  if (keep_ledger_ && !scene_.model.first_order()) {
    ledger_ = std::make_unique<Ledger>(scene_.model, ContactLoss::reported);
    others.push_back(ledger_.get());
  }
  observers_ = std::make_unique<MonitoredObservers>(*monitor_, std::move(others));
  world_ = make_world(rule_, contact_, scene_, run_, *observers_);
  loop_ = std::make_unique<RunLoop>(*world_, run_, *observers_);
}

bool LiveRun::advance(double t, int most) {
  // the loop's time is a sum of steps, and subject to rounding
  const double reached = t - 1e-9 * run_.step;
  for (int i = 0; i < most && !loop_->ended() && loop_->time() < reached; ++i) loop_->step();
  return !loop_->ended();
}

std::optional<LedgerRow> LiveRun::energies() const {
  if (scene_.model.first_order()) return std::nullopt;
  if (ledger_) return ledger_->now(state());
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return LedgerRow{time(), energy_of(scene_.model, state()), unknown, unknown, unknown, unknown, unknown};
}

template <class Change>
void LiveRun::go_on(const Change& change) {
  State now = state();
  now.t = 0;
  const double t = time();
  loop_.reset(), world_.reset();
  scene_.start = std::move(now);
  if (auto* spheres = scene_.model.find<Spheres>())
    for (Sphere& sphere : spheres->list) sphere.centre = sphere.centre_at(t);
  if (auto* planes = scene_.model.find<Planes>())
    for (Plane& plane : planes->list) plane.point = plane.point_at(t);
  change();
  Particles& particles = scene_.model.particles;
  particles.pins.clear();
  for (int i = 0; i < particles.size(); ++i)
    if (particles.pinned[i]) particles.pins.push_back(i);
  particles.pin_home = scene_.start.x(Eigen::seqN(0, 3), particles.pins);
  for (const int pin : particles.pins)
    if (scene_.start.v.cols() > 0) scene_.start.v.col(pin).setZero();
  omega_.reset(), bounds_ = {};
  begin();
}

void LiveRun::hold(int particle, const Vec3& place) {
  if (held_ >= 0 && held_ != particle) release();
  go_on([&] {
    if (!scene_.model.particles.pinned[particle]) held_ = particle;
    scene_.model.particles.pinned[particle] = 1;
    scene_.start.x.col(particle) = place;
  });
}

void LiveRun::release() {
  if (held_ < 0) return;
  go_on([&] { scene_.model.particles.pinned[held_] = 0; });
  held_ = -1;
}

void LiveRun::set_pinned(int particle, bool pinned) {
  if (held_ == particle) held_ = -1;
  go_on([&] { scene_.model.particles.pinned[particle] = pinned; });
}

}  // namespace crosscheck
