// What a stepper is, and the table of all of them. A new stepper is a function in a file of its own and one row.
#pragma once

#include <any>
#include <deque>
#include <span>
#include <string_view>

#include "mysim/system.h"

namespace crosscheck {

/// Working memory of a stepper, made at its first step and kept, so that no later step allocates.
class Workspace {
 public:
  explicit Workspace(const State& like) : like_(like) {}
  /// The i-th state of the size of the scene's, i = 0, 1, ...
  State& operator[](int i) {
    while (static_cast<int>(states_.size()) <= i) states_.push_back(like_);
    return states_[i];
  }
  /// Memory of the stepper's own kind, made from `from` the first time it is asked for.
  template <class T, class From>
  T& own(From& from) {
    if (!own_.has_value()) own_.emplace<T>(from);
    return std::any_cast<T&>(own_);
  }

 private:
  State like_;
  std::deque<State> states_;  // a deque keeps references valid
  std::any own_;
};

/// Advances state.x and state.v from state.t by h. The caller sets the new time, moves the pins and resolves contacts.
/// Throws SolverFailure when an equation inside the step has no answer.
using StepFunction = void (*)(System&, State&, double h, Workspace&);

/// The largest stable step (s) on u'' = -omega^2 u - gamma u' (rad/s, 1/s); infinite where every step is stable, 0
/// where none is. Without drag and without a spring (omega = 0) it says what drag alone allows.
using StabilityLimit = double (*)(double omega, double gamma);

/// A rule made of kicks v' = v + h F/m and drifts x' = x + h v' alone. Leapfrogs (half drift, kick, half drift) of
/// these parts of the step, one after the other, with drag averaged over old and new velocity; or, `kick_first`, whole
/// kicks and then whole drifts, with drag at the old velocity. Such rules have a fast path on cloth (mysim/strip/).
struct Chain {
  std::vector<double> parts;  // of the step; they add up to 1
  bool kick_first = false;
};

struct Stepper {
  std::string_view name;
  StepFunction step;
  int order;         // of the global error on smooth scenes, drag included
  int evaluations;   // of the right-hand side, per step; 0: as many as the equations of the step take
  bool first_order;  // takes first-order scenes
  bool symplectic;   // without drag
  StabilityLimit limit;
  std::string_view limit_formula;  // the same for people; omega and gamma as above
  std::string_view what;           // what it is meant for
  bool adaptive = false;           // chooses its own steps to meet a tolerance; `step` is then its rule at a fixed step
  bool hard_constraints = false;   // keeps fixed distances
  StepFunction linear = nullptr;   // the rule behind the option +linear
  Chain (*chain)() = nullptr;      // where it is one
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

Chain chain_of_symplectic_euler();
Chain chain_of_leapfrog();
Chain chain_of_suzuki4();

std::span<const Stepper> steppers();

}  // namespace crosscheck
