// Runs that the page computes itself: where the engine stands in the page, their motions need not.
//
// What the engine computes there are places, while motions are told against a base (motions.h) that the page knows to
// its own bound only. One run of each scene, the "reference", therefore keeps its departures and is computed as well:
// its places less its departures are the base, as exactly as that run was told. It is one that lies next to the truth.
#pragma once

#include <set>
#include <span>
#include <string>

namespace crosscheck {

/// Whether the engine in the page computes the runs of a method: a rule of mysim's, with no option that a browser
/// lacks.
bool is_computed_in_page(const std::string& method);

/// A file of runs of a scene (motions_json), which stands in memory.
struct FileOfRuns {
  bool own;  // at the scene's own step
  std::string* json;
};

/// A file of a map's cells (motions_json) as the page has it: with the engine there, what it computes has no pictures.
std::string cells_for_page(const std::string& json, bool lab);

/// Leaves the motions of what the page computes out of all files of one scene, and marks the reference. Those whose
/// keys (ShownRun) are given stay, and those that failed or chose their own steps loosely, or that lie nearer to the
/// base than the reference; all do where no run is fit to be the reference.
void leave_out_computed(std::span<const FileOfRuns> files, const std::set<std::string>& stay);

}  // namespace crosscheck
