// Finds the regular grid in a scene's springs, if there is one.
#pragma once

#include <array>
#include <optional>

#include "mysim/strip/kernel.h"
#include "mysim/terms/springs.h"

namespace crosscheck::strip {

/// All springs of a rows x columns grid whose particle (row, column) has the index row * columns + column: of each
/// direction (kernel.h) all that fit in or none, with one stiffness and one rest length.
struct Weave {
  struct Family {
    double k, rest;  // N/m, m
  };
  int rows, columns;
  std::array<std::optional<Family>, directions> families;
};

/// Empty where the springs are of another law, no such grid, or not all of one: such scenes are left to kernels for any
/// network.
std::optional<Weave> weave_of(const Springs& springs, int particles);

}  // namespace crosscheck::strip
