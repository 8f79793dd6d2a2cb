// Methods: everything that answers a scene, by name, and the families that they belong to.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "mysim/run/run.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

// Methods: everything that answers a scene, by name. The families stand in one table (method.cpp).

struct Method {
  std::string name;     // full, e.g. "mysim/leapfrog+sticky"
  std::string what;     // one line for people
  std::string rule;     // methods of the same rule must agree to round-off in contact-free scenes; may be empty
  Engine engine;        // throws Unsupported
  ContactLoss contact;  // whether it reports what contacts took away
  const Stepper* stepper = nullptr;  // of mysim's methods
  bool adaptive = false;             // follows run.tolerance and not run.step
  std::string fingerprint = {};      // of an outside program's or trajectory's file; empty for what is built in
};

/// Every method there is, without options.
std::vector<Method> all_methods();

/// A method by name: "rk4" (short for "mysim/rk4"), "bullet/pbd+n=10", "exec:./program". Throws InputError that lists
/// what there is.
Method find_method(const std::string& text);

/// The positions in a .npy file (samples + 1 frames x particles x 3, m) as a method, "file:NAME". Throws InputError
/// that names the file and what was expected.
Method trajectory_method(const std::filesystem::path& file, const Scene& scene, const Run& run);

/// mysim's row of the rule that a method follows, or null: Bullet's explicit world has symplectic Euler's, odeint/rk4
/// has rk4's. +linear counts as implicit Euler: one Newton step is the whole step where forces are linear.
const Stepper* stepper_of(const Method& method);

/// Splits "a,b,c" and finds each.
std::vector<Method> find_methods(const std::string& list);

/// Runs the method under a watch for failures (mysim/run/observers.h), which may ask `reach`; Unsupported becomes an
/// outcome with that verdict.
Outcome run_method(const Method& method, const Scene& scene, const Run& run, std::vector<Observer*> observers,
                   const MotionBoundsFunction& bounds = motion_bounds_of);

// The families of methods: each file beside this one makes the rows of one.

/// What stands behind the pluses of a name: "sticky", "n=10".
using MethodOptions = std::vector<std::string>;

/// A name, how its method is made from the options, and the options one of which must be given: each of them is a
/// method of its own.
struct MethodRow {
  std::string name;
  std::function<Method(const MethodOptions&)> make;  // throws InputError
  MethodOptions choices = {};

  std::vector<std::string> full_names() const {
    std::vector<std::string> names;
    for (const std::string& choice : choices) names.push_back(name + "+" + choice);
    return choices.empty() ? std::vector{name} : names;
  }
};

std::vector<MethodRow> mysim_methods();
std::vector<MethodRow> bullet_methods();  // in double and in single precision
std::vector<MethodRow> integrator_methods();
std::vector<MethodRow> truth_methods();
/// An outside program: what stands behind "exec:".
Method exec_method(const std::string& text);

/// InputError: "method NAME: unknown option '+OPTION'; expected KNOWN".
[[noreturn]] void refuse_option(const std::string& method, const std::string& option, const std::string& known);

}  // namespace crosscheck
