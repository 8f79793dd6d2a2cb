// What a run will take, before it starts, and refusals of what this machine has not got.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/method.h"

namespace crosscheck {

struct Demand {
  double steps;    // 1; of adaptive methods as many as the scene's own step would make
  double seconds;  // s of CPU time, good to a factor of about 3 (experiments/estimate.h)
  double memory;   // B, of the scene and of the engine, without what is kept of the run
  double frames;   // B, positions and velocities at the samples: on the disk, or in memory where runs are compared
};
/// Memory is counted from the number of particles and springs: 32 B for a spring and 57 B for a particle in the scene;
/// in mysim the kernel's copy of the springs and eight states, where equations are solved two 3 x 3 blocks for each
/// spring besides; in the other engines, which keep objects of their own, 300 B for each.
Demand demand_of(const Method& method, const Scene& scene, const Run& run);

/// A run as long as that with samples as far apart as the scene's own. Throws InputError that begins with --duration
/// and tells samples, steps, time and disk where there would be more than a million samples.
Run lengthened(const Method& method, const Scene& scene, Run run, double duration);

/// Throws InputError where the run would take more than 1e12 steps, or more memory than is free, or, where its frames
/// are written into a folder, more than the disk has. The message tells the number of steps and the time.
void require_room_to_write(const Method& method, const Scene& scene, const Run& run,
                           const std::filesystem::path& folder);
/// The same where the frames of all methods are kept in memory.
void require_room_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run);

}  // namespace crosscheck
