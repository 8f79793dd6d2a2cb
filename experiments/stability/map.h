// Stability maps over step and stiffness, or step and drag: the verdict of one run per cell, and for each row the
// largest stable step, measured and predicted.
#pragma once

#include "experiments/experiment.h"
#include "experiments/stability/limit.h"

namespace crosscheck {

struct MapKind {
  std::string_view name;  // "stiffness" (over the scene's own), "drag" (gamma, 1/s)
  /// The value of a row at relative position 0 <= part <= 1, on a logarithmic scale. omega: fastest vibration of the
  /// original scene, rad/s.
  double (*value)(double part, double omega);
  Scene (*with)(Scene, double value);
};
/// Stiffness: factors of 1/100 to 100 for all springs. Drag: gamma from omega/100 to 10 omega for all particles.
std::span<const MapKind> map_kinds();

struct MapSize {
  int rows, columns;
  long steps;  // per run
  bool check;  // also runs each cell ten times longer, and counts the cells that change
};
/// The finest size that costs less than 4 s of CPU time in a full run; nothing if none does. Quick maps are coarser.
std::optional<MapSize> map_size(const Method& method, const Scene& scene, bool full);

/// Adds tables stability-map (cells), stability-map-limit (limits of the rows) and, if requested, stability-map-check.
/// Cells that the method refuses are marked; if it refuses all, there is a note instead of a map. `on_runs` receives
/// the last frames of each cell's run.
void add_map(const MapKind& kind, const Scene& scene, const Method& method, const MapSize& size, TableSet& tables,
             const RunCallback& on_runs = {});

/// The scene for the maps: itself, if it has at most 64 particles; a cloth with 6 particles along its longer side
/// instead, "NAME-6"; otherwise itself in a full run, or nothing.
std::optional<Scene> map_scene(const Scene& scene, bool full);

}  // namespace crosscheck
