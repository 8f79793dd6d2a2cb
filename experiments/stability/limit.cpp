// Limits of scenes from the limits of single modes, and from step matrices where modes do not stay apart.
#include "experiments/stability/limit.h"

#include <cmath>
#include <limits>

#include "experiments/stability/extreme_eigenvalues.h"
#include "reference/exact/discrete.h"
#include "reference/exact/eigenvalues.h"

namespace crosscheck {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// nan where it was not found.
double largest_eigenvalue(const Eigen::SparseMatrix<double>& m) {
  if (m.rows() <= 400) return symmetric_eigenvalues(Eigen::MatrixXd(m))[m.rows() - 1];
  const auto found = largest_eigenpair(m, 1e-9);
  return found ? found->value : std::nan("");
}

/// The h in (0, top] at which `excess`, which rises with h, passes zero; top where it does not; nan where it is nan.
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

/// Leapfrog as the code steps it, on (w, w') of the whole scene; h of either sign.
class LeapfrogMatrix {
 public:
  explicit LeapfrogMatrix(const Linearised& s) : k_(s.k), dashpots_(s.dashpots), drag_(s.drag) {}

  void step(Eigen::MatrixXd& y, double h, int passes) const {
    const auto n = k_.rows();
    y.topRows(n) += h / 2 * y.bottomRows(n);
    const Eigen::MatrixXd old = y.bottomRows(n), pull = -(k_ * y.topRows(n));
    Eigen::MatrixXd middle = old, fresh;
    for (int pass = 0; pass < passes; ++pass) {
      if (pass > 0) middle = (old + fresh) / 2;
      const Eigen::MatrixXd a = pull - dashpots_ * middle;
      fresh = (1 + h / 2 * drag_.array()).inverse().matrix().asDiagonal() *
              ((1 - h / 2 * drag_.array()).matrix().asDiagonal() * old + h * a);
    }
    y.bottomRows(n) = fresh;
    y.topRows(n) += h / 2 * fresh;
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

Prediction of_mixed_modes(const Stepper& rule, const Spectrum& s) {
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
  // a neutral step's eigenvalues sit at 1 but for the root of the rounding, where two of them meet
  auto unstable = [&](double h) { return radius_of(rule, leapfrog, system.size(), h) > 1 + 1e-6; };
  constexpr int walk = 60;
  for (int i = 1; i <= 2 * walk; ++i)
    if (unstable(top * i / walk))
      return {root_below(top * i / walk, [&](double h) { return h > top * (i - 1) / walk && unstable(h) ? 1. : -1.; }),
              -1, ""};
  return {0, -1, "no limit up to twice that of the fastest mode without damping"};
}

/// Whether the rule's stability region is as deep in one direction of decaying vibrations as in another, to 15 %: then
/// the fastest rates bind. rk4's depth is 2.62 to 2.96; the others' goes to 0 or 1 beside the imaginary axis.
bool deep_all_round(const Stepper& rule) {
  double least = infinity, most = 0;
  for (int i = 0; i <= 20; ++i) {  // rates of size 1, from undamped to critically damped
    const double depth = rule.limit(1, 0.1 * i);
    least = std::min(least, depth), most = std::max(most, depth);
  }
  return least > 0.85 * most;
}

}  // namespace

Prediction predicted_limit(const Stepper& rule, const Spectrum& spectrum) {
  if (std::isinf(rule.limit(1, 0))) return {infinity, -1, ""};
  if (!spectrum.commuting && !is_runge_kutta(rule)) return of_mixed_modes(rule, spectrum);
  if (!spectrum.commuting && !spectrum.complete && !deep_all_round(rule))
    return {0, -1, "damping and stiffness have different modes, and of so many only the fastest rates are known"};
  Prediction least{infinity, -1, ""};
  for (size_t i = 0; i < spectrum.modes.size(); ++i) {
    const auto [omega, gamma] = spectrum.modes[i];
    // rounding makes modes of free motion a little stiff or soft: 1e-7 is the root of it
    const double limit = rule.limit(omega > 1e-7 * spectrum.omega ? omega : 0, gamma);
    if (limit <= least.limit && std::isfinite(limit)) least = {limit, static_cast<int>(i), ""};
  }
  return least;
}

Prediction predicted_limit(const Method& method, const Spectrum& spectrum) {
  const Stepper* rule = rule_of(method);
  if (!rule) return {0, -1, "no linear theory: a rule of its own"};
  if (method.name.starts_with("bullet") && spectrum.system.has_dashpots() && std::isfinite(rule->limit(1, 0)))
    return {0, -1, "no linear theory: Bullet solves dashpots implicitly, at the end of the explicit step"};
  return predicted_limit(*rule, spectrum);
}

}  // namespace crosscheck
