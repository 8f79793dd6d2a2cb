// The numbers of a scene, picked from the experiments' tables, and how numbers are written.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/typed.h"
#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

/// "blew up", "solver gave up", "froze", "cannot": what a verdict other than ok says of a run, as the table writes it.
std::string failure_class(std::string_view verdict);
inline std::string failure_class(Verdict verdict) { return failure_class(name_of(verdict)); }

/// A method's run of a scene. Its error, difference and clearance are the largest in the window.
struct MethodData : EngineRow {
  std::optional<double> energy_error = {};  // relative
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
std::string setting_text(std::string_view setting, double value);

}  // namespace crosscheck
