// The numbers of a scene, picked from the experiments' tables, and how numbers are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/tables/typed.h"
#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

/// The rows of the table Row::table; none where it is not there.
template <class Row>
std::vector<Row> rows_of(const TableSet& rows) {
  const Table* table = rows.table(std::string(Row::table));
  return table ? rows_of<Row>(*table) : std::vector<Row>();
}

/// "blew up", "solver gave up", "froze": what a verdict other than ok says of a run, as the table writes it.
std::string failure_class(const std::string& verdict);
inline std::string failure_class(Verdict verdict) { return failure_class(std::string(name_of(verdict))); }
/// "cannot" where the method does not take the scene, else the word for its failure.
std::string failure_class_or_cannot(const std::string& verdict);

struct MethodData {
  std::string method, reason, different_law;
  Verdict verdict = Verdict::ok;
  double end = 0, step = 0;  // s
  long evaluations = 0, degenerate_springs = 0;
  std::optional<double> error;             // m, largest RMS error from the truth in the window
  std::optional<double> from_contact;      // m, the same from what the in-house contact rule converges to: no error
  std::optional<double> difference;        // m, largest RMS difference from mysim/symplectic-euler in the window
  std::optional<double> centres;           // m, largest difference of the centres of mass over the run
  std::optional<double> clearance, creep;  // m, m/s
  std::optional<double> energy_error;      // relative
  std::optional<double> limit;             // s, largest stable step by theory, for the scene's fastest vibration
  std::optional<double> round_off;         // m, what the same rule may differ by; empty where nothing can be predicted
  std::optional<bool> same_rule;           // its runs show mysim's symplectic Euler; empty: not known
  bool supported() const { return verdict != Verdict::unsupported; }
  bool ok() const { return verdict == Verdict::ok; }
  /// Whether its program died or took too long, which says nothing of its physics.
  bool gave_no_answer() const { return verdict == Verdict::crash || verdict == Verdict::timeout; }
  /// Whether it came to its end and is no truth itself, and how far it is from the truth is known.
  bool judged() const { return ok() && error && family_of(method).role != Role::truth; }
  /// "blew up", "solver gave up" and so on, of a run that failed.
  std::string failure() const { return failure_class(verdict); }
};

struct SceneData {
  std::string scene;
  double motion = 0, window = 0, growth = 0;  // m, s, 1
  double measured_window = 0;                 // s, until a perturbation of 1e-10 m has grown a thousandfold
  std::string tier;                           // tier of the truth; empty without one
  double error_bar = 0;                       // m
  std::string truth;                          // the way it was found, one sentence
  std::optional<double> truth_until;          // s, of a truth that ends before the scene does
  // where the truth is what the in-house contact rule converges to: the same; tier is then empty
  std::optional<double> contact_until;
  std::vector<MethodData> methods;
  const MethodData* find(const std::string& method) const;
  /// The least of its methods', which is that of double precision.
  std::optional<double> round_off() const;
  /// True when some run came within a millimetre of the sphere's contact surface.
  bool touched() const;
};

/// The most accurate run, or null.
const MethodData* most_accurate(const SceneData& scene);
/// Whether a run is as near to the truth as another: errs by at most 5 % more, or below the truth's error bar.
bool ties_with(const MethodData& run, const MethodData& other, const SceneData& scene);

/// Whether a run came to its end so far from the truth, more than a tenth of the motion, that it is of no use.
bool is_useless(const MethodData& run, const SceneData& scene);
/// The part of the motion beyond which it is.
inline constexpr double useless_from = 0.1;

/// Facts of a scene from the tables `engines`, `engines-cost` and `engines-energy`.
SceneData scene_data(const std::string& scene, const TableSet& result);

/// Whether a method of that name chooses its steps by itself: the scene's own step is none of its.
bool is_adaptive(const std::string& method);

/// "3.2e-05" as "3.2e-5", small and large numbers plain where that is short: for sentences.
std::string nice(double value);
/// A length in the unit that suits it: "1.2 mm", "3.4e-14 m".
std::string nice_length(double metres);
/// A step or a time in the unit that suits it: "500 µs", "1.12 ms", "3 s".
std::string step_text(double seconds);
/// The scene's own step as it is taken, so that it divides the time between samples: "31.4 ms (of the 50 ms asked
/// for)".
std::string own_step_text(const Scene& scene);
/// "2 ms", or "tolerance 1.0e-6": a run's setting, "step [s]" or "tolerance [1]".
std::string setting_text(const std::string& setting, double value);

}  // namespace crosscheck
