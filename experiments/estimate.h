// Estimates of a run's CPU time, steps, memory and disk; refusal of runs that exceed this machine; progress of a run.
#pragma once

#include <filesystem>
#include <vector>

#include "mysim/base/progress.h"
#include "reference/method.h"

namespace crosscheck {

// Estimates of cost in advance, so that every machine leaves out the same runs.

/// CPU time of a run of the method, s, from the number of steps, particles and springs. Measured once with this suite's
/// builds; accurate to a factor of about 3. Rules that solve an equation in each step take more matrix products at
/// longer steps.
double estimated_seconds(const Method& method, const Scene& scene, const Run& run);
/// CPU time of that many steps at the scene's own step, s.
double estimated_seconds(const Method& method, const Scene& scene, long steps);

/// CPU time of a run of an adaptive method, s: assumes as many evaluations per simulated time as in a run up to the
/// first sample, which this function performs.
double estimated_as_it_begins(const Method& method, const Scene& scene, Run run);

// Resources of a run before it starts, and refusal of runs that exceed this machine.

struct ResourceEstimate {
  double steps;    // 1; for adaptive methods, the number at the scene's own step
  double seconds;  // s of CPU time, accurate to a factor of about 3
  double memory;   // B, for the scene and the engine, without the recorded frames
  double frames;   // B, positions and velocities at the samples: on disk, or in memory if runs are compared
};
/// Memory is estimated from the number of particles and springs. The scene takes 32 B per spring and 57 B per particle.
/// mysim adds the kernel's copy of the springs, eight states, and for implicit methods two 3 x 3 blocks per spring. The
/// other engines have objects of their own: 300 B for each spring and particle.
ResourceEstimate resource_estimate_of(const Method& method, const Scene& scene, const Run& run);

/// A run of this duration (s) with the scene's own sampling interval. Throws InputError that begins with --duration and
/// gives samples, steps, time and disk if there would be more than a million samples.
Run with_duration(const Method& method, const Scene& scene, Run run, double duration);

/// Throws InputError if the run would take more than 1e12 steps, more memory than is free, or, for frames written to a
/// folder, more disk than is free. The message gives the number of steps and the time.
void require_resources_to_write(const Method& method, const Scene& scene, const Run& run,
                                const std::filesystem::path& folder);
/// Throws InputError under the same conditions for runs whose frames are all kept in memory.
void require_resources_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run);

// Progress of runs.

/// The method with progress reports: each run is announced as a step of work and reports at its samples. Its results
/// are unchanged.
Method with_progress(const Method& method, Progress& progress);

}  // namespace crosscheck
