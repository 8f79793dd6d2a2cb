// The cases of a regression run, and the numbers from their runs that are compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// A scene under a method. `slow`: selected in full runs only. `without`: the ingredient that was removed; empty for
/// the complete scene.
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
  bool count = false;    // whole number, unaffected by rounding
  double size = 0;       // scale of the numbers that are subtracted: the rounding error is relative to it
  double error_bar = 0;  // uncertainty that does not depend on the engine, e.g. the error bar of a truth
  bool is_word() const { return !word.empty(); }
};

inline constexpr const char *setting_prefix = "setting ", *time_of_failure = "time of failure",
                            *error_quantity = "error against truth", *halving_quantity = "change at half the step",
                            *contact_quantity = "energy lost in contact";

struct CaseRun {
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes and without velocities
};
/// Runs the case over the window (run_over_window()). After 2 s plus twenty times the estimate (350 times higher in
/// builds with assertions), a run ends with verdict `timeout`.
CaseRun run_case(const Case& test_case);

/// The scene's own step, tolerance and sampling times, up to the end of its window, beyond which single positions are
/// unpredictable.
Run run_over_window(const Scene& scene);

/// In the fixed order of the table in quantities.cpp. For a failed run: its verdict, the time of failure, and its
/// motion in the first half of the time until then.
std::vector<Quantity> quantities_of(const Case& test_case, const CaseRun& case_run);

/// Names of the quantities at time t (s): offset of the particles from their start, and their projected positions.
std::string offset_at(double t);
std::string places_at(double t);

const Quantity* find(const std::vector<Quantity>& all, const std::string& name);

/// The part of a run that is compared: the whole run, or for a failed one the first half, in which the motion is still
/// that of the scene.
CaseRun comparable_part(const CaseRun& case_run);

struct Selection {
  std::vector<std::string> scenes = {};  // names or files; empty: all shipped ones
  bool full = false;                     // includes slow cases
  std::string filter;                    // glob on SCENE or SCENE/METHOD, with !(A|B) and @(A|B); empty: all
  std::vector<Method> methods;           // empty: all of mysim and Bullet
};

inline bool covers_all(const Selection& selection) { return selection.filter.empty() && selection.methods.empty(); }
/// Engines only; integrators, truth and external programs are selected by name.
bool selected_by_default(const std::string& method);
bool passes(const std::string& filter, const std::string& scene, const std::string& method);

/// Every scene under every method, up to an estimated cost of 0.5 s (20 s in full runs). Under its own method, also
/// each scene without each of its ingredients, which separates causes. Includes methods that refuse a scene, because a
/// refusal is behaviour. Throws InputError if the filter matches nothing. Empty if all matches cost too much.
std::vector<Case> cases(const Selection& selection);

}  // namespace crosscheck
