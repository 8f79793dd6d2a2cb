// Stability maps over step and stiffness, or step and drag: the verdict of one run in each cell, and on each row the
// largest stable step, measured and predicted.
#pragma once

#include "experiments/experiment.h"
#include "experiments/stability/limit.h"

namespace crosscheck {

/// The parameter that a map's rows change.
struct MapKind {
  std::string_view name;  // "stiffness" (over the scene's own), "drag" (gamma, 1/s)
  /// The value of row 0 <= part <= 1, logarithmic; omega: the scene's fastest vibration as it is, rad/s.
  double (*value)(double part, double omega);
  Scene (*with)(Scene, double value);
};
/// Stiffness: all springs times 1/100 to 100. Drag: gamma from omega/100 to 10 omega, for all particles.
std::span<const MapKind> map_kinds();

struct MapSize {
  int rows, columns;
  long steps;  // of each run
  bool check;  // runs each cell ten times longer too, and counts those that change
};
/// As fine as about 10 s of CPU time pay for; nothing where no map costs so little. Quick maps are coarser.
std::optional<MapSize> map_size(const Method& method, const Scene& scene, bool full);

/// Tables stability-map (cells), stability-map-limit (limits of the rows) and, where requested, stability-map-check. A
/// cell that the method refuses says so; where it refuses all there is no map, and a note. `on_runs` is given the last
/// pictures of each cell's run.
void add_map(const MapKind& kind, const Scene& scene, const Method& method, const MapSize& size, TableSet& tables,
             const RunCallback& on_runs = {});

/// The scene that maps of a scene are made of: itself, if it has at most 64 particles; else of a cloth the
/// same with 6 particles along its longer side, "NAME-6"; else itself in a full run, or nothing.
std::optional<Scene> map_scene(const Scene& scene, bool full);

}  // namespace crosscheck
