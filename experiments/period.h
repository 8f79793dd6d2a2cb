#pragma once

#include <optional>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// Twice the mean time between turning points of a path (m, at equally spaced times t, s) along the direction of
/// largest motion, s. A turning point counts if the path turns back by at least a tenth of its range. Nothing if there
/// are fewer than three.
std::optional<double> period_of_path(const std::vector<double>& t, const std::vector<Vec3>& path);

}  // namespace crosscheck
