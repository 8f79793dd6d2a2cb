// Small pieces of work timed side by side.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/bench/spring_forces.h"
#include "experiments/timing/machine.h"

namespace crosscheck {

struct Microbenchmark {
  std::string name;
  BenchmarkFunction once;
};

struct MicrobenchmarkOptions {
  int rounds = 15;
  double seconds = 0.02;  // of each piece in each round
};

/// CPU time of one run of each, s, one for each round; by name. In a round all run one after the other, so
/// that a slow spell of the machine falls on all, and quotients within a round are the most exact; alone on this
/// machine among all of Crosscheck (experiments/timing/machine.h). Names must differ.
std::map<std::string, std::vector<double>> run_microbenchmarks(const std::vector<Microbenchmark>& all,
                                                               const MicrobenchmarkOptions& options,
                                                               const LockPatience& patience);

}  // namespace crosscheck
