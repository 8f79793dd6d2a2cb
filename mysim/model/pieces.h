// Pieces of a network, and particles that start at the same place.
#pragma once

#include <utility>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// The piece that each particle belongs to, joined by springs, bending and hard distances; counted from 0 in the order
/// of their first particles.
std::vector<int> pieces_of(const Model& model);

/// Pairs of particles, the lower number first, in ascending order, that are at most `distance` (m) apart.
std::vector<std::pair<int, int>> coincident_pairs(const Points& x, double distance);

}  // namespace crosscheck
