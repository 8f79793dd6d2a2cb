// Everything that `crosscheck bench` measures: speed as ratios to peers, in one run.
#pragma once

#include "experiments/bench/measurements.h"
#include "experiments/scenes/cloths.h"

namespace crosscheck {

struct BenchSuite {
  struct PeerCloth {
    int side;  // particles
    std::vector<Peer> peers;
    Scene (*of)(int side) = hooke;  // generator of the cloth, from experiments/scenes/cloths.h
    Scene scene() const { return of(side); }
    static Scene hooke(int side) { return hanging_cloth(side); }
  };
  std::vector<int> kernel_sides;    // particles along each side of the cloths for the kernels
  std::vector<std::string> scenes;  // scenes on which the engine's kernels are compared with the naive loop
  std::vector<PeerCloth> cloths;    // cloths on which peers are compared at equal error
  SameStepOptions same_step;
  ImplicitStepOptions implicit_step;
  MicrobenchmarkOptions kernels, on_scenes;
  TimedRunOptions turns;
  ThreadsOptions threads;
};

/// The quick suite takes at most 100 s on a quiet machine with two cores. The full suite adds the largest cloth, and
/// more peers on the others. `beside`: additional peers, run on cloths of 16 and 32 particles a side. Throws InputError
/// for unknown methods.
BenchSuite bench_suite(bool full, const std::vector<std::string>& beside = {});

struct BenchResult {
  std::vector<BenchRow> rows;
  std::vector<std::string> notes;
};
/// Measures threads first. Then binds the process to one core permanently, and measures kernels, scenes, the implicit
/// step, and peers at the same error and at the same step.
BenchResult bench(const BenchSuite& suite, const LockPatience& patience);

}  // namespace crosscheck
