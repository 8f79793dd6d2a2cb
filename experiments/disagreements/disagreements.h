// Known disagreements: cases in which a Bullet world or another engine solves a different problem from the scene's.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

/// Angles (rad) from the ball's normal to the impulse, at a position `angle` from the top, extrapolated to step 0.
/// in_plane: in the plane of gravity (positive: as if the position were farther down); sideways: across this plane.
struct DirectionError {
  double angle, in_plane, sideways;
};

/// Releases the scene's particle at rest 0.12 mm inside the frictionless ball, at each of the angles (rad). The
/// direction is that of the impulse over 4 ms, m (v - g t), during which the particle moves by less than 0.06 mm.
/// Results with steps h of 0.2 ms and 0.1 ms are extrapolated to 0 as 2 e(h/2) - e(h). Throws std::runtime_error if the
/// method cannot run the scene.
std::vector<DirectionError> direction_errors(const std::string& method, Scene scene, const std::vector<double>& angles);

// To add a disagreement, write the smallest scene that shows it in scenes/disagreements/, a row in
// disagreements/table.cpp and a section in disagreements.md.

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

/// Largest distance between two curves before `until` (s), in the row's unit; infinite if a value is NaN.
double most_apart(const Series& a, const Series& b, double until = INFINITY);

/// A condition on the curves of two variants, which `a` and `b` select by index.
struct Condition {
  enum class Kind {
    apart,   // the distance of the curves exceeds `by` at some common time
    within,  // both runs are ok, and the distance of their curves never exceeds `by`
    hangs,   // run `a` timed out, after `by` times the total CPU time of run `b`
  };
  Kind kind;
  int a, b;
  double by;                // in the row's unit; for `hangs`, a ratio
  double until = INFINITY;  // s; later times are ignored
};
bool holds(const Condition& condition, const std::vector<Series>& all);

enum class TroubleState {
  explained,       // the symptom occurs, and disappears with its cause
  reproduced,      // the symptom occurs, but no variant removes its cause, or the symptom remains without the cause
  not_reproduced,  // the method solves the scene's problem
  not_asked,       // a variant cannot be run, or fails in another way
};
std::string_view name_of(TroubleState state);

struct Disagreement;
struct TableWithSentence {
  Table table;
  std::string sentence;
};

struct Disagreement {
  std::string name;   // also the name of the scene file, unless `scene` is set
  std::string world;  // the Bullet world or engine concerned
  std::string quantity, unit;
  std::vector<Variant> variants;  // the first variant is the scene itself
  /// Quantity of the curves, in the row's unit. By default, the largest distance (m) of a particle from its position in
  /// the first variant's run, on a logarithmic axis.
  std::function<double(const Scene&, const State&)> value;
  std::function<std::string(const std::vector<Series>&)> effect;  // one sentence with the measured size of the effect
  std::vector<Condition> symptom, cause_removed;  // cause_removed is empty if no variant removes the cause
  std::function<TableWithSentence(const Disagreement&)> measured = nullptr;  // additional measurements
  // texts of disagreements.md
  std::string what = {};     // heading: the property that cannot be matched, or that fails
  std::string cause = {};    // one sentence
  std::string threads = {};  // upstream threads that the row explains: "bullet3#4496, ..."; empty if none is known
  std::string scene = {};    // name of the scene file if it differs from `name`
};

inline constexpr std::string_view engine_prefix = "engine:";

std::vector<Disagreement> disagreements();
/// Disagreements of the engines that `engine NAME` builds. Their methods "engine:NAME+option" refer to the programs
/// kept for reports, and run if the engine is among the methods.
std::vector<Disagreement> engine_disagreements();
/// Adds headings, causes and threads from disagreements.md. Throws std::logic_error if the file has no section for a
/// row.
std::vector<Disagreement> with_texts(std::vector<Disagreement> rows);
Scene scene_of(const Disagreement& disagreement);

/// The row with a program, "exec:PROGRAM", instead of Bullet's worlds.
Disagreement with_worlds_of(Disagreement disagreement, const std::string& program);

/// Runs all variants. Each curve ends where its run failed, or at the start if the run delivered nothing.
std::vector<Series> run_variants(const Disagreement& disagreement, const Scene& scene);

TroubleState state_of(const Disagreement& disagreement, const std::vector<Series>& all);
/// Names the first variant that was refused or, if the symptom does not occur, failed. Returns an empty text if the
/// state can be determined.
std::string why_not_asked(const Disagreement& disagreement, const std::vector<Series>& all);
std::string criterion_of(const Disagreement& disagreement);

}  // namespace crosscheck
