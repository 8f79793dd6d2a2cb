// Identifies a method's time-stepping rule from its runs on small spring nets without contact.
#pragma once

#include <string>

#include "reference/method.h"

namespace crosscheck {

struct FoundRule {
  enum Kind { unknown, same, nearest, own_steps, ignores_step };
  Kind kind = unknown;
  std::string rule;           // "rk4"; the nearest rule if none agrees with the runs
  std::string like;           // mysim's stepper with this order and stability limit; empty unless exact
  std::string drag;           // "explicit", "implicit", "exact", "time-symmetric"; empty: not tried, or none of these
  bool own_drag = false;      // true: the rule's own drag
  bool exact = false;         // agrees to rounding, not only to its solver's error
  bool single = false;        // computes in single precision
  double distance = 0;        // largest distance from the rule at both steps (nearest: at the shorter one), relative
                              // to the net's size
  std::string tried;          // ingredients of the nets: "springs, gravity, pins, drag"
  std::string reason;         // reason why the rule or its drag is unknown
  std::string on_one_spring;  // rule that agrees on a net of one spring, if none agrees on the whole net
};

/// Runs the method on a net of five particles, without and with drag, at two steps, 50 steps each. Compares the
/// positions with every fixed-step rule of mysim, velocity Verlet, and symplectic Euler with positions first. A rule is
/// the same if all positions agree within the possible growth of rounding in the engine's precision. This is three
/// times the growth of a perturbation of 20 u L sqrt(n), with the unit round-off u, the size L of the net and n steps,
/// plus 1e-8 L if an equation is solved. A method chooses its steps if its two runs differ by less than a hundredth of
/// the difference for any rule, unless its error falls with a high power of the step. If the error is as large as that
/// of a rule, the method ignores the step. Rules that solve springs one after the other depend on the springs' order; a
/// net of one spring identifies such a rule.
FoundRule find_rule(const Method& method);

/// The finding as a sentence: "rk4 on a net of springs, gravity, pins, drag (explicit drag): largest difference 3.0e-15
/// of the net's size".
std::string sentence_of(const FoundRule& found);

/// Name of the rule in known breaks: "rk4", "xpbd on one spring, single precision", "implicit-euler+linear, solver
/// above rounding"; empty if no rule is the same.
std::string name_of(const FoundRule& found);

/// Like find_rule(), but first looks for the rule that this build has found for the program with these options.
FoundRule cached_rule(const Method& method);

/// Identifies the method's rule when it is first requested.
void identify_by_runs(Method& method);

}  // namespace crosscheck
