// What can be said of a motion whose single positions cannot be predicted: means over perturbed runs, and their spread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/method.h"

namespace crosscheck {

struct Statistic {
  std::string quantity, unit;
  double mean, deviation;  // over the runs; deviation with n - 1
};

struct ContactStatistics {
  static constexpr int runs = 16;
  /// m: each particle starts that far from its place, in a seeded direction. Far above what rounding can grow to in the
  /// window (1e-16 m a thousandfold), a hundredth of the smallest tolerance of a shipped scene at most.
  static constexpr double perturbation = 1e-6;
};

/// Height (y) of the centre of mass, kinetic and elastic energy at the end, and the smallest clearance at any sample,
/// of 16 runs of the method that differ in the seed of the perturbation. Empty where the method does not take the scene
/// or a run fails. For scenes with a sphere.
std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run);

}  // namespace crosscheck
