// Steppers, and building blocks that they share: leapfrog, rk4, dopri5, stability limits.
#pragma once

#include <any>
#include <array>
#include <deque>
#include <span>
#include <string_view>

#include "mysim/model/system.h"
#include "mysim/types.h"

namespace crosscheck {

// A new stepper is a function in its own file and one row in the table.

/// Working memory of a stepper, allocated at its first step and kept.
class Workspace {
 public:
  explicit Workspace(const State& like) : like_(like) {}
  /// The i-th auxiliary state, i = 0, 1, ..., of the scene's size.
  State& operator[](int i) {
    while (static_cast<int>(states_.size()) <= i) states_.push_back(like_);
    return states_[i];
  }
  /// Memory of a stepper's own type, constructed from `from` at first use.
  template <class T, class From>
  T& own(From& from) {
    if (!own_.has_value()) own_.emplace<T>(from);
    return std::any_cast<T&>(own_);
  }

 private:
  State like_;
  std::deque<State> states_;  // keeps references valid
  std::any own_;
};

/// Advances state.x and state.v from state.t by h (s). The caller sets the new time, moves the pins and resolves
/// contacts. Throws SolverFailure if an equation in the step cannot be solved.
using StepFunction = void (*)(System&, State&, double h, Workspace&);

/// Largest stable step (s) for u'' = -omega^2 u - gamma u' (rad/s, 1/s); infinite if every step is stable, 0 if none
/// is. For omega = 0, the limit due to drag alone.
using StabilityLimit = double (*)(double omega, double gamma);

/// A rule that consists of kicks v' = v + h F/m and drifts x' = x + h v' only: a sequence of leapfrogs (half drift,
/// kick, half drift) over fractions of the step, with drag averaged over old and new velocity. If `kick_first`, each
/// part is a whole kick, with drag at the old velocity, and a whole drift. Such rules have a fast path on regular
/// cloths (mysim/simd/cloth_grid/).
struct KickDriftComposition {
  std::vector<double> fractions;  // sum to 1
  bool kick_first = false;
};

struct Stepper {
  std::string_view name;
  StepFunction step;
  int order;         // order of the global error on smooth scenes, including drag
  int evaluations;   // right-hand side evaluations per step; 0 if the equations determine their number
  bool first_order;  // supports first-order scenes
  bool symplectic;   // without drag
  StabilityLimit limit;
  std::string_view limit_formula;  // readable, with omega and gamma as above
  std::string_view what;           // intended use
  bool adaptive = false;           // chooses its steps to meet a tolerance; `step` applies its rule at a fixed step
  bool hard_constraints = false;   // supports hard distances
  double solved_to = 0;            // implicit rules: residual relative to the largest force, inertia m v / h included
  StepFunction linear = nullptr;   // rule of the option +linear
  KickDriftComposition (*composition)() = nullptr;  // null if the rule is not one
};

void explicit_euler(System& f, State& s, double h, Workspace& w);
void trapezoidal(System& f, State& s, double h, Workspace& w);
void rk4(System& f, State& s, double h, Workspace& w);
void symplectic_euler(System& f, State& s, double h, Workspace& w);
void leapfrog(System& f, State& s, double h, Workspace& w);
void suzuki4(System& f, State& s, double h, Workspace& w);
void dopri5(System& f, State& s, double h, Workspace& w);
void implicit_euler(System& f, State& s, double h, Workspace& w);
void implicit_euler_linear(System& f, State& s, double h, Workspace& w);
void implicit_midpoint(System& f, State& s, double h, Workspace& w);
void xpbd(System& f, State& s, double h, Workspace& w);

KickDriftComposition symplectic_euler_composition();
KickDriftComposition leapfrog_composition();
KickDriftComposition suzuki4_composition();

std::span<const Stepper> steppers();

/// Drift h/2, kick h, drift h/2, from state.t; h may be negative. Drag and the other velocity-dependent forces act at
/// the mean of old and new velocity. Drag alone is solved exactly. Dashpots and air need the new velocity, which is
/// found in `passes` passes, each of which costs an evaluation and adds a power of h to the accuracy. Two passes
/// preserve order 2.
void leapfrog_step(System& f, State& s, double h, int passes, Workspace& w);

/// The classic fourth-order Runge-Kutta rule: advances s.x and s.v from s.t by h. derivative(stage, rate) writes dX/dt;
/// k holds the four rates.
template <class Derivative>
void rk4_step(Derivative derivative, State& s, double h, State* const (&k)[4], State& stage) {
  auto at = [&](double c, const State& rate) -> State& {
    stage.t = s.t + c * h;
    stage.x = s.x + c * h * rate.x;
    stage.v = s.v + c * h * rate.v;
    return stage;
  };
  auto& [k1, k2, k3, k4] = k;
  derivative(s, *k1);
  derivative(at(0.5, *k1), *k2);
  derivative(at(0.5, *k2), *k3);
  derivative(at(1, *k3), *k4);
  s.x += h / 6 * (k1->x + 2 * k2->x + 2 * k3->x + k4->x);
  s.v += h / 6 * (k1->v + 2 * k2->v + 2 * k3->v + k4->v);
}

// The embedded Dormand-Prince pair of orders 5(4), with its interpolant (J. R. Dormand and P. J. Prince, J. Comput.
// Appl. Math. 6, 1980; fourth-order interpolant: E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential
// Equations I, II.6).

class DormandPrince {
 public:
  explicit DormandPrince(const State& like) : next_(like), stage_(like), k_{like, like, like, like, like, like, like} {}

  /// Computes next() and the error estimate of a step of h from s. Six evaluations; seven at the first step and after
  /// forget().
  void attempt(System& f, State& s, double h);
  const State& next() const { return next_; }
  /// Estimated error of next(): order 5 minus order 4, in positions (3 x n, m) and velocities (3 x n, m/s).
  const State& error();
  /// Largest speed (m/s) that a particle at rest would gain in the attempted step with the accelerations at its start.
  double first_step_speed() const { return stage_.t * largest_column(k_[0].v); }
  /// The last stage becomes the first of the next step.
  void accept() { std::swap(k_[0], k_[6]); }
  /// The first stage must be evaluated again, because the state was changed from outside.
  void forget() { first_known_ = false; }
  /// State at s.t + theta h, 0 <= theta <= 1, of the attempted step from s, before accept().
  void interpolate(const State& s, double h, double theta, State& out) const;

 private:
  State next_, stage_;
  std::array<State, 7> k_;
  bool first_known_ = false;
};

}  // namespace crosscheck

namespace crosscheck::limits {

// Largest stable steps on the damped oscillator u'' = -omega^2 u - gamma u' (rad/s, 1/s -> s), from the eigenvalues of
// each rule's 2 x 2 step matrix: the theory against which the steppers are tested.

double explicit_euler(double omega, double gamma);
double trapezoidal(double omega, double gamma);
double rk4(double omega, double gamma);
double dopri5(double omega, double gamma);  // its rule at a fixed step
double symplectic_euler(double omega, double gamma);
double leapfrog(double omega, double gamma);
double suzuki4(double omega, double gamma);
double none(double omega, double gamma);  // infinite: always stable

/// Coefficients, constant first, of the stability polynomial R(h lambda) of the Runge-Kutta rule with that limit; empty
/// for other rules.
std::span<const double> stability_polynomial(StabilityLimit limit);

}  // namespace crosscheck::limits
