// Frames that came from outside, played to observers as if an engine stepped through them.
#pragma once

#include <filesystem>
#include <vector>

#include "mysim/run.h"

namespace crosscheck {

/// Sampled positions (m), and velocities (m/s) where they were delivered.
struct Frames {
  std::vector<Points> x, v;
};

/// Reads positions of the scene's particles at the run's samples, the start included. Throws InputError that names the
/// file and what was expected, also when the first frame is not the scene's start. `cut_short`: fewer frames than
/// samples are allowed, of a run that failed by its own word.
std::vector<Points> read_positions(const std::filesystem::path& file, const Scene& scene, const Run& run,
                                   bool cut_short = false);

/// Shows the frames to the observer; fills verdict, reason and end of the outcome when the observer ends the run.
void play(const Frames& frames, const Scene& scene, const Run& run, Observer& observer, Outcome& out);

}  // namespace crosscheck
