// The cases of a regression run (a scene under a method, perhaps without an ingredient), and the run of each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

// A case and its run, seen as a list of numbers: what regression tests compare.

/// One scene under one method. `slow`: in full runs only. `without` names the ingredient that was taken out; it is
/// empty for the scene as it is.
struct Case {
  Scene scene;
  Method method;
  std::string without = {};
  bool slow = false;
  std::string hash = {};  // of the scene as it is, nothing taken out
  /// "chain under mysim/rk4 without drag"
  std::string in_words() const;
};

/// A number with its unit, or a word.
struct Quantity {
  std::string name, unit;
  double value = 0;
  std::string word = {};
  bool count = false;    // a whole number that rounding cannot change
  double size = 0;       // of the numbers whose difference it is: its rounding error is relative to these
  double error_bar = 0;  // what is not known of it whatever the engine does: the error bar of a truth
  bool is_word() const { return !word.empty(); }
};

/// Names of quantities that other code looks up.
inline constexpr const char *setting_prefix = "setting ", *time_of_failure = "time of failure",
                            *error_quantity = "error against truth", *halving_quantity = "change at half the step",
                            *contact_quantity = "energy lost in contact";

/// One run over the scene's window, beyond which single places cannot be predicted.
struct CaseRun {
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes and without velocities
};
/// By run_over_window(). Runs that take more than 2 s and twenty times their
/// estimate, which in builds with assertions is 350 times that of others, end with the verdict `timeout`.
CaseRun run_case(const Case& test_case);

/// The scene's own step and tolerance over its window, samples where its own lie.
Run run_over_window(const Scene& scene);

/// The quantities that this run has, in a fixed order: the table of them is in quantities.cpp. A failed run has its
/// verdict, when it failed, and what it did in the first half of the time until then.
std::vector<Quantity> quantities_of(const Case& test_case, const CaseRun& case_run);

/// The name of the quantity that is the offset of the particles from their start at time t (s), and of that of their
/// places.
std::string offset_at(double t);
std::string places_at(double t);

/// Null where there is none of that name.
const Quantity* find(const std::vector<Quantity>& all, const std::string& name);

/// The part of a run that gives quantities: all of it, of a failed one the first half of the time until it failed,
/// since there the motion is still the scene's.
CaseRun comparable_part(const CaseRun& case_run);

// The cases of a regression run: which scenes under which methods, and which of them without one ingredient.

struct Selection {
  std::vector<std::string> scenes = {};  // names or files; empty: all shipped ones
  bool full = false;                     // slow cases too
  std::string filter;                    // glob on SCENE or SCENE/METHOD, with !(A|B) and @(A|B); empty: all
  std::vector<Method> methods;           // empty: all of mysim and Bullet
};

/// Whether everything is selected that baselines of these scenes should have.
inline bool covers_all(const Selection& selection) { return selection.filter.empty() && selection.methods.empty(); }
/// Whether the method is an engine's; integrators, truth and outside programs are selected by name only.
bool selected_by_default(const std::string& method);
/// Whether the filter leaves this scene under this method.
bool passes(const std::string& filter, const std::string& scene, const std::string& method);

/// Every scene under every method, as far as its cost allows (0.5 s by the estimate of experiments/estimate.h, 20 s in
/// full runs); and under its own method also without each of its ingredients, which separates causes. Methods that
/// refuse a scene are cases too: a refusal is behaviour. Throws InputError if the filter matches nothing; empty if all
/// matches cost too much.
std::vector<Case> cases(const Selection& selection);

}  // namespace crosscheck
