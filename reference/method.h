// Methods: everything that runs a scene, by name, and their families.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/run/observers.h"
#include "mysim/run/run.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

// The families of methods. Code that depends on a method's kind reads its family, never its name: a further engine is a
// row.

/// The role of a family in the comparison: the engine under test, its peers, others' integrators on the right-hand side
/// written apart, the best solutions known, programs and trajectories of the reader's.
enum class Role { subject, peer, integrator, truth, outside };

/// The origin of a family's build.
enum class Build { unknown, here, debian, own_program };

struct MethodRow;

struct MethodFamily {
  std::string_view name;   // what stands before '/' or ':' in the names of its methods
  std::string_view title;  // for people
  Role role;
  std::string_view representative = {};        // the method that stands for it where one must
  std::string_view representative_title = {};  // for people; empty: its name
  std::string_view noun = "method";            // for one of its methods: Bullet calls them worlds
  std::string_view variant_of = {};            // the same engine built otherwise: run by `regress`, else only by name
  Build build = Build::unknown;
  std::string_view build_text = "a program of its own";
  double call = 200e-9, element = 12e-9;  // s, an evaluation, and what it takes for each particle and spring
  double start = 0;                       // s, of its program
  bool single_precision = false;
  int highest_order = 0;                          // of its rules; 0: not known
  bool grid_kernel = false;                       // it has a kernel for regular cloths
  std::string_view departure = {};                // why it may leave linear theory
  std::vector<MethodRow> (*methods)() = nullptr;  // null: the reader names them

  bool is_subject() const { return role == Role::subject; }
  bool is_engine() const { return role == Role::subject || role == Role::peer; }
  bool by_default() const { return is_engine() && variant_of.empty(); }
  bool is_default_peer() const { return role == Role::peer && variant_of.empty(); }
  bool in_process() const { return is_engine() && build != Build::own_program; }
};

/// The table (method.cpp). Exactly one family is the subject.
std::span<const MethodFamily> method_families();
const MethodFamily& subject();

/// The peers that run without being named, in the table's order.
std::vector<const MethodFamily*> default_peers();
/// Whether it is the first of them, whom columns of some tables are about.
bool is_first_peer(const MethodFamily& family);

/// Which families are asked for; empty: all.
using FamilyFilter = std::function<bool(const MethodFamily&)>;

/// The family of a method's name, or of a family's; what has no other is a program's, of `exec:`.
const MethodFamily& family_of(std::string_view name);

struct FoundRule;

struct Method {
  std::string name;     // full, e.g. "mysim/leapfrog+sticky"
  std::string what;     // one line for people
  std::string rule;     // as rule_of() gives it, of methods that are not identified by their runs; may be empty
  Engine engine;        // throws Unsupported
  ContactLoss contact;  // whether it reports what contacts took away
  const Stepper* stepper = nullptr;  // of mysim's methods
  bool adaptive = false;             // follows run.tolerance and not run.step
  bool implicit = false;             // solves an equation in each step
  bool position_based = false;
  bool multistep = false;
  bool splits_dashpots = false;    // solves them after an explicit step
  std::string on_one_spring = {};  // the rule that it is on one linear spring; empty: `rule`
  std::string fingerprint = {};    // hash of an outside program's or trajectory's file; empty for built-in methods
  std::function<const FoundRule&()> identify = {};  // the rule that the runs of another engine show (which_rule.h)
  bool counts_evaluations = true;           // false: its steps alone are known, and not what its solver takes for each
  bool sticky_contact = false;              // a touching particle is put back to where it came from
  SpringLaw spring_law = SpringLaw::hooke;  // of its springs, whatever the scene asks for, where it is position-based
  bool own_friction = false;                // follows another law than Coulomb's

  const MethodFamily& family() const { return family_of(name); }
};

/// Every method there is, without options.
std::vector<Method> all_methods();

/// The same, made once.
std::span<const Method> builtin_methods();

/// The one of them with this name, or null: for readers of tables.
const Method* builtin_method(std::string_view name);

/// The one of them that a name with options is made from, or null.
const Method* builtin_without_options(std::string_view name);

/// The first of the subject's methods with such a stepper, or an empty name.
std::string subject_method(const std::function<bool(const Stepper&)>& asked);

/// "leapfrog" of mysim's; of others the whole name.
std::string short_name(const std::string& method);

/// An outside program's or trajectory's name for readers, by its file and options: "my-mujoco, n=4"; with as many
/// folders before it as tell it from the other programs named `beside` it: "a/engine".
std::string program_title(const std::string& method, std::span<const std::string> beside = {});

/// The subject's representative with the contact rule that puts a touching particle back.
std::string sticky_method();

/// The prefix of programs' names.
inline constexpr std::string_view program_prefix = "exec:";

/// A method by name: "rk4" (short for "mysim/rk4"), "bullet/pbd+n=10", "exec:./program". Throws InputError that lists
/// what there is.
Method find_method(const std::string& text);

/// The positions in a .npy file (samples + 1 frames x particles x 3, m) as a method, "file:NAME". Throws InputError
/// that names the file and what was expected.
Method trajectory_method(const std::filesystem::path& file, const Scene& scene, const Run& run);

/// mysim's row of the rule that a method follows, or null: odeint/rk4 has rk4's, and another engine that of the rule it
/// was found to be. +linear counts as implicit Euler: one Newton step is the whole step where forces are linear.
const Stepper* stepper_of(const Method& method);

/// The name of the rule that a method follows, as the row of its family or its runs say; empty if it is none of
/// mysim's.
std::string rule_of(const Method& method);

/// True where two methods follow one rule on scenes of the model's ingredients, so that they must agree to rounding
/// without contact and other laws; empty where it is not known. A rule found by runs holds for the ingredients of these
/// runs and, of built-in engines, for the others too, since those engines declare what they have under another law.
std::optional<bool> same_rule(const Method& a, const Method& b, const Model& model);

/// Splits "a,b,c" and finds each.
std::vector<Method> find_methods(const std::string& list);

/// Runs the method under a DivergenceMonitor (mysim/run/observers.h), which may call `bounds`; Unsupported becomes an
/// outcome with that verdict.
Outcome run_method(const Method& method, const Scene& scene, const Run& run, std::vector<Observer*> observers,
                   const MotionBoundsFunction& bounds = motion_bounds_of);

// The methods of each family, made by the files in methods/.

/// The options behind the pluses of a name: "sticky", "n=10".
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
std::vector<MethodRow> bullet_methods();
std::vector<MethodRow> bullet32_methods();  // in single precision, by a program of its own
std::vector<MethodRow> odeint_methods();
std::vector<MethodRow> sundials_methods();
std::vector<MethodRow> truth_methods();
/// An outside program: what stands behind "exec:".
Method exec_method(const std::string& text);

}  // namespace crosscheck
