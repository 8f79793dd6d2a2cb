// Hard distances: |x_a - x_b| = length at all times. They are not forces: a method enforces them, or refuses the scene.
#pragma once

#include <string_view>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

struct Constraints {
  static constexpr std::string_view name = "constraints";
  struct Constraint {
    int a, b;
    double length;  // m
  };
  std::vector<Constraint> list;
};

/// Largest ||x_a - x_b| / length - 1|.
inline double largest_constraint_error(const Constraints& constraints, const Points& x) {
  double largest = 0;
  for (const auto& [a, b, length] : constraints.list)
    largest = std::max(largest, std::abs((x.col(a) - x.col(b)).norm() / length - 1));
  return largest;
}

}  // namespace crosscheck
