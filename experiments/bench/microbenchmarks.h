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
  double seconds = 0.02;  // duration of each piece in each round
};

/// CPU time of one run of each piece, s, by name and round. A round runs all pieces in turn, so that ratios within a
/// round stay precise. Waits until no other Crosscheck process is measuring on this machine
/// (experiments/timing/machine.h). Names must be unique.
std::map<std::string, std::vector<double>> run_microbenchmarks(const std::vector<Microbenchmark>& all,
                                                               const MicrobenchmarkOptions& options,
                                                               const LockPatience& patience);

}  // namespace crosscheck
