// The numbers of a scene, taken from the experiments' tables, and the formats of numbers.
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

/// "blew up", "solver gave up", "froze", "cannot": a verdict other than ok in words.
std::string failure_class(std::string_view verdict);
inline std::string failure_class(Verdict verdict) { return failure_class(name_of(verdict)); }

/// A method's run of a scene. Its error, difference and clearance are the largest within the window.
struct MethodData : EngineRow {
  std::optional<double> energy_error = {};  // relative
  bool supported() const { return verdict != Verdict::unsupported; }
  bool ok() const { return verdict == Verdict::ok; }
  /// True if its program crashed or timed out, which says nothing about its physics.
  bool gave_no_answer() const { return verdict == Verdict::crash || verdict == Verdict::timeout; }
  /// True for a completed run that is not a truth and whose error is known.
  bool judged() const { return ok() && error && family_of(method).role != Role::truth; }
  /// "blew up", "solver gave up" and so on, for a failed run.
  std::string failure() const { return failure_class(verdict); }
};

struct SceneData {
  std::string scene;
  double motion = 0, window = 0, growth = 0;  // m, s, 1
  double measured_window = 0;                 // s, until a perturbation of 1e-10 m has grown a thousandfold
  std::string tier;                           // tier of the truth; empty without a truth
  double error_bar = 0;                       // m
  std::string truth;                          // its derivation, one sentence
  std::optional<double> truth_until;          // s, if the truth ends before the scene
  // tier, bar and end of the converged in-house contact rule, if that is the truth; `tier` is then empty
  std::optional<double> contact_until;
  std::vector<MethodData> methods;
  const MethodData* find(const std::string& method) const;
  /// The smallest round-off bound of its methods, which is that of double precision.
  std::optional<double> round_off() const;
  /// True if some run came within a millimetre of the sphere's contact surface.
  bool touched() const;
};

/// True if a completed run is useless: its error exceeds a tenth of the motion.
bool is_useless(const MethodData& run, const SceneData& scene);
/// Fraction of the motion above which an error makes a run useless.
inline constexpr double useless_from = 0.1;

/// Facts of a scene from the tables `engines`, `engines-cost` and `engines-energy`.
SceneData scene_data(const std::string& scene, const TableSet& result);

/// True if the method chooses its own steps, so that the scene's step does not apply.
bool is_adaptive(const std::string& method);

/// "3.2e-5" instead of "3.2e-05"; small and large numbers are written plainly if that is short. For sentences.
std::string nice(double value);
/// A length in a suitable unit: "1.2 mm", "3.4e-14 m".
std::string nice_length(double metres);
/// A step or a time in a suitable unit: "500 µs", "1.12 ms", "3 s".
std::string step_text(double seconds);
/// The scene's own step as used, which divides the time between samples: "31.4 ms (of the 50 ms asked for)".
std::string own_step_text(const Scene& scene);
/// A run's setting: "2 ms" for "step [s]", or "tolerance 1.0e-6" for "tolerance [1]".
std::string setting_text(std::string_view setting, double value);

}  // namespace crosscheck
