// How far springs are stretched, as colours show it.
#pragma once

#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// Extension of the line between two particles, % of its length at rest; compression counts as zero.
double extension(const Points& x, int a, int b, double rest);

/// Mean extension of the structural springs and hard distances at each particle, %; that of every spring, on request.
std::vector<double> stretch_of(const Scene& scene, const Points& x, std::vector<double>* per_spring = nullptr);

/// A round number not below the value: 1, 2 or 5 times a power of ten.
double round_up(double value);

}  // namespace crosscheck
