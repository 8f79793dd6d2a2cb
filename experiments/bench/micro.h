// Small pieces of work timed side by side, with Google Benchmark underneath, which chooses how often each is repeated.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/bench/pieces.h"

namespace crosscheck {

struct Micro {
  std::string name;
  Piece once;
};

struct MicroPlan {
  int rounds = 15;
  double seconds = 0.02;  // of each piece in each round
};

/// CPU time of one run of each, s, one for each round; by name. In a round all have their turn one after the other, so
/// that a slow spell of the machine falls on all, and quotients within a round tell most; alone on this machine among
/// all of Crosscheck (machine_lock.h). Names must differ. Throws
/// Unsupported with the package's name where the suite was built without Google Benchmark.
std::map<std::string, std::vector<double>> measured(const std::vector<Micro>& all, const MicroPlan& plan);

}  // namespace crosscheck
