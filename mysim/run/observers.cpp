#include "mysim/run/observers.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "mysim/base/errors.h"
#include "mysim/model/system.h"
#include "mysim/run/engine.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

double rms_distance(const Points& a, const Points& b) { return (a - b).norm() / std::sqrt(double(a.cols())); }

double largest_rms_distance(const Trajectory& a, const Trajectory& b, double until) {
  double largest = 0;
  for (int i = 0; i < std::min(a.frames(), b.frames()) && a.t[i] <= until * (1 + 1e-9); ++i)
    largest = std::max(largest, rms_distance(a.x[i], b.x[i]));
  return largest;
}

void Integral::add(double value, double h) {
  assert(count_ == 0 || h > 0);
  last_ = {value, last_[0], last_[1], last_[2]};
  const auto& [p0, p1, p2, p3] = last_;
  switch (count_++) {
    case 0:
      break;
    case 1:
      value_ = h / 2 * (p1 + p0);
      break;
    case 2:
      value_ = h / 3 * (p2 + 4 * p1 + p0);
      break;
    case 3:
      value_ = 3 * h / 8 * (p3 + 3 * p2 + 3 * p1 + p0);
      break;
    default:
      value_ += h / 24 * (9 * p0 + 19 * p1 - 5 * p2 + p3);
  }
}

Ledger::Ledger(const Model& model, ContactLoss contact)
    : model_(model), inferred_(contact != ContactLoss::reported && has_contact(model)) {
  estimated_ = contact == ContactLoss::sampled && (model.find<Drag>() || model.find<Dashpots>() || model.find<Wind>() ||
                                                   model.find<Aerodynamics>() || model.particles.move);
  scratch_.f = Points::Zero(3, model.particles.size());
}

LedgerRow Ledger::now(const State& state) const {
  return {state.t, energy_of(model_, state), drag_.value(), dashpots_.value(), contact_, wind_.value(), pins_.value()};
}

Verdict Ledger::observe(const State& state, bool sample) {
  if (state.v.cols() != state.x.cols()) return Verdict::ok;
  const Power power = power_of(model_, state, scratch_);
  const double h = state.t - last_t_;
  drag_.add(power.drag, h);
  dashpots_.add(power.dashpots, h);
  wind_.add(power.wind, h);
  pins_.add(power.pins, h);
  last_t_ = state.t;
  if (sample) {
    rows_.push_back(now(state));
    if (inferred_) rows_.back().contact = rows_.front().balance() - rows_.back().balance();
  }
  return Verdict::ok;
}

namespace {

class MotionBoundsObserver : public Observer {
 public:
  explicit MotionBoundsObserver(const Scene& scene) : scene_(scene) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool sample) override {
    if (!state.x.allFinite() || !state.v.allFinite()) return Verdict::nan;
    const Particles& particles = scene_.model.particles;
    double fastest = 0;  // m^2/s^2
    for (int i = 0; i < particles.size(); ++i)
      if (!particles.pinned[i]) fastest = std::max(fastest, state.v.col(i).squaredNorm());
    so_far_.speed = std::max(so_far_.speed, std::sqrt(fastest));
    so_far_.stretch = std::max(so_far_.stretch, largest_length_ratio(scene_.model, scene_.start, state.x));
    if (sample) until[state.t] = so_far_;
    return Verdict::ok;
  }
  std::map<double, MotionBounds> until;  // time of a sample (s) -> bounds up to this sample

 private:
  const Scene& scene_;
  MotionBounds so_far_;
};

/// Fastest decay rate (1/s) that drag and dashpots can cause, by the largest row sum (S. Gershgorin, 1931).
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

double largest_length_ratio(const Model& model, const State& start, const Points& x) {
  const auto* springs = model.find<Springs>();
  double most = 0;  // squared ratio: needs no root, and no division except for the longest spring so far
  if (springs)
    for (const Spring& s : springs->list) {
      const double rest = s.rest > 0 ? s.rest * s.rest : (start.x.col(s.a) - start.x.col(s.b)).squaredNorm(),
                   length = (x.col(s.a) - x.col(s.b)).squaredNorm();
      if (rest > 0 && length > most * rest) most = length / rest;
    }
  return std::sqrt(most);
}

namespace {

/// Bounds on the motion from the start to each sample; the key is the sample's time (s). Empty if leapfrog cannot run
/// the scene, or fails.
std::map<double, MotionBounds> motion_bounds_over_time(const Scene& scene, const Run& run) {
  const auto rules = steppers();
  const Stepper& rule =
      *std::find_if(rules.begin(), rules.end(), [](const Stepper& s) { return s.name == "leapfrog"; });
  const double omega = highest_frequency_bound(scene.model, scene.start), decay = fastest_decay(scene.model),
               limit = std::min(rule.limit(omega, 0), rule.limit(omega, decay));
  const double sampling = run.duration / run.samples;
  const Run fine{std::min(std::isfinite(limit) ? limit / 4 : sampling, sampling / 4), run.duration, run.samples, 1e-6,
                 false};
  MotionBoundsObserver observer(scene);
  try {
    if (simulate(rule, ContactRule::coulomb, scene, fine, observer).verdict != Verdict::ok) return {};
  } catch (const Unsupported&) {
    return {};
  } catch (const InputError&) {  // more steps than a run may have
    return {};
  }
  return std::move(observer.until);
}

}  // namespace

std::optional<MotionBounds> motion_bounds_of(const Scene& scene, const Run& run) {
  const auto until = motion_bounds_over_time(scene, run);
  return until.empty() ? std::nullopt : std::optional(until.rbegin()->second);
}

std::optional<MotionBounds> MotionBoundsCache::operator()(const Scene& scene, const Run& run) {
  if (run.duration >= none_from_) return std::nullopt;
  const double end = run.duration * (1 - 1e-9);
  if (until_.empty() || until_.rbegin()->first < end) {
    auto longer = motion_bounds_over_time(scene, run);
    if (longer.empty()) {
      none_from_ = run.duration;
      return std::nullopt;
    }
    until_ = std::move(longer);
  }
  return until_.lower_bound(end)->second;
}

DivergenceMonitor::DivergenceMonitor(const Scene& scene, const Run& run, MotionBoundsFunction bounds)
    : DivergenceMonitor(scene.model, &scene.start) {
  true_motion_bounds_ = [&scene, &run, bounds = std::move(bounds)] { return bounds(scene, run); };
  const TimeGrid grid = time_grid(run);
  interval_ = verdict_stride(grid, scene.model.particles.size()) * grid.h;
}

DivergenceMonitor::DivergenceMonitor(const Model& model, const State* start) : model_(model) {
  if (start) start_ = *start;
  for (const Surface& s : surfaces_of(model))
    if (s.moving()) {
      // a particle leaves with at most (1 + e) times the surface's speed; springs may receive as much energy again
      const double speed = (1 + s.restitution) * s.max_speed();
      moving_surface_energy_ += model.particles.mass.sum() * speed * speed;
    }
  if (model.find<Wind>() || model.find<Aerodynamics>() || model.particles.move)
    ledger_.emplace(model, ContactLoss::reported);
}

void DivergenceMonitor::begin(const State& state) {
  begun_ = true;
  if (!start_) start_ = state;
  if (start_->v.cols() != start_->x.cols()) start_->v = Points::Zero(3, start_->x.cols());
  State& start = *start_;
  const Particles& particles = model_.particles;
  // An engine that pushes a resting particle out of a contact gives it a small speed: at most that of a fall through
  // 1/256 of the scene's extent or of the smallest radius, whichever is less. A plane has no length of its own.
  if (const auto* gravity = model_.find<Gravity>(); gravity && has_contact(model_)) {
    const double extent = (start.x.rowwise().maxCoeff() - start.x.rowwise().minCoeff()).norm();
    double length = extent > 0 ? extent : std::numeric_limits<double>::infinity();
    for (const Surface& s : surfaces_of(model_)) length = std::min(length, s.radius());
    const double fall = std::isfinite(length) ? length / 256 * gravity->acceleration.norm() : 0;
    contact_energy_ = particles.mass.sum() * fall;
    contact_speed_ = std::sqrt(2 * fall);
  }
  const Energy energy = energy_of(model_, start);
  initial_energy_ = energy.kinetic + energy.elastic + moving_surface_energy_ + contact_energy_;
  initial_gravitational_ = energy.gravitational;
  System system(model_);
  Points a(3, start.x.cols());
  system.acceleration(start, a);
  // single precision stores a position to 6e-8 of its coordinates; five such errors in two steps do not count as motion
  const double known = position_rounding_ = 5 * 6e-8 * start.x.cwiseAbs().maxCoeff();
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) {
      squared_acceleration_ += particles.mass[i] * a.col(i).squaredNorm();
      squared_rounding_ += particles.mass[i] / 2 * 3 * known * known;
    }
  initial_length_ratio_ = std::max(1., largest_length_ratio(model_, start, start.x));
  if (ledger_) ledger_->observe(start, false);
}

bool DivergenceMonitor::frozen(const State& state) {
  const State start = std::move(*first_);
  first_.reset();
  freeze_checked_ = true;
  if (model_.find<Constraints>()) return false;
  const bool velocities = state.v.cols() == state.x.cols();
  for (int i = 0; i < start.x.cols(); ++i)
    if (!model_.particles.pinned[i] &&
        (state.x.col(i) != start.x.col(i) || (velocities && state.v.col(i) != start.v.col(i))))
      return false;
  System system(model_);
  State stage = *start_;
  Points a(3, stage.x.cols());
  system.acceleration(stage, a);
  const std::vector<Surface> surfaces = surfaces_of(model_);
  // tolerance: a few single-precision roundings, or a fraction of the expected displacement if all coordinates are near
  // 0
  const auto touches = [&](const Vec3& x, double way) {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) {
      const Vec3 origin = s.origin_at(start.t);
      return s.gap(x - origin) < 1e-6 * (s.rounding_scale(origin, x.norm()) + way);
    });
  };
  // A displacement must exceed the rounding of coordinates (in single precision if there are no velocities to show
  // smaller motion). It must also exceed the rounding of balanced forces: some roundings of omega^2 times a coordinate.
  const double t = state.t - start.t, omega = highest_frequency_bound(model_, start),
               seen = start.x.cwiseAbs().maxCoeff() * ((velocities ? 1e-12 : 1e-6) + 1e-15 * omega * omega * t * t);
  for (int i = 0; i < start.x.cols(); ++i)
    if (const double way = (start_->v.col(i) * t + a.col(i) * (t * t / 2)).norm();
        !model_.particles.pinned[i] && way > seen && !touches(start.x.col(i), way))
      return true;
  return false;
}

Verdict DivergenceMonitor::moves_too_fast(const State& state) {
  const Particles& particles = model_.particles;
  const double span = state.t - before_.t, h = span / 2;
  assert(span > 0);
  double kinetic = 0, furthest = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) {
      const double square = (state.x.col(i) - before_.x.col(i)).squaredNorm();
      kinetic += particles.mass[i] / 2 * square, furthest = std::max(furthest, square);
    }
  kinetic /= span * span;
  largest_speed_ = std::max(largest_speed_, (std::sqrt(furthest) - position_rounding_) / span);
  if (const auto* gravity = model_.find<Gravity>())
    gravitational_change_ = std::max(gravitational_change_,
                                     std::abs(potential_energy(*gravity, particles, state) - initial_gravitational_));
  if (ledger_) {
    State middle{last_.t, last_.x, (state.x - before_.x) / span};
    particles.place_pins(middle);
    ledger_->observe(middle, false);
    external_work_ = std::max(external_work_, std::abs(ledger_->external_work()));
  }
  const double available = initial_energy_ + gravitational_change_ + external_work_ +
                           2 * h * h * squared_acceleration_ + squared_rounding_ / (span * span);
  if (!std::isfinite(kinetic) || !std::isfinite(available)) return Verdict::nan;
  if (available > 0) largest_ratio_ = std::max(largest_ratio_, kinetic / available);
  if (kinetic > (true_motion_bounds_ ? ratio_blown_up : ratio_suspect) * available) return Verdict::energy;
  return bounds_ && beyond_bounds() == Verdict::energy ? Verdict::energy : Verdict::ok;
}

Verdict DivergenceMonitor::beyond_bounds() const {
  if (largest_speed_ > allowed * std::max(bounds_->speed, contact_speed_)) return Verdict::energy;
  return largest_length_ratio_ > allowed * std::max(bounds_->stretch, 1.) ? Verdict::stretch : Verdict::ok;
}

Verdict DivergenceMonitor::goes_too_far() {
  if (true_motion_bounds_ && !bounds_ &&
      (largest_ratio_ > ratio_in_order || largest_length_ratio_ > length_bound * initial_length_ratio_)) {
    bounds_ = true_motion_bounds_();
    if (!bounds_) true_motion_bounds_ = nullptr;
  }
  if (bounds_) return beyond_bounds();
  if (true_motion_bounds_) return Verdict::ok;
  // here no bounds of the true motion are known
  if (largest_ratio_ > ratio_suspect) return Verdict::energy;
  return largest_length_ratio_ > allowed * length_bound * initial_length_ratio_ ? Verdict::stretch : Verdict::ok;
}

Verdict DivergenceMonitor::observe(const State& state, bool sample) {
  // numbers with an infinite square fail too, because errors and energies are sums of squares
  if (!std::isfinite(state.x.squaredNorm()) || !std::isfinite(state.v.squaredNorm())) return Verdict::nan;
  if (model_.first_order()) return Verdict::ok;  // no energy
  if (!begun_) begin(state);
  const Verdict moves = seen_ >= 2 ? moves_too_fast(state) : Verdict::ok;
  std::swap(before_, last_);
  last_.t = state.t, last_.x = state.x;
  ++seen_;
  if (moves != Verdict::ok) return moves;
  largest_length_ratio_ = std::max(largest_length_ratio_, largest_length_ratio(model_, *start_, state.x));
  if (!sample) return Verdict::ok;
  if (!first_ && !freeze_checked_)
    first_ = state;
  else if (first_ && frozen(state))
    return Verdict::frozen;
  return goes_too_far();
}

bool MonitoredObservers::every_step() const {
  return std::any_of(others_.begin(), others_.end(), [](const Observer* o) { return o->every_step(); });
}

Verdict MonitoredObservers::observe(const State& state, bool sample) {
  const bool due = sample || monitor_.due(state.t);
  Verdict first = Verdict::ok;
  for (Observer* o : others_)
    if (sample || o->every_step() || (due && o->between_samples()))
      if (const Verdict v = o->observe(state, sample); first == Verdict::ok) first = v;
  const Verdict own = due ? monitor_.observe(state, sample) : Verdict::ok;
  return first == Verdict::ok ? own : first;
}

void MonitoredObservers::contact(double lost) {
  for (Observer* o : others_) o->contact(lost);
}

}  // namespace crosscheck
