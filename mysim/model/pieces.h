// Connected components of a network, and particles that start at the same place.
#pragma once

#include <utility>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// The component of each particle, as connected by springs, bending and hard distances. Components are numbered from 0
/// in the order of their first particles.
std::vector<int> pieces_of(const Model& model);

/// Pairs of particles that are at most `distance` (m) apart, lower index first, in ascending order.
std::vector<std::pair<int, int>> coincident_pairs(const Points& x, double distance);

}  // namespace crosscheck
