// The forces of a scene's springs, computed in several ways for the bench to compare.
#pragma once

#include <functional>
#include <optional>

#include "mysim/scene/scene.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

/// Does the work once per call, always on the same memory.
using BenchmarkFunction = std::function<void()>;

/// The straightforward loop over springs with Eigen's vectors. All functions here require a scene with springs.
BenchmarkFunction naive_loop(const Scene& scene);
/// The reference implementation of the term (mysim/terms/springs.h).
BenchmarkFunction plain_loop(const Scene& scene);
/// The engine's kernel for any spring graph, with an instruction set that the machine supports.
BenchmarkFunction general_kernel(const Scene& scene, simd::InstructionSet isa);
/// The engine's fused step: a whole step of a cloth including kick and drift. T: double or float; `fast` as in
/// simd::kernel(). Nothing if the springs do not form a regular grid, or one that is too narrow.
template <class T>
std::optional<BenchmarkFunction> fused_step(const Scene& scene, simd::InstructionSet isa, bool fast);

}  // namespace crosscheck
