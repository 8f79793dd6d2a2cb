// Cases of a regression run, and the numbers from their runs that are compared with baselines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// A scene run with a method. `slow`: selected in full runs only. `without`: name of the ingredient that was removed;
/// empty for the complete scene.
struct Case {
  Scene scene;
  Method method;
  std::string without = {};
  bool slow = false;
  std::string hash = {};  // hash of the complete scene
  /// Example: "chain under mysim/rk4 without drag"
  std::string in_words() const;
};

struct Quantity {
  std::string name, unit;
  double value = 0;
  std::string word = {};
  bool count = false;    // true for whole numbers unaffected by rounding
  double size = 0;       // scale of the numbers that are subtracted; the rounding error is relative to this scale
  double error_bar = 0;  // uncertainty that does not depend on the engine, e.g. the error bar of a truth
  bool is_word() const { return !word.empty(); }
};

inline constexpr const char *setting_prefix = "setting ", *time_of_failure = "time of failure",
                            *error_quantity = "error against truth", *halving_quantity = "change at half the step",
                            *contact_quantity = "energy lost in contact";

struct CaseRun {
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes, and for engines without velocities
};
/// Runs the case over the window (run_over_window()). The run ends with verdict `timeout` after 2 s plus twenty times
/// the estimate, which is multiplied by 350 in builds with assertions.
CaseRun run_case(const Case& test_case);

/// The scene's own step, tolerance and sampling times up to the end of its window.
Run run_over_window(const Scene& scene);

/// The quantities of a run, in the fixed order of the table in quantities.cpp. For a failed run: the verdict, the time
/// of failure, and the motion in the first half of the time before the failure.
std::vector<Quantity> quantities_of(const Case& test_case, const CaseRun& case_run);

/// Names of two quantities at time t (s): the offset of the particles from their start, and their projected positions.
std::string offset_at(double t);
std::string places_at(double t);

const Quantity* find(const std::vector<Quantity>& all, const std::string& name);

/// The frames of a run that are compared: the whole run or, if it failed, the first half, in which the motion is still
/// that of the scene.
CaseRun comparable_part(const CaseRun& case_run);

struct Selection {
  std::vector<std::string> scenes = {};  // names or files; empty: all shipped scenes
  bool full = false;                     // includes slow cases
  std::string filter;                    // glob on SCENE or SCENE/METHOD, with !(A|B) and @(A|B); empty: no filter
  std::vector<Method> methods;           // empty: all methods of mysim and Bullet
};

inline bool covers_all(const Selection& selection) { return selection.filter.empty() && selection.methods.empty(); }
/// True for engines; integrators, truth methods and external programs must be selected by name.
bool selected_by_default(const std::string& method);
bool passes(const std::string& filter, const std::string& scene, const std::string& method);

/// Every scene under every method, up to an estimated cost of 0.5 s (20 s in full runs). For a scene's own method,
/// further cases leave out one ingredient each, which helps to separate causes. Includes methods that refuse a scene,
/// because a refusal is behaviour, too. Throws InputError if the filter matches nothing. Empty if all matches cost too
/// much.
std::vector<Case> cases(const Selection& selection);

}  // namespace crosscheck
