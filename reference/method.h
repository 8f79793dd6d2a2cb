// Methods (everything that runs a scene) by name, and their families.
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

// Code that depends on a method's kind reads its family, never its name, so that a new engine needs only a row.

/// A family's role in the comparison: the engine under test, its peers, independent integrators of the separately
/// written right-hand side, reference solutions, and the user's own programs and trajectories.
enum class Role { subject, peer, integrator, truth, outside };

/// The origin of a family's build.
enum class Build { unknown, here, debian, own_program };

struct MethodRow;

struct MethodFamily {
  std::string_view name;   // prefix of its methods' names, before '/' or ':'
  std::string_view title;  // for display
  Role role;
  std::string_view representative = {};        // method used where a single one is needed
  std::string_view representative_title = {};  // for display; empty: the method's name
  std::string_view noun = "method";            // Bullet calls its methods worlds
  std::string_view variant_of = {};            // the engine of which this is another build; such builds run in
                                               // `regress`, or if named
  Build build = Build::unknown;
  std::string_view build_text = "a separate program";
  double call = 200e-9, element = 12e-9;  // s, cost of an evaluation: fixed part, and part per particle and spring
  double start = 0;                       // s, start-up of the family's program
  bool single_precision = false;
  int highest_order = 0;                          // highest order among the family's rules; 0: unknown
  bool grid_kernel = false;                       // has a kernel for regular cloths
  std::string_view departure = {};                // reason why the family may deviate from linear theory
  std::vector<MethodRow> (*methods)() = nullptr;  // null: the user names the methods

  bool is_subject() const { return role == Role::subject; }
  bool is_engine() const { return role == Role::subject || role == Role::peer; }
  bool by_default() const { return is_engine() && variant_of.empty(); }
  bool is_default_peer() const { return role == Role::peer && variant_of.empty(); }
  bool in_process() const { return is_engine() && build != Build::own_program; }
};

/// Exactly one family is the subject.
std::span<const MethodFamily> method_families();
const MethodFamily& subject();

/// Peers that run by default, in the table's order.
std::vector<const MethodFamily*> default_peers();
/// True for the first default peer, to which some table columns refer.
bool is_first_peer(const MethodFamily& family);

/// Selects families; an empty function selects all.
using FamilyFilter = std::function<bool(const MethodFamily&)>;

/// The family to which a method's or family's name belongs; names without a known prefix are programs of `exec:`.
const MethodFamily& family_of(std::string_view name);

struct FoundRule;

struct Method {
  std::string name;                  // full, e.g. "mysim/leapfrog+sticky"
  std::string what;                  // one line for the user
  std::string rule;                  // as returned by rule_of(), unless it is identified from runs; may be empty
  Engine engine;                     // throws Unsupported
  ContactLoss contact;               // source of the energy lost in contacts: reported, inferred or sampled
  const Stepper* stepper = nullptr;  // only for mysim's methods, otherwise null
  bool adaptive = false;             // uses run.tolerance instead of run.step
  bool implicit = false;             // solves an equation in each step
  bool position_based = false;
  bool multistep = false;
  bool splits_dashpots = false;                     // solves dashpots after an explicit step
  std::string on_one_spring = {};                   // equivalent rule on one linear spring; empty: `rule`
  std::string fingerprint = {};                     // hash of an external program or trajectory; otherwise empty
  std::function<const FoundRule&()> identify = {};  // identifies another engine's rule from its runs (which_rule.h)
  bool counts_evaluations = true;                   // false: the cost of its solver in each step is unknown
  bool sticky_contact = false;                      // puts a touching particle back to its previous position
  SpringLaw spring_law = SpringLaw::hooke;          // spring law of position-based methods, regardless of the scene
  bool own_friction = false;                        // friction does not follow Coulomb's law

  const MethodFamily& family() const { return family_of(name); }
};

/// Every available method, without options.
std::vector<Method> all_methods();

/// all_methods(), computed once.
std::span<const Method> builtin_methods();

/// The built-in method with this name, or null.
const Method* builtin_method(std::string_view name);

/// The built-in method of a name with options, or null.
const Method* builtin_without_options(std::string_view name);

/// Name of the subject's first method whose stepper satisfies `asked`, or an empty string.
std::string subject_method(const std::function<bool(const Stepper&)>& asked);

/// Name without the prefix of mysim's methods ("leapfrog"); other methods keep their whole name.
std::string short_name(const std::string& method);

/// Display name of an external program or trajectory, from its file and options: "my-mujoco, n=4", preceded by the
/// folders that distinguish it from the other programs in `beside`: "a/engine".
std::string program_title(const std::string& method, std::span<const std::string> beside = {});

/// The subject's representative with the contact rule that puts a touching particle back to its previous position.
std::string sticky_method();

inline constexpr std::string_view program_prefix = "exec:";

/// Finds a method: "rk4" (short for "mysim/rk4"), "bullet/pbd+n=10", "exec:./program". Throws InputError that lists the
/// available methods.
Method find_method(const std::string& text);

/// The positions in a .npy file (samples + 1 frames x particles x 3, m) as a method, "file:NAME". Throws InputError
/// with the file's name and what was expected.
Method trajectory_method(const std::filesystem::path& file, const Scene& scene, const Run& run);

/// mysim's table row of the rule that a method follows, or null. For odeint/rk4 it is the row of rk4; for a method of
/// another engine, the row of the rule identified from its runs. +linear counts as implicit Euler: if forces are
/// linear, a single Newton step is the whole step.
const Stepper* stepper_of(const Method& method);

/// The rule that a method follows, from its family's row or its runs; empty if it is none of mysim's rules.
std::string rule_of(const Method& method);

/// True if two methods follow the same rule on scenes with the model's ingredients, so that they must agree to rounding
/// unless there is contact or a law differs; empty if unknown. A rule that was identified from runs is valid for the
/// ingredients of these runs. For other ingredients it is valid only if the engine is built in, because such engines
/// declare differing laws.
std::optional<bool> same_rule(const Method& a, const Method& b, const Model& model);

/// `list`: "a,b,c".
std::vector<Method> find_methods(const std::string& list);

/// Runs the method under a DivergenceMonitor (mysim/run/observers.h), which may call `bounds`. Unsupported becomes the
/// outcome's verdict.
Outcome run_method(const Method& method, const Scene& scene, const Run& run, std::vector<Observer*> observers,
                   const MotionBoundsFunction& bounds = motion_bounds_of);

/// The options after the plus signs of a name: "sticky", "n=10".
using MethodOptions = std::vector<std::string>;

/// A method's name, its factory, and the options of which exactly one is mandatory (each choice is a separate method).
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
std::vector<MethodRow> bullet32_methods();  // in a separate program
std::vector<MethodRow> odeint_methods();
std::vector<MethodRow> sundials_methods();
std::vector<MethodRow> truth_methods();
/// `text`: the part after "exec:".
Method exec_method(const std::string& text);

}  // namespace crosscheck
