// Known disagreements between Bullet and a scene's definition: the scenes, their runs, and the direction of contact.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

// The direction in which a method pushes a particle away from a ball, against the ball's own normal.

/// Direction of the impulses minus the ball's normal, at a position `angle` from the top: in the plane of gravity
/// (positive: as if the position were farther down) and across it. All in rad, in the limit of small steps.
struct DirectionError {
  double angle, in_plane, sideways;
};

/// Releases the scene's particle at rest 0.12 mm inside the scene's ball, without friction, at each of the angles
/// (rad). Determines the direction from the impulse over 4 ms, m (v - g t), during which the particle moves by less
/// than 0.06 mm. Uses steps h of 0.2 ms and half of it, and extrapolates to 0 as 2 e(h/2) - e(h). Throws
/// std::runtime_error if the method cannot run the scene.
std::vector<DirectionError> direction_errors(const std::string& method, Scene scene, const std::vector<double>& angles);

// Known disagreements: cases in which Bullet's worlds solve a different problem from the scene's. Each has the smallest
// scene that shows it, its cause, the measured size of its effect, and the upstream threads that it explains. The table
// is in disagreements/table.cpp, the texts are in disagreements.md. A new one is a scene file in scenes/disagreements/,
// a row and a section.

/// One curve of the figure: a method at a step, possibly on a modified scene or with another spring law.
struct Variant {
  std::string label, method;
  double step = 0;  // s; 0: the scene's own
  SpringLaw law = SpringLaw::hooke;
  void (*change)(Scene&) = nullptr;
};

struct Series {
  Variant variant;
  Outcome outcome;
  std::vector<std::pair<double, double>> points;  // t (s), the quantity
  double last() const { return points.back().second; }
};

/// Largest distance between two curves before a time (s), in the row's unit; infinite if a value is NaN.
double most_apart(const Series& a, const Series& b, double until = INFINITY);

/// A condition on the curves of two variants, given by their indices in the row.
struct Condition {
  enum class Kind {
    apart,   // at some common time their distance exceeds `by`
    within,  // both runs are ok and their distance never exceeds `by`
    hangs,   // the first timed out, after `by` times the total CPU time of the second
  };
  Kind kind;
  int a, b;
  double by;                // in the row's unit, or as a ratio
  double until = INFINITY;  // s: later times are ignored
};
bool holds(const Condition& condition, const std::vector<Series>& all);

/// State of a disagreement, always computed from the curves.
enum class TroubleState {
  explained,       // the symptom occurs, and not without its cause
  reproduced,      // the symptom occurs; no variant removes its cause, or removing it does not help
  not_reproduced,  // the method solves the scene's problem
  not_asked,       // a variant cannot be run, or fails in another way
};
std::string_view name_of(TroubleState state);

struct Disagreement;
/// A separate table, with a sentence about it.
struct TableWithSentence {
  Table table;
  std::string sentence;
};

struct Disagreement {
  std::string name;   // also the name of the scene file
  std::string world;  // the Bullet world that has it
  std::string quantity, unit;
  std::vector<Variant> variants;  // the first is the scene's own
  /// The quantity of the curves. Default: the largest distance (m) of a particle from its position in the first
  /// variant's run, on a logarithmic axis.
  std::function<double(const Scene&, const State&)> value;
  std::function<std::string(const std::vector<Series>&)> effect;  // the measured size, one sentence
  /// Conditions for the symptom, and conditions for its cause; the latter are empty if no variant removes the cause.
  std::vector<Condition> symptom, cause_removed;
  std::function<TableWithSentence(const Disagreement&)> measured =
      nullptr;  // further measurements, if the curves over time do not show everything
  // from disagreements.md
  std::string what = {};     // heading: the property that cannot be matched, or that fails
  std::string cause = {};    // one sentence
  std::string threads = {};  // upstream threads that it explains: "bullet3#4496, ..."; empty if none is known
  std::string scene = {};    // name of the scene's file, if it differs from the row's
};

/// Prefix for engines that `engine NAME` builds.
inline constexpr std::string_view engine_prefix = "engine:";

/// The rows about Bullet's worlds.
std::vector<Disagreement> disagreements();
/// The rows about engines that `engine NAME` builds: methods "engine:NAME+option", which are programs kept for reports.
/// They run if the engine is among the methods.
std::vector<Disagreement> engine_disagreements();
/// Adds headings, causes and threads from disagreements.md. Throws std::logic_error if a row has none.
std::vector<Disagreement> with_texts(std::vector<Disagreement> rows);
Scene scene_of(const Disagreement& disagreement);

/// The row with Bullet's worlds replaced by those of a program, "exec:PROGRAM".
Disagreement with_worlds_of(Disagreement disagreement, const std::string& program);

/// Runs the variants. Each curve ends where its run failed, or at the start if the run delivered nothing.
std::vector<Series> run_variants(const Disagreement& disagreement, const Scene& scene);

TroubleState state_of(const Disagreement& disagreement, const std::vector<Series>& all);
/// Why no state can be determined: the first variant that was refused or, without the symptom, failed. Empty if it can.
std::string why_not_asked(const Disagreement& disagreement, const std::vector<Series>& all);
/// The conditions in words, with the labels of the variants.
std::string criterion_of(const Disagreement& disagreement);

}  // namespace crosscheck
