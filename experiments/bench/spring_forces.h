// The forces of a scene's springs, computed in several ways: what the bench times side by side.
#pragma once

#include <functional>
#include <optional>

#include "mysim/scene/scene.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

/// Work that is done once at each call, always on the same memory.
using BenchmarkFunction = std::function<void()>;

/// Spring by spring on Eigen's vectors, as one writes it first. The scene must have springs, as in all of these.
BenchmarkFunction naive_loop(const Scene& scene);
/// The definition of the term (mysim/terms/springs.h).
BenchmarkFunction plain_loop(const Scene& scene);
/// The engine's kernel for any spring graph, with an instruction set that the machine has.
BenchmarkFunction general_kernel(const Scene& scene, simd::InstructionSet isa);
/// The engine's fused step: not the forces alone but a whole step of a cloth, kick and drift included. T: double or
/// float; `fast` as of simd::kernel(). Nothing where the springs are no regular grid, or one too narrow.
template <class T>
std::optional<BenchmarkFunction> fused_step(const Scene& scene, simd::InstructionSet isa, bool fast);

}  // namespace crosscheck
