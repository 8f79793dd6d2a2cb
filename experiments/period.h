// The period of a path, by its turning points.
#pragma once

#include <optional>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// s: twice the mean time between turning points of a path (m, at equally spaced times t, s), seen along the direction
/// in which it moves most; a turning point counts when the path turns back by a tenth of its whole range or more.
/// Nothing where fewer than three are seen.
std::optional<double> period_of_path(const std::vector<double>& t, const std::vector<Vec3>& path);

}  // namespace crosscheck
