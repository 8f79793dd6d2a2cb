// Connected components of a network, and coincident particles.
#pragma once

#include <utility>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// The component of each particle; springs, bending and hard distances connect particles. Components are numbered from
/// 0 in the order of their first particles.
std::vector<int> pieces_of(const Model& model);

/// Pairs of particles at most `distance` (m) apart, lower index first, in ascending order.
std::vector<std::pair<int, int>> coincident_pairs(const Points& x, double distance);

}  // namespace crosscheck
