// What a stepper is, and the table of all of them. A new stepper is a function in a file of its own and one row.
#pragma once

#include <span>
#include <string_view>

#include "mysim/system.h"

namespace crosscheck {

/// Working memory of a stepper, sized once, so that no step allocates.
struct Workspace {
  explicit Workspace(const State& like) : stage(like), k1(like), k2(like), k3(like), k4(like) {}
  State stage, k1, k2, k3, k4;
};

/// Advances state.x and state.v from state.t by h. The caller sets the new time, moves the pins and resolves contacts.
using StepFunction = void (*)(System&, State&, double h, Workspace&);

struct Stepper {
  std::string_view name;
  StepFunction step;
  int order;              // of the global error on smooth scenes, drag included
  int evaluations;        // of the right-hand side, per step
  bool first_order;       // takes first-order scenes
  bool symplectic;        // without drag
  std::string_view what;  // for people
};

void explicit_euler(System& f, State& s, double h, Workspace& w);
void trapezoidal(System& f, State& s, double h, Workspace& w);
void rk4(System& f, State& s, double h, Workspace& w);
void symplectic_euler(System& f, State& s, double h, Workspace& w);
void leapfrog(System& f, State& s, double h, Workspace& w);

std::span<const Stepper> steppers();

}  // namespace crosscheck
