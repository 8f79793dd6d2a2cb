// Stability maps over step and stiffness, or over step and drag: the verdict of one run per cell, and for each row the
// largest stable step, measured and predicted.
#pragma once

#include "experiments/experiment.h"
#include "experiments/stability/limit.h"

namespace crosscheck {

struct MapKind {
  std::string_view name;  // "stiffness" (relative to the scene's own) or "drag" (gamma, 1/s)
  /// The value of a row at relative position 0 <= part <= 1, on a logarithmic scale. omega: frequency of the fastest
  /// vibration of the original scene, rad/s.
  double (*value)(double part, double omega);
  Scene (*with)(Scene, double value);
};
/// Stiffness: factors of 1/100 to 100 for all springs. Drag: gamma from omega/100 to 10 omega for all particles.
std::span<const MapKind> map_kinds();

struct MapSize {
  int rows, columns;
  long steps;  // per run
  bool check;  // true: also runs each cell ten times longer, and counts the cells that change
};
/// The finest size that costs less than 4 s of CPU time in a full run; nullopt if all cost more. Quick maps are
/// coarser.
std::optional<MapSize> map_size(const Method& method, const Scene& scene, bool full);

/// Adds tables stability-map (cells), stability-map-limit (limits of the rows) and, if requested, stability-map-check.
/// Marks cells that the method refuses; if it refuses all cells, adds a note instead of a map. `on_runs` receives the
/// last frames of each cell's run.
void add_map(const MapKind& kind, const Scene& scene, const Method& method, const MapSize& size, TableSet& tables,
             const RunCallback& on_runs = {});

/// The scene for the maps. Scenes with at most 64 particles are used unchanged. A larger cloth is replaced by one with
/// 6 particles along its longer side, "NAME-6". Other large scenes are used unchanged in a full run; otherwise, returns
/// nullopt.
std::optional<Scene> map_scene(const Scene& scene, bool full);

}  // namespace crosscheck
