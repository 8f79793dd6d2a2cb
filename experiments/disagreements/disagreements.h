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

/// At one place of the ball, `angle` from the top: the direction of the impulses, less the normal there, in the plane
/// of gravity (positive: as if the place were farther down) and across it. rad; as the step goes to 0.
struct DirectionError {
  double angle, in_plane, sideways;
};

/// Lets the scene's particle go at rest 0.12 mm inside the scene's ball, without friction, at each of the angles (rad),
/// and reads the direction off the impulses of 4 ms, m (v - g t), in which it moves by less than 0.06 mm. In steps h of
/// 0.2 ms and half of it, extrapolated to 0 as 2 e(h/2) - e(h). Throws std::runtime_error where the method cannot run
/// the scene.
std::vector<DirectionError> direction_errors(const std::string& method, Scene scene, const std::vector<double>& angles);

// Known disagreements: where Bullet's worlds solve another problem than the scene's, each in the smallest scene that
// shows it, with its cause, the measured size of its effect, and the upstream threads that it answers. The table is in
// disagreements/table.cpp, the texts are in disagreements.md; a new one is a scene file in scenes/disagreements/, a row
// and a section.

/// One curve of the figure: a method at a step, perhaps on the scene with another spring law or otherwise changed.
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

/// How far two curves are from each other at the most, in the row's unit, before a time (s). What is no number is
/// infinitely far from all.
double most_apart(const Series& a, const Series& b, double until = INFINITY);

/// What the curves of two variants do, told by their numbers in the row.
struct Condition {
  enum class Kind {
    apart,   // at some common time farther than `by` from each other
    within,  // both runs are ok and never farther than `by` from each other
    hangs,   // the first did not end in its time, in which it took `by` times what the second took in all (CPU)
  };
  Kind kind;
  int a, b;
  double by;                // in the row's unit, or a ratio
  double until = INFINITY;  // s: later times do not count
};
bool holds(const Condition& condition, const std::vector<Series>& all);

/// Computed from the curves, never said by hand.
enum class TroubleState {
  explained,       // the symptom is there, and with its cause taken away it is not
  reproduced,      // the symptom is there; no variant takes its cause away, or it does not help
  not_reproduced,  // the method does what is asked
  not_asked,       // a variant cannot be run, or fails otherwise than by the symptom
};
std::string_view name_of(TroubleState state);

struct Disagreement;
/// A table of its own and what it says, one sentence.
struct TableWithSentence {
  Table table;
  std::string sentence;
};

struct Disagreement {
  std::string name;   // also the name of the scene file
  std::string world;  // the Bullet world that has it
  std::string quantity, unit;
  std::vector<Variant> variants;  // the first is the scene's own
  /// The quantity; none: the largest distance of a particle from its place in the first variant's run (m), on a
  /// logarithmic axis.
  std::function<double(const Scene&, const State&)> value;
  std::function<std::string(const std::vector<Series>&)> effect;  // the measured size, one sentence
  /// All that must hold for the symptom to be there, and for the cause to be the one; where that is empty, no variant
  /// takes the cause away.
  std::vector<Condition> symptom, cause_removed;
  std::function<TableWithSentence(const Disagreement&)> measured =
      nullptr;  // where curves over time do not show it all
  // from disagreements.md
  std::string what = {};     // a heading: what cannot be matched, or fails
  std::string cause = {};    // one sentence
  std::string threads = {};  // upstream, that it answers: "bullet3#4496, ..."; empty: none known
  std::string scene = {};    // name of its scene's file, where that is not the row's
};

/// Before the names of engines that `engine NAME` builds.
inline constexpr std::string_view engine_prefix = "engine:";

/// The rows about Bullet's worlds.
std::vector<Disagreement> disagreements();
/// The rows about engines that `engine NAME` builds: methods "engine:NAME+option", which are programs kept for reports.
/// They are run where the engine is among the methods.
std::vector<Disagreement> engine_disagreements();
/// Adds headings, causes and threads from disagreements.md. Throws std::logic_error where a row has none.
std::vector<Disagreement> with_texts(std::vector<Disagreement> rows);
Scene scene_of(const Disagreement& disagreement);

/// The same with Bullet's worlds as the program has them: "exec:PROGRAM" as `program`.
Disagreement with_worlds_of(Disagreement disagreement, const std::string& program);

/// Runs the variants; each curve ends where its run failed, at the start where it delivered nothing.
std::vector<Series> run_variants(const Disagreement& disagreement, const Scene& scene);

TroubleState state_of(const Disagreement& disagreement, const std::vector<Series>& all);
/// Why nothing can be said, in words: the first variant that was refused or, where the symptom is not there, failed.
/// Empty where something can.
std::string why_not_asked(const Disagreement& disagreement, const std::vector<Series>& all);
/// The conditions in words, with the variants' labels.
std::string criterion_of(const Disagreement& disagreement);

}  // namespace crosscheck
