#pragma once

#include <optional>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// Twice the mean time (s) between turning points of a path along the direction of its largest motion. `path` is in m,
/// at equally spaced times `t` in s. A turning point counts if the path turns back by at least a tenth of its range.
/// Returns nullopt if there are fewer than three turning points.
std::optional<double> period_of_path(const std::vector<double>& t, const std::vector<Vec3>& path);

}  // namespace crosscheck
