// Motions as the page's player has them (motion.js): one format for every run, whatever ran it.
//
// A motion is told as its departures from a base: a few shapes that change in size from frame to frame (the singular
// vectors of the departures), which is little where runs are near each other. The base of a scene's runs is its truth,
// or a run of its own method where none is known to the end; that of a map's cells is their state of rest.
//
// A file holds the runs of one method, {"name", "note", "runs", "shapes", "paths", "values"}. A run is null where there
// is nothing to show, else
//   "modes", "frames", "unit" (m), "path": the departure of coordinate i in frame f is the sum over its modes k of
//     unit * shapes[i] * path * paths[f]; shapes, paths and values hold those of all runs one after the other;
//   "every": frames of the scene from one of the run's to the next; or "times" (s), the first and the last where they
//     are evenly apart, of pictures that are not the scene's; then the base is that of frame "at";
//   "step" (s) or "tolerance": what was asked for; "larger": departures are to be drawn so many times as large;
//   "computed": of a run that the page computes itself: it has no shapes and paths; "reference": see computed_runs.h;
//     The same of a cell, with "row", "h", "first" and "apart": see computed_cells.h;
//   "stops" (s), "end", and of a run that failed "failed" (s), "failure" and "reason".
// `values` holds for each frame the RMS distance from the truth (m), then for each frame the kinetic energy (J): 2000
// times their exponents of ten, plus 40000; 0 is none. Cells have no values, and are many: their list of runs is
// "packed", base64 of gzip. What the page takes instead of cells and their numbers where it has the lab stands in
// "lab".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// The number of samples from one frame of the page to the next: at most 150 frames of a scene of more than 250
/// particles, 300 of others; the last sample is one, where that is near. 0 where fewer than 25 frames would fit into
/// the page.
int frame_stride(const Scene& scene);

/// What the runs of a scene are told against.
struct MotionBase {
  std::vector<double> t;  // s, every frame of the page
  std::vector<Points> x;  // m
  std::optional<Truth> truth;
  bool known = false;  // whether the base is the truth
};
/// The truth where it reaches the scene's end, else a run of the scene's method, as far as it goes.
MotionBase base_of(const Scene& scene, const Run& run);

/// A scene as the player has it: what no method moves, the base ("known": runs of it, and of a truth that is not the
/// base) and how far the truth holds. Empty where there is nothing to play.
std::string stage_json(const Scene& scene, const MotionBase& base);
/// The same of a scene in which nothing has moved yet: where cells of its maps are played.
/// With its text where the lab is to open them.
std::string stage_json(const Scene& scene, bool with_text = false);

/// The file of one method's runs, in their order: of whole runs of a scene, with the last pictures of those that
/// failed; of cells of a map, whose base is in the file then. Empty where there is nothing to play.
std::string motions_json(const RecordedRuns& recorded, const MotionBase& base);

}  // namespace crosscheck
