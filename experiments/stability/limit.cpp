#include "experiments/stability/limit.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <limits>
#include <map>

#include "experiments/stability/extreme_eigenvalues.h"
#include "mysim/base/random.h"
#include "mysim/eigenvalues.h"
#include "reference/truth/discrete.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns NaN if the iteration did not converge.
double largest_eigenvalue(const Eigen::SparseMatrix<double>& m) {
  if (m.rows() <= 400) return symmetric_eigenvalues(Eigen::MatrixXd(m))[m.rows() - 1];
  const auto found = largest_eigenpair(m, 1e-9);
  return found ? found->value : std::nan("");
}

/// The h in (0, top] at which the increasing function `excess` crosses zero; `top` if it does not cross zero; NaN if
/// `excess` returns NaN.
template <class Excess>
double root_below(double top, Excess excess) {
  double at = excess(top), low = 0, high = top;
  if (at <= 0) return top;
  while (high - low > 1e-9 * top && !std::isnan(at)) {
    const double middle = (low + high) / 2;
    at = excess(middle);
    (at > 0 ? high : low) = middle;
  }
  return std::isnan(at) ? at : low;
}

/// A step of leapfrog as implemented, applied to (w, w') of the whole scene. The step h may be negative.
class LeapfrogMatrix {
 public:
  explicit LeapfrogMatrix(const Linearised& s) : k_(s.k), dashpots_(s.dashpots), drag_(s.drag) {}

  void step(Eigen::MatrixXd& y, double h, int passes) const {
    const auto n = k_.rows();
    y.topRows(n) += h / 2 * y.bottomRows(n);
    const Eigen::MatrixXd old = y.bottomRows(n), pull = -(k_ * y.topRows(n));
    Eigen::MatrixXd middle = old, next;
    for (int pass = 0; pass < passes; ++pass) {
      if (pass > 0) middle = (old + next) / 2;
      const Eigen::MatrixXd a = pull - dashpots_ * middle;
      next = (1 + h / 2 * drag_.array()).inverse().matrix().asDiagonal() *
             ((1 - h / 2 * drag_.array()).matrix().asDiagonal() * old + h * a);
    }
    y.bottomRows(n) = next;
    y.topRows(n) += h / 2 * next;
  }

 private:
  Eigen::MatrixXd k_, dashpots_;
  Eigen::VectorXd drag_;
};

double radius_of(const Stepper& rule, const LeapfrogMatrix& leapfrog, int n, double h) {
  Eigen::MatrixXd y = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  if (rule.name == "leapfrog") {
    leapfrog.step(y, h, 2);
  } else {
    const double p = 1 / (4 - std::cbrt(4.0));
    for (const double part : {p, p, 1 - 4 * p, p, p}) leapfrog.step(y, part * h, 4);
  }
  return eigenvalues(y).cwiseAbs().maxCoeff();
}

PredictedLimit of_mixed_modes(const Stepper& rule, const Spectrum& s) {
  if (s.omega == 0) return {0, -1, "no springs hold the particles, and their drag rates differ"};
  const Linearised& system = s.system;
  const double top = 2 / s.omega;
  if (rule.name == "symplectic-euler") {
    const Eigen::SparseMatrix<double> c = system.damping();
    const double limit =
        root_below(top, [&](double h) { return largest_eigenvalue(h * h * system.k + 2 * h * c) - 4; });
    if (std::isnan(limit)) return {0, -1, "the fastest of the mixed modes was not found"};
    return {limit, -1, ""};
  }
  if (rule.name == "leapfrog" && !system.has_dashpots()) return {top, -1, ""};
  if (system.size() > 90)
    return {0, -1, "damping and stiffness have different modes, and the step matrix of the whole scene is too large"};
  const LeapfrogMatrix leapfrog(system);
  // eigenvalues of a neutral step have modulus 1; where two of them coincide, their computed values are off by the
  // square root of the rounding error
  auto unstable = [&](double h) { return radius_of(rule, leapfrog, system.size(), h) > 1 + 1e-6; };
  constexpr int walk = 60;
  for (int i = 1; i <= 2 * walk; ++i)
    if (unstable(top * i / walk))
      return {root_below(top * i / walk, [&](double h) { return h > top * (i - 1) / walk && unstable(h) ? 1. : -1.; }),
              -1, ""};
  return {0, -1, "no limit up to twice that of the fastest mode without damping"};
}

/// True if the rule's stability region has the same depth, to 15 %, in all directions of decaying vibrations, so that
/// the fastest rates determine the limit. The depth is 2.62 to 2.96 for rk4; for other rules it tends to 0 or 1 near
/// the imaginary axis.
bool isotropic_region(const Stepper& rule) {
  double least = infinity, most = 0;
  for (int i = 0; i <= 20; ++i) {  // rates of modulus 1, from undamped to critically damped
    const double depth = rule.limit(1, 0.1 * i);
    least = std::min(least, depth), most = std::max(most, depth);
  }
  return least > 0.85 * most;
}

}  // namespace

PredictedLimit predicted_limit(const Stepper& rule, const Spectrum& spectrum) {
  if (std::isinf(rule.limit(1, 0))) return {infinity, -1, ""};
  if (!spectrum.commuting && !is_runge_kutta(rule)) return of_mixed_modes(rule, spectrum);
  if (!spectrum.commuting && !spectrum.complete && !isotropic_region(rule))
    return {0, -1, "damping and stiffness have different modes, of which only the fastest rates are known"};
  PredictedLimit least{infinity, -1, ""};
  for (size_t i = 0; i < spectrum.modes.size(); ++i) {
    const auto [omega, gamma] = spectrum.modes[i];
    // rounding errors give modes of free motion a small stiffness of either sign; 1e-7 is the square root of the
    // relative rounding error
    const double limit = rule.limit(omega > 1e-7 * spectrum.omega ? omega : 0, gamma);
    if (limit <= least.limit && std::isfinite(limit)) least = {limit, static_cast<int>(i), ""};
  }
  return least;
}

PredictedLimit predicted_limit(const Method& method, const Spectrum& spectrum) {
  const Stepper* rule = stepper_of(method);
  if (!rule) return {0, -1, "no linear theory is known for its rule"};
  if (method.splits_dashpots && spectrum.system.has_dashpots())
    return {0, -1,
            fmt::format("no linear theory: {} solves dashpots implicitly, at the end of the explicit step",
                        method.family().title)};
  if (method.identify && !method.family().is_engine() &&
      (spectrum.system.has_dashpots() || (!method.identify().own_drag && spectrum.system.damping().squaredNorm() > 0)))
    return {0, -1, "no linear theory: its rule was identified without such damping"};
  return predicted_limit(*rule, spectrum);
}

namespace {

/// The fast rate of a vibration, and its other rate, 1/s.
struct Rates {
  std::complex<double> fast, other;
};
Rates rates_of(const Vibration& m) {
  const std::complex<double> root = std::sqrt(std::complex<double>(m.gamma * m.gamma / 4 - m.omega * m.omega));
  return {-m.gamma / 2 - root, -m.gamma / 2 + root};
}

/// Measures the scene's distance from its state of rest: at the start, and the maxima over the first and the last tenth
/// of the run. If each step multiplies the perturbed mode by a constant, also measures the amplitude of this mode at
/// the start and at the end.
class GrowthObserver : public Observer {
 public:
  GrowthObserver(const BaseState& base, bool multiplies, int mode, double duration)
      : base_(base), duration_(duration), rotation_(multiplies && base.scene.model.first_order()) {
    const Spectrum& s = base.spectrum;
    if (multiplies && mode >= 0 && s.shapes.cols() > mode) {
      shape_ = s.shapes.col(mode);
      other_ = rates_of(s.modes[mode]).other;
    }
  }
  bool between_samples() const override { return true; }
  Verdict observe(const State& state, bool) override {
    const bool begins = state.t <= 0.1 * duration_, ends = state.t >= 0.9 * duration_ * (1 - 1e-12);
    if (begins || ends) {
      const double size = norm(state);
      if (perturbation == 0) perturbation = size;
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
  double perturbation = 0, first = 0, last = 0, start = 0, end = 0;

 private:
  double norm(const State& state) const {
    const Points off = state.x - base_.scene.start.x;
    if (base_.scene.model.first_order()) return off.norm();
    const Linearised& system = base_.spectrum.system;
    const Eigen::VectorXd w = system.weighted(off);
    double sum = std::max(0.0, w.dot(system.k * w));
    if (state.v.cols() > 0) sum += system.weighted(state.v).squaredNorm();
    return std::sqrt(sum);
  }
  /// |w' - other w|, which each step multiplies by the rule's factor for the fast rate; for a rotation, |x|.
  double amplitude(const State& state) const {
    if (rotation_) return norm(state);
    const Linearised& system = base_.spectrum.system;
    const double w = shape_.dot(system.weighted(state.x - base_.scene.start.x)),
                 rate = shape_.dot(system.weighted(state.v));
    return std::abs(rate - other_ * w);
  }

  const BaseState& base_;
  double duration_;
  bool rotation_;
  Eigen::VectorXd shape_;
  std::complex<double> other_;
};

}  // namespace

BaseState base_state_of(const Scene& scene) {
  BaseState base{scene, false, false, {}, scene.size()};
  const Equilibrium found = equilibrium_of(scene);
  base.saddle = found.saddle;
  if (found.rest) {
    base.scene.start = *found.rest;
    base.at_rest = true;
  }
  base.spectrum = spectrum_of(base.scene, base.scene.start);
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) {
      const double length = (base.scene.start.x.col(s.a) - base.scene.start.x.col(s.b)).norm();
      // coincident ends provide no scale: a perturbation of a millionth of the scene's size would vanish in rounding
      if (length > 1e-6 * scene.size()) base.spacing = std::min(base.spacing, length);
    }
  return base;
}

bool PerturbedRun::held() const {
  if (verdict != Verdict::ok && verdict != Verdict::frozen) return false;
  const double neutral = std::max(1e-9, 1e-6 / static_cast<double>(std::max(1L, steps)));
  return !(growth > 1.05) && !(of_mode && per_step > 1 + neutral);
}

Run run_of_perturbed(double h, long steps) {
  constexpr long samples = 100;
  const long per_sample = std::max(1L, steps / samples);
  Run run{h, h * static_cast<double>(per_sample * samples), samples};
  run.timed = false;
  return run;
}

Scene perturbed_scene(const BaseState& base, const Perturbation& perturbation) {
  Scene scene = base.scene;
  if (!base.at_rest) return scene;
  std::mt19937_64 engine(1);
  const Spectrum& s = base.spectrum;
  const double size = perturbation.size * base.spacing;
  if (scene.model.first_order()) {
    scene.start.x(0, 0) += size;
    return scene;
  }
  const bool of_mode = perturbation.mode >= 0 && s.shapes.cols() > perturbation.mode;
  const Eigen::VectorXd shape = of_mode ? Eigen::VectorXd(s.shapes.col(perturbation.mode)) : s.fastest;
  Points push = s.system.offsets(shape, scene.model.particles.size());
  push *= size / largest_column(push);
  scene.start.x += push;
  if (of_mode) scene.start.v += rates_of(s.modes[perturbation.mode]).fast.real() * push;
  // adds small random displacements, from which an unstable mode other than the perturbed one can grow
  for (int i = 0; i < scene.start.x.cols(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double part = 1e-3 * size * (2 * uniform(engine) - 1);
      if (!scene.model.particles.pinned[i]) scene.start.x(axis, i) += part;
    }
  return scene;
}

PerturbedRun run_perturbed(const Method& method, const BaseState& base, double h, long steps, Perturbation perturbation,
                           std::vector<Observer*> observers, const MotionBoundsFunction& bounds) {
  // rounding errors of about 1e-7 per step must remain small relative to the perturbation over thousands of steps
  constexpr double visible_in_single = 1e-2;
  if (method.family().single_precision || (method.identify && method.identify().single))
    perturbation.size = std::max(perturbation.size, visible_in_single);
  const Run run = run_of_perturbed(h, steps);
  const Stepper* rule = stepper_of(method);
  const TimeGrid grid = time_grid(run);
  const bool rotation = base.scene.model.first_order(), one_factor = rotation || (rule && is_runge_kutta(*rule));
  const bool multiplies = base.at_rest && base.spectrum.commuting && one_factor;
  GrowthObserver growth_observer(base, multiplies, perturbation.mode, run.duration);
  if (base.at_rest) observers.push_back(&growth_observer);
  const Outcome out = run_method(method, perturbed_scene(base, perturbation), run, observers, bounds);
  PerturbedRun trial{out.verdict, out.reason, out.end};
  // unknown rules, and rules that correct positions spring by spring, may have another state of rest, and the motion to
  // it does not count as growth. A rotation rests at the origin under every rule
  const bool rests_there = rule && !rule->hard_constraints;
  if (growth_observer.first > 0 && (rests_there || rotation)) {
    trial.growth = growth_observer.last / growth_observer.first;
    // A fast-growing mode reaches the springs' nonlinearity within the first tenth and stays there. The amplitude of a
    // stable mode is at most 1 / sqrt(1 - (h / limit)^2), which reaches 1000 only at half a millionth below the limit,
    // and no search is that precise.
    constexpr double largest_swing = 1000;
    if (growth_observer.last > largest_swing * growth_observer.perturbation)
      trial.growth = growth_observer.last / growth_observer.perturbation;
  }
  trial.of_mode = out.verdict == Verdict::ok && growth_observer.of_mode();
  if (trial.of_mode) {
    trial.amplitude = growth_observer.end / growth_observer.start;
    trial.steps = static_cast<long>(grid.samples) * grid.steps_per_sample;
    trial.per_step = std::exp(std::log(trial.amplitude) / static_cast<double>(trial.steps));
  }
  return trial;
}

MeasuredLimit largest_step(const std::function<bool(double)>& holds, double first, double lowest, double highest,
                           double precision, double fine_above) {
  MeasuredLimit m;
  if (holds(first)) {
    m.held = first;
    const auto next = [&](double h) { return h * (h < fine_above || h > 5 * fine_above ? 2 : 1.1); };
    for (double h = next(first); m.failed == 0; h = next(h)) {
      if (h > highest) return {MeasuredLimit::every_step, m.held, 0, ""};
      (holds(h) ? m.held : m.failed) = h;
    }
  } else {
    m.failed = first;
    for (double h = first / 2; m.held == 0; h /= 2) {
      if (h < lowest) return {MeasuredLimit::no_step, 0, m.failed, ""};
      (holds(h) ? m.held : m.failed) = h;
    }
  }
  while (m.failed / m.held - 1 > precision) {
    const double middle = std::sqrt(m.held * m.failed);
    (holds(middle) ? m.held : m.failed) = middle;
  }
  return m;
}

MeasuredLimit measured_limit(const Method& method, const BaseState& base, long steps, Perturbation perturbation,
                             double precision) {
  const Spectrum& s = base.spectrum;
  const double unit = s.omega > 0 ? 1 / s.omega : base.scene.step;
  const bool damped = base.scene.model.find<Drag>() || base.scene.model.find<Dashpots>();
  std::map<double, std::string> refused;  // by step
  bool accepted = false;
  MotionBoundsCache bounds;  // all trials have the same start
  // other rules may have another state of rest; the distance to it must be small relative to the perturbation
  if (const Stepper* rule = stepper_of(method); !rule || rule->hard_constraints)
    perturbation.size = std::max(perturbation.size, 1e-3);
  const auto holds = [&](double h) {
    const PerturbedRun trial = run_perturbed(method, base, h, steps, perturbation, {}, std::ref(bounds));
    if (trial.without_answer()) refused[h] = trial.reason;
    accepted |= !trial.without_answer();
    return trial.held();
  };
  // without drag, a rule that grows at h omega = 1/64 grows at every step, so the search ends there; with drag, it goes
  // on, to find the limit even if the drag rate is only a millionth of omega
  const double lowest = unit / (damped ? 1 << 20 : 64), highest = 128 * unit;
  // for h omega between one and five, steps increase by tenths: a composed rule may hold again beyond an unstable
  // interval (suzuki4 at 4.05, above its limit of 2.72), and doubling could skip that interval
  MeasuredLimit m = largest_step(holds, std::clamp(base.scene.step, lowest, highest), lowest, highest, precision, unit);
  if (refused.empty()) return m;
  if (!accepted) return {MeasuredLimit::unsupported, 0, 0, refused.begin()->second};
  m.reason = fmt::format("a step of {:.3g} s has no answer: {}", refused.begin()->first, refused.begin()->second);
  if (m.kind == MeasuredLimit::found && refused.contains(m.failed)) m.kind = MeasuredLimit::refused_above, m.failed = 0;
  return m;
}

}  // namespace crosscheck
