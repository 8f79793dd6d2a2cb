// Estimates of a run's CPU time, steps, memory and disk, refusals of what this machine lacks, and a run's progress.
#pragma once

#include <filesystem>
#include <vector>

#include "mysim/base/progress.h"
#include "reference/method.h"

namespace crosscheck {

// Estimates of cost before the work: what is left out for its cost is the same on every machine.

/// CPU time of a run of the method, s: from the number of its steps, the particles and the springs; measured with this
/// suite's builds once, good to a factor of about 3. Rules that solve an equation in each step take more products with
/// the matrix at longer steps.
double estimated_seconds(const Method& method, const Scene& scene, const Run& run);
/// The same of so many steps of the scene's own.
double estimated_seconds(const Method& method, const Scene& scene, long steps);

/// The same of an adaptive method, whose steps are its own choice: as many evaluations per time as up to the
/// first sample, which is run.
double estimated_as_it_begins(const Method& method, const Scene& scene, Run run);

// Resources of a run before it starts, and refusals where this machine lacks them.

struct ResourceEstimate {
  double steps;    // 1; of adaptive methods as many as the scene's own step would make
  double seconds;  // s of CPU time, good to a factor of about 3 (experiments/estimate.h)
  double memory;   // B, of the scene and of the engine, without what is kept of the run
  double frames;   // B, positions and velocities at the samples: on the disk, or in memory where runs are compared
};
/// Memory is counted from the number of particles and springs: 32 B for a spring and 57 B for a particle in the scene;
/// in mysim the kernel's copy of the springs and eight states, where equations are solved two 3 x 3 blocks for each
/// spring besides; in the other engines, which keep objects of their own, 300 B for each.
ResourceEstimate resource_estimate_of(const Method& method, const Scene& scene, const Run& run);

/// A run as long as that with samples as far apart as the scene's own. Throws InputError that begins with --duration
/// and names samples, steps, time and disk where there would be more than a million samples.
Run with_duration(const Method& method, const Scene& scene, Run run, double duration);

/// Throws InputError where the run would take more than 1e12 steps, or more memory than is free, or, where its frames
/// are written into a folder, more than the disk has. The message gives the number of steps and the time.
void require_resources_to_write(const Method& method, const Scene& scene, const Run& run,
                                const std::filesystem::path& folder);
/// The same where the frames of all methods are kept in memory.
void require_resources_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run);

// The progress of runs.

/// The method, each run of which is announced as a step of work and reports its progress at its samples. Its
/// results are the same.
Method with_progress(const Method& method, Progress& progress);

}  // namespace crosscheck
