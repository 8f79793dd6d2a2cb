// The cases of a regression run (a scene under a method, possibly without an ingredient), and their runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

// A case and its run as a list of numbers, which regression tests compare.

/// One scene under one method. `slow`: selected in full runs only. `without`: name of the ingredient that was removed;
/// empty for the complete scene.
struct Case {
  Scene scene;
  Method method;
  std::string without = {};
  bool slow = false;
  std::string hash = {};  // hash of the complete scene
  /// "chain under mysim/rk4 without drag"
  std::string in_words() const;
};

/// A number with its unit, or a word.
struct Quantity {
  std::string name, unit;
  double value = 0;
  std::string word = {};
  bool count = false;    // a whole number, unaffected by rounding
  double size = 0;       // scale of the numbers that are subtracted: the rounding error is relative to it
  double error_bar = 0;  // uncertainty independent of the engine: the error bar of a truth
  bool is_word() const { return !word.empty(); }
};

/// Names of quantities that other code looks up.
inline constexpr const char *setting_prefix = "setting ", *time_of_failure = "time of failure",
                            *error_quantity = "error against truth", *halving_quantity = "change at half the step",
                            *contact_quantity = "energy lost in contact";

/// One run over the scene's window, beyond which single positions cannot be predicted.
struct CaseRun {
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes and without velocities
};
/// Runs the case over the window (run_over_window()). A run that takes more than 2 s plus twenty times its estimate
/// (which is 350 times higher in builds with assertions) ends with the verdict `timeout`.
CaseRun run_case(const Case& test_case);

/// The scene's own step and tolerance over its window, with samples at the scene's sampling times.
Run run_over_window(const Scene& scene);

/// The quantities of a run, in the fixed order of the table in quantities.cpp. For a failed run: its verdict, the time
/// of failure, and its motion in the first half of the time until then.
std::vector<Quantity> quantities_of(const Case& test_case, const CaseRun& case_run);

/// Names of the quantities at time t (s): offset of the particles from their start, and their projected positions.
std::string offset_at(double t);
std::string places_at(double t);

/// The quantity of that name, or null.
const Quantity* find(const std::vector<Quantity>& all, const std::string& name);

/// The part of a run from which quantities are taken: the whole run, or for a failed one the first half of the time
/// until it failed, in which the motion is still that of the scene.
CaseRun comparable_part(const CaseRun& case_run);

// Selection of the cases: scenes, methods, and the scenes without one ingredient.

struct Selection {
  std::vector<std::string> scenes = {};  // names or files; empty: all shipped ones
  bool full = false;                     // includes slow cases
  std::string filter;                    // glob on SCENE or SCENE/METHOD, with !(A|B) and @(A|B); empty: all
  std::vector<Method> methods;           // empty: all of mysim and Bullet
};

/// True if the selection includes everything that baselines of these scenes should have.
inline bool covers_all(const Selection& selection) { return selection.filter.empty() && selection.methods.empty(); }
/// True if the method belongs to an engine; integrators, truth and external programs are selected by name only.
bool selected_by_default(const std::string& method);
/// True if the filter matches this scene under this method.
bool passes(const std::string& filter, const std::string& scene, const std::string& method);

/// Every scene under every method, up to a cost of 0.5 s by the estimate of experiments/estimate.h (20 s in full runs).
/// Under its own method, also each scene without each of its ingredients, which separates causes. Methods that refuse a
/// scene are cases too, because a refusal is behaviour. Throws InputError if the filter matches nothing. Empty if all
/// matches cost too much.
std::vector<Case> cases(const Selection& selection);

}  // namespace crosscheck
