// Everything that `crosscheck bench` measures: speed as ratios to peers, in one run.
#pragma once

#include "experiments/bench/measurements.h"
#include "experiments/scenes/cloths.h"

namespace crosscheck {

struct BenchSuite {
  struct PeerCloth {
    int side;  // particles
    std::vector<Peer> peers;
    Scene (*of)(int side) = hooke;  // one of the functions of experiments/scenes/cloths.h
    Scene scene() const { return of(side); }
    static Scene hooke(int side) { return hanging_cloth(side); }
  };
  std::vector<int> kernel_sides;    // particles along each side of the cloths for the kernels
  std::vector<std::string> scenes;  // scenes on which the engine's kernels are compared with the naive loop
  std::vector<PeerCloth> cloths;    // compared at equal error
  SameStepOptions same_step;
  ImplicitStepOptions implicit_step;
  MicrobenchmarkOptions kernels, on_scenes;
  TimedRunOptions turns;
  ThreadsOptions threads;
};

/// quick: within 100 s on a quiet machine of two cores; full: the largest cloth, and more peers on the others.
/// `beside`: further peers for cloths of 16 and 32 particles a side. Throws InputError for unknown methods.
BenchSuite bench_suite(bool full, const std::vector<std::string>& beside = {});

struct BenchResult {
  std::vector<BenchRow> rows;
  std::vector<std::string> notes;  // omissions, with their reasons
};
/// Measures threads first. Then binds the process to one core permanently, and measures kernels, scenes, peers at the
/// same error and at the same step, and the implicit step.
BenchResult bench(const BenchSuite& suite, const LockPatience& patience);

}  // namespace crosscheck
