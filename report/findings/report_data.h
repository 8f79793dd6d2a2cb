// The numbers of a scene from the experiments' tables, and formats of numbers.
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

/// Failures in words: "blew up", "solver gave up", "froze", "unsupported".
std::string failure_class(std::string_view verdict);
inline std::string failure_class(Verdict verdict) { return failure_class(name_of(verdict)); }

/// Error, difference and clearance are the largest values within the comparison window.
struct MethodData : EngineRow {
  std::optional<double> energy_error = {};  // relative
  bool supported() const { return verdict != Verdict::unsupported; }
  bool ok() const { return verdict == Verdict::ok; }
  /// True for crashes and timeouts, which say nothing about the physics.
  bool gave_no_answer() const { return verdict == Verdict::crash || verdict == Verdict::timeout; }
  /// True if the run completed, is not a truth, and has a known error.
  bool judged() const { return ok() && error && family_of(method).role != Role::truth; }
  std::string failure() const { return failure_class(verdict); }
};

struct SceneData {
  std::string scene;
  double motion = 0, window = 0, growth = 0;  // m, s, 1
  double measured_window = 0;                 // s; after this time, a perturbation of 1e-10 m has grown a thousandfold
  std::string tier;                           // empty: no truth
  double error_bar = 0;                       // m
  std::string truth;                          // derivation of the truth in one sentence
  std::optional<double> truth_until;          // s, if the truth ends early
  // s; set if the truth is the converged contact rule of mysim. In this case `tier` is empty, and `error_bar`, `truth`
  // and `truth_until` describe that rule.
  std::optional<double> contact_until;
  std::vector<MethodData> methods;
  const MethodData* find(const std::string& method) const;
  /// Smallest of the methods' round-off bounds: that of methods in double precision.
  std::optional<double> round_off() const;
  /// True if a run came within a millimetre of the sphere's contact surface.
  bool touched() const;
};

/// True if the error of a completed run exceeds `useless_from` of the motion.
bool is_useless(const MethodData& run, const SceneData& scene);
inline constexpr double useless_from = 0.1;

/// Reads the tables `engines`, `engines-cost` and `engines-energy`.
SceneData scene_data(const std::string& scene, const TableSet& result);

bool is_adaptive(const std::string& method);

/// Number for sentences: "3.2e-5" instead of "3.2e-05"; without an exponent where that is short.
std::string nice(double value);
/// "1.2 mm", "3.4e-14 m"
std::string nice_length(double metres);
/// "500 µs", "1.12 ms", "3 s"
std::string step_text(double seconds);
/// The step in use, which divides the time between samples: "31.4 ms (of the 50 ms requested)".
std::string own_step_text(const Scene& scene);
/// "2 ms" for "step [s]", or "tolerance 1.0e-6" for "tolerance [1]".
std::string setting_text(std::string_view setting, double value);

}  // namespace crosscheck
