// What a method does with a scene, seen as a list of numbers: what regression tests compare.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/observers/ledger.h"
#include "mysim/observers/trajectory.h"
#include "reference/method.h"

namespace crosscheck {

/// One scene under one method: what is asked. `dear`: in full runs only. `without` names the ingredient that was taken
/// out; empty for the scene as it is.
struct Question {
  Scene scene;
  Method method;
  std::string without = {};
  bool dear = false;
  std::string hash = {};  // of the scene as it is, nothing taken out
  /// "chain under mysim/rk4 without drag"
  std::string in_words() const;
};

/// A number with its unit, or a word.
struct Quantity {
  std::string name, unit;
  double value = 0;
  std::string word = {};
  bool count = false;  // a whole number that rounding cannot change
  double size = 0;     // of the numbers that it is a difference of: its last digits are theirs
  double bar = 0;      // what is not known of it whatever the engine does: the error bar of a truth
  bool is_word() const { return !word.empty(); }
};

/// How quantities are called that others look for.
inline constexpr const char *setting_prefix = "setting ", *time_of_failure = "time of failure",
                            *error_quantity = "error against truth", *halving_quantity = "change at half the step",
                            *contact_quantity = "energy lost in contact";

/// One run over the scene's window, beyond which single places cannot be predicted.
struct Answered {
  Outcome outcome;
  Trajectory trajectory;
  std::vector<LedgerRow> ledger;  // empty in first-order scenes and without velocities
};
/// By run_over_window(). Runs that take more than 2 s and twenty times their
/// estimate, which in builds with assertions is 350 times that of others, end with the verdict `timeout`.
Answered answer_to(const Question& question);

/// The scene's own step and tolerance over its window, samples where its own lie.
Run run_over_window(const Scene& scene);

/// The quantities that this answer has, in a fixed order: the table of them is in quantities.cpp. A failed run has its
/// verdict, when it failed, and what it did in the first half of the time until then.
std::vector<Quantity> quantities_of(const Question& question, const Answered& answered);

/// The name of the quantity that is the offset of the particles from their start at time t (s), and of that of their
/// places.
std::string offset_at(double t);
std::string places_at(double t);

/// Null where there is none of that name.
const Quantity* find(const std::vector<Quantity>& all, const std::string& name);

/// What quantities are taken from: the answer, of a failed run the first half of the time until it failed, since there
/// the motion is still the scene's.
Answered as_compared(const Answered& answered);

}  // namespace crosscheck
