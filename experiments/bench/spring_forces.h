// The forces of a scene's springs, computed in several ways for the bench. All scenes must have springs.
#pragma once

#include <functional>
#include <optional>

#include "mysim/scene/scene.h"
#include "mysim/simd/instruction_sets.h"

namespace crosscheck {

/// Does the same work in each call, on the same memory.
using BenchmarkFunction = std::function<void()>;

BenchmarkFunction naive_loop(const Scene& scene);
/// The implementation of the springs term itself (mysim/terms/springs.h).
BenchmarkFunction plain_loop(const Scene& scene);
/// The engine's kernel for any spring graph. The machine must support the instruction set.
BenchmarkFunction general_kernel(const Scene& scene, simd::InstructionSet isa);
/// A whole step of a cloth, including kick and drift. T: double or float; `fast`: as in simd::kernel(). Returns nullopt
/// if the springs do not form a regular grid, or the grid is too narrow.
template <class T>
std::optional<BenchmarkFunction> fused_step(const Scene& scene, simd::InstructionSet isa, bool fast);

}  // namespace crosscheck
