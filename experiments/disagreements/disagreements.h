// Known disagreements: where Bullet's worlds answer otherwise than the scene asks, each in the smallest scene that
// shows it, with its cause and the measured size of its effect. The table is in table.cpp; a new one is a scene file in
// scenes/disagreements/ and a row.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

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
struct TableTold {
  Table table;
  std::string sentence;
};

struct Disagreement {
  std::string name;   // of the scene file too
  std::string world;  // whose it is
  std::string what;   // a heading: what cannot be matched, or fails
  std::string cause;  // one sentence
  std::string quantity, unit;
  std::vector<Variant> variants;  // first what the scene asks for
  /// The quantity; none: the largest distance of a particle from its place in the first variant's run (m), on a
  /// logarithmic axis.
  std::function<double(const Scene&, const State&)> value;
  std::function<std::string(const std::vector<Series>&)> effect;     // the measured size, one sentence
  std::function<TableTold(const Disagreement&)> measured = nullptr;  // where curves over time do not show it all
};

std::vector<Disagreement> disagreements();
Scene scene_of(const Disagreement& disagreement);

/// Runs the variants; each curve ends where its run failed.
std::vector<Series> play(const Disagreement& disagreement, const Scene& scene);

}  // namespace crosscheck
