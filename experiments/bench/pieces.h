// The forces of a scene's springs, computed in several ways: what the bench times side by side.
#pragma once

#include <functional>
#include <optional>

#include "mysim/scene.h"
#include "mysim/strip/kernels.h"

namespace crosscheck {

/// Work that is done once at each call, always on the same memory.
using Piece = std::function<void()>;

/// Spring by spring on Eigen's vectors, as one writes it first. The scene must have springs, as in all of these.
Piece naive_loop(const Scene& scene);
/// The definition of the term (terms/springs.h).
Piece plain_loop(const Scene& scene);
/// The engine's kernel for any network, with an instruction set that the machine has.
Piece general_kernel(const Scene& scene, strip::Isa isa);
/// The engine's sweep: not the forces alone but a whole step of a sheet, kick and drift included. T: double or float;
/// `fast` as of strip::kernel(). Nothing where the springs are no regular grid, or one too narrow.
template <class T>
std::optional<Piece> sweep(const Scene& scene, strip::Isa isa, bool fast);

}  // namespace crosscheck
