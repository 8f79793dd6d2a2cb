// Kicked runs, judged by growth, and the search for the largest step that holds.
#include "experiments/stability/trial.h"

#include <fmt/format.h>

#include <complex>
#include <map>

#include "mysim/uniform.h"

namespace crosscheck {
namespace {

/// Rates of a vibration, 1/s: the one that is fast and the other.
struct Rates {
  std::complex<double> fast, other;
};
Rates rates_of(const Vibration& m) {
  const std::complex<double> root = std::sqrt(std::complex<double>(m.gamma * m.gamma / 4 - m.omega * m.omega));
  return {-m.gamma / 2 - root, -m.gamma / 2 + root};
}

/// How far the scene is from rest, at the start, in the first and in the last tenth of the run; and, where each step
/// multiplies it, the kicked mode's amplitude at the start and now.
class Departure : public Observer {
 public:
  Departure(const Subject& subject, bool multiplies, int mode, double duration)
      : subject_(subject), duration_(duration), rotation_(multiplies && subject.scene.model.first_order()) {
    const Spectrum& s = subject.spectrum;
    if (multiplies && mode >= 0 && s.shapes.cols() > mode) {
      shape_ = s.shapes.col(mode);
      other_ = rates_of(s.modes[mode]).other;
    }
  }
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    const bool begins = state.t <= 0.1 * duration_, ends = state.t >= 0.9 * duration_ * (1 - 1e-12);
    if (begins || ends) {
      const double size = norm(state);
      if (kick == 0) kick = size;
      if (begins) first = std::max(first, size);
      if (ends) last = std::max(last, size);
    }
    if (rotation_ || (shape_.size() > 0 && state.v.cols() > 0)) {
      if (begins && start == 0) start = amplitude(state);
      if (ends) end = amplitude(state);
    }
    return Verdict::ok;
  }
  bool of_mode() const { return start > 0; }
  double kick = 0, first = 0, last = 0, start = 0, end = 0;

 private:
  double norm(const State& state) const {
    const Points off = state.x - subject_.scene.start.x;
    if (subject_.scene.model.first_order()) return off.norm();
    const Linearised& system = subject_.spectrum.system;
    const Eigen::VectorXd w = system.weighted(off);
    double sum = std::max(0.0, w.dot(system.k * w));
    if (state.v.cols() > 0) sum += system.weighted(state.v).squaredNorm();
    return std::sqrt(sum);
  }
  /// |w' - other w|, which the rule's factor at the fast rate multiplies in each step; |x| of a rotation.
  double amplitude(const State& state) const {
    if (rotation_) return norm(state);
    const Linearised& system = subject_.spectrum.system;
    const double w = shape_.dot(system.weighted(state.x - subject_.scene.start.x)),
                 rate = shape_.dot(system.weighted(state.v));
    return std::abs(rate - other_ * w);
  }

  const Subject& subject_;
  double duration_;
  bool rotation_;
  Eigen::VectorXd shape_;
  std::complex<double> other_;
};

}  // namespace

Subject subject_of(const Scene& scene) {
  Subject subject{scene, false, false, {}, scene.size()};
  const Equilibrium found = equilibrium_of(scene);
  subject.saddle = found.saddle;
  if (found.rest) {
    subject.scene.start = *found.rest;
    subject.at_rest = true;
  }
  subject.spectrum = spectrum_of(subject.scene, subject.scene.start);
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) {
      const double length = (subject.scene.start.x.col(s.a) - subject.scene.start.x.col(s.b)).norm();
      // where ends meet there is no scale: a kick of the root of the rounding of a millionth of the scene drowns in
      // the rounding of the scene
      if (length > 1e-6 * scene.size()) subject.spacing = std::min(subject.spacing, length);
    }
  return subject;
}

bool StepTrial::held() const {
  if (verdict != Verdict::ok && verdict != Verdict::frozen) return false;
  const double neutral = std::max(1e-9, 1e-6 / static_cast<double>(std::max(1L, steps)));
  return !(growth > 1.05) && !(of_mode && per_step > 1 + neutral);
}

Run run_of_trial(double h, long steps) {
  constexpr long samples = 100;
  const long per_sample = std::max(1L, steps / samples);
  Run run{h, h * static_cast<double>(per_sample * samples), samples};
  run.timed = false;
  return run;
}

Scene kicked(const Subject& subject, const Kick& kick) {
  Scene scene = subject.scene;
  if (!subject.at_rest) return scene;
  std::mt19937_64 engine(1);
  const Spectrum& s = subject.spectrum;
  const double size = kick.size * subject.spacing;
  if (scene.model.first_order()) {
    scene.start.x(0, 0) += size;
    return scene;
  }
  const bool of_mode = kick.mode >= 0 && s.shapes.cols() > kick.mode;
  const Eigen::VectorXd shape = of_mode ? Eigen::VectorXd(s.shapes.col(kick.mode)) : s.fastest;
  Points push = s.system.offsets(shape, scene.model.particles.size());
  push *= size / largest_column(push);
  scene.start.x += push;
  if (of_mode) scene.start.v += rates_of(s.modes[kick.mode]).fast.real() * push;
  // a thousandth in every direction: should another mode than the kicked one be unstable, it has what to grow from
  for (int i = 0; i < scene.start.x.cols(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double part = 1e-3 * size * (2 * uniform(engine) - 1);
      if (!scene.model.particles.pinned[i]) scene.start.x(axis, i) += part;
    }
  return scene;
}

StepTrial try_step(const Method& method, const Subject& subject, double h, long steps, const Kick& kick,
                   std::vector<Observer*> observers) {
  const Run run = run_of_trial(h, steps);
  const Stepper* rule = rule_of(method);
  const bool rotation = subject.scene.model.first_order(), one_factor = rotation || (rule && is_runge_kutta(*rule));
  const bool multiplies = subject.at_rest && subject.spectrum.commuting && one_factor;
  Departure departure(subject, multiplies, kick.mode, run.duration);
  if (subject.at_rest) observers.push_back(&departure);
  const Outcome out = run_method(method, kicked(subject, kick), run, observers);
  StepTrial trial{out.verdict, out.reason, out.end};
  // a rule of its own, and one that corrects positions spring by spring, may rest elsewhere, unless the scene turns
  // about the origin: what moves there is no growth
  const bool rests_there = rule && !rule->hard_constraints;
  if (departure.first > 0 && (rests_there || rotation)) {
    trial.growth = departure.last / departure.first;
    // What grows fast has reached the springs' nonlinearity within the first tenth and stays there. A stable mode
    // swings by 1 / sqrt(1 - (h / limit)^2) at most, which is 1000 at half a millionth below its limit: no search is as
    // fine.
    constexpr double largest_swing = 1000;
    if (departure.last > largest_swing * departure.kick) trial.growth = departure.last / departure.kick;
  }
  trial.of_mode = out.verdict == Verdict::ok && departure.of_mode();
  if (trial.of_mode) {
    trial.amplitude = departure.end / departure.start;
    trial.steps = out.steps;
    trial.per_step = std::exp(std::log(trial.amplitude) / static_cast<double>(std::max(1L, out.steps)));
  }
  return trial;
}

Measured largest_step(const std::function<bool(double)>& holds, double first, double lowest, double highest,
                      double precision, double fine_above) {
  Measured m;
  if (holds(first)) {
    m.held = first;
    const auto next = [&](double h) { return h * (h < fine_above || h > 5 * fine_above ? 2 : 1.1); };
    for (double h = next(first); m.failed == 0; h = next(h)) {
      if (h > highest) return {Measured::every_step, m.held, 0, ""};
      (holds(h) ? m.held : m.failed) = h;
    }
  } else {
    m.failed = first;
    for (double h = first / 2; m.held == 0; h /= 2) {
      if (h < lowest) return {Measured::no_step, 0, m.failed, ""};
      (holds(h) ? m.held : m.failed) = h;
    }
  }
  while (m.failed / m.held - 1 > precision) {
    const double middle = std::sqrt(m.held * m.failed);
    (holds(middle) ? m.held : m.failed) = middle;
  }
  return m;
}

Measured measured_limit(const Method& method, const Subject& subject, long steps, const Kick& kick, double precision) {
  const Spectrum& s = subject.spectrum;
  const double unit = s.omega > 0 ? 1 / s.omega : subject.scene.step;
  const bool damped = subject.scene.model.find<Drag>() || subject.scene.model.find<Dashpots>();
  std::map<double, std::string> refused;  // by step
  bool answered = false;
  const auto holds = [&](double h) {
    const StepTrial trial = try_step(method, subject, h, steps, kick);
    if (trial.unsupported()) refused[h] = trial.reason;
    answered |= !trial.unsupported();
    return trial.held();
  };
  // without drag a rule that grows at h omega = 1/64 does so at every step; with drag of a millionth of omega its limit
  // would still be seen
  const double lowest = unit / (damped ? 1 << 20 : 64), highest = 128 * unit;
  // from a radian to five of them a step in tenths: a composed rule holds again beyond a band where it does not
  // (suzuki4 at 4.05 radians, above its limit of 2.72), and doubling would step over it
  Measured m = largest_step(holds, std::clamp(subject.scene.step, lowest, highest), lowest, highest, precision, unit);
  if (refused.empty()) return m;
  if (!answered) return {Measured::unsupported, 0, 0, refused.begin()->second};
  m.reason = fmt::format("a step of {:.3g} s is refused: {}", refused.begin()->first, refused.begin()->second);
  if (m.kind == Measured::found && refused.contains(m.failed)) m.kind = Measured::refused_above, m.failed = 0;
  return m;
}

}  // namespace crosscheck
