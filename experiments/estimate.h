// Estimates the CPU time, steps, memory and disk space of a run; refuses runs that exceed this machine; reports the
// progress of a run.
#pragma once

#include <filesystem>
#include <vector>

#include "mysim/base/progress.h"
#include "reference/method.h"

namespace crosscheck {

/// CPU time (s) of a run of the method, estimated from the number of steps, particles and springs. The constants were
/// measured once, so that the same runs are left out on every machine; accurate to a factor of about 3. Rules that
/// solve an equation in each step need more matrix products at longer steps.
double estimated_seconds(const Method& method, const Scene& scene, const Run& run);
/// CPU time (s) of `steps` steps of the scene's own length.
double estimated_seconds(const Method& method, const Scene& scene, long steps);

/// CPU time (s) of a run of an adaptive method. Performs the run up to the first sample, and assumes the same number of
/// evaluations per simulated time for the rest.
double estimated_as_it_begins(const Method& method, const Scene& scene, Run run);

struct ResourceEstimate {
  double steps;    // number of steps; for adaptive methods, at the scene's own step
  double seconds;  // CPU time, accurate to a factor of about 3
  double memory;   // B, for the scene and the engine, without the recorded frames
  double frames;   // B, positions and velocities at the samples, on disk or, if runs are compared, in memory
};
/// Memory is estimated from the number of particles and springs. The scene takes 32 B per spring and 57 B per particle.
/// mysim adds the kernel's copy of the springs, eight states, and for implicit methods two 3 x 3 blocks per spring.
/// Other engines store objects of their own, of 300 B for each spring and particle.
ResourceEstimate resource_estimate_of(const Method& method, const Scene& scene, const Run& run);

/// A run of the given duration (s) with the scene's own sampling interval. Throws InputError, "--duration ...", if it
/// would have more than a million samples.
Run with_duration(const Method& method, const Scene& scene, Run run, double duration);

/// Throws InputError if the run would take more than 1e12 steps, more memory than is free, or more disk than is free in
/// `folder`.
void require_resources_to_write(const Method& method, const Scene& scene, const Run& run,
                                const std::filesystem::path& folder);
/// As require_resources_to_write(), for runs whose frames are all kept in memory.
void require_resources_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run);

/// A copy of the method that announces each run as a step of work, and reports progress at the samples. Results are
/// unchanged.
Method with_progress(const Method& method, Progress& progress);

}  // namespace crosscheck
