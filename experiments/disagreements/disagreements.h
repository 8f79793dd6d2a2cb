// Known disagreements between Bullet and a scene's definition: the scenes, their runs, and the direction of contact.
#pragma once

#include <functional>
#include <string>
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
// shows it, with its cause and the measured size of its effect. The table is in disagreements/table.cpp; a new one
// is a scene file in scenes/disagreements/ and a row.

/// One curve of the figure: a method at a step, perhaps on the scene with another spring law.
struct Variant {
  std::string label, method;
  double step = 0;  // s; 0: the scene's own
  SpringLaw law = SpringLaw::hooke;
};

struct Series {
  Variant variant;
  Outcome outcome;
  std::vector<std::pair<double, double>> points;  // t (s), the quantity
  double last() const { return points.back().second; }
};

struct Disagreement;
/// A table of its own and what it says, one sentence.
struct TableWithSentence {
  Table table;
  std::string sentence;
};

struct Disagreement {
  std::string name;   // of the scene file too
  std::string world;  // the Bullet world that has it
  std::string what;   // a heading: what cannot be matched, or fails
  std::string cause;  // one sentence
  std::string quantity, unit;
  std::vector<Variant> variants;  // the first is the scene's own
  /// The quantity; none: the largest distance of a particle from its place in the first variant's run (m), on a
  /// logarithmic axis.
  std::function<double(const Scene&, const State&)> value;
  std::function<std::string(const std::vector<Series>&)> effect;  // the measured size, one sentence
  std::function<TableWithSentence(const Disagreement&)> measured =
      nullptr;  // where curves over time do not show it all
};

std::vector<Disagreement> disagreements();
Scene scene_of(const Disagreement& disagreement);

/// Runs the variants; each curve ends where its run failed.
std::vector<Series> run_variants(const Disagreement& disagreement, const Scene& scene);

}  // namespace crosscheck
