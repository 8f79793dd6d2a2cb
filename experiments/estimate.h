// Estimates of a run's CPU time, steps, memory and disk; refusal of runs that exceed this machine; progress of a run.
#pragma once

#include <filesystem>
#include <vector>

#include "mysim/base/progress.h"
#include "reference/method.h"

namespace crosscheck {

/// CPU time of a run of the method, s, from the number of steps, particles and springs. The constants were measured
/// once, so that every machine leaves out the same runs; accurate to a factor of about 3. Rules that solve an equation
/// in each step take more matrix products at longer steps.
double estimated_seconds(const Method& method, const Scene& scene, const Run& run);
/// CPU time of `steps` steps at the scene's own step, s.
double estimated_seconds(const Method& method, const Scene& scene, long steps);

/// CPU time of a run of an adaptive method, s. Performs the run up to the first sample, and assumes the same number of
/// evaluations per simulated time for the rest.
double estimated_as_it_begins(const Method& method, const Scene& scene, Run run);

struct ResourceEstimate {
  double steps;    // for adaptive methods, the number at the scene's own step
  double seconds;  // CPU time, accurate to a factor of about 3
  double memory;   // B, for the scene and the engine, without the recorded frames
  double frames;   // B, positions and velocities at the samples: on disk, or in memory if runs are compared
};
/// Memory is estimated from the number of particles and springs. The scene takes 32 B per spring and 57 B per particle.
/// mysim adds the kernel's copy of the springs, eight states, and for implicit methods two 3 x 3 blocks per spring.
/// Other engines have objects of their own: 300 B for each spring and particle.
ResourceEstimate resource_estimate_of(const Method& method, const Scene& scene, const Run& run);

/// A run of this duration (s) with the scene's own sampling interval. Throws InputError for more than a million
/// samples; its message begins with --duration and gives samples, steps, time and disk.
Run with_duration(const Method& method, const Scene& scene, Run run, double duration);

/// Throws InputError if the run would take more than 1e12 steps, more memory than is free, or more disk than is free in
/// `folder`. The message gives the number of steps and the time.
void require_resources_to_write(const Method& method, const Scene& scene, const Run& run,
                                const std::filesystem::path& folder);
/// As above, for runs whose frames are all kept in memory.
void require_resources_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run);

/// The method, with each run announced as a step of work and progress reported at its samples. Results are unchanged.
Method with_progress(const Method& method, Progress& progress);

}  // namespace crosscheck
