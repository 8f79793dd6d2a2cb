// Bullet's soft-body worlds by name, with their options. The Bullet library determines double or single precision.
#pragma once

#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck::bullet {

struct WorldChoice {
  std::string what;  // one line for the user
  Engine engine;
  bool implicit = false, position_based = false;
  bool may_hang = false;  // must be run in a separate process with a time limit
};

/// The names "deformable-explicit", "deformable-implicit", "pbd".
std::vector<std::string> world_names();

/// options: the parts after the plus signs of a method's name, e.g. {"n=10"}. Throws InputError that lists the valid
/// options.
WorldChoice choose_world(const std::string& world, const std::vector<std::string>& options);

}  // namespace crosscheck::bullet
