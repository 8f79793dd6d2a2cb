// Bullet's soft-body worlds by name, with their options: the table of them is in worlds.cpp. Whether they compute in
// double or in single precision is decided by the Bullet that they are compiled against.
#pragma once

#include <string>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck::bullet {

/// One world with its options chosen.
struct WorldChoice {
  std::string what;  // one line for people
  Engine engine;
  bool implicit = false, position_based = false;
  bool may_hang = false;  // to be run in a process of its own only, with a time limit
};

/// "deformable-explicit", "deformable-implicit", "pbd".
std::vector<std::string> world_names();

/// options: what stands behind the pluses of a method's name, e.g. {"n=10"}. Throws InputError that lists what there
/// is.
WorldChoice choose_world(const std::string& world, const std::vector<std::string>& options);

}  // namespace crosscheck::bullet
