// Speed, as ratios against peers in one run: all that `crosscheck bench` measures.
#pragma once

#include "experiments/bench/measurements.h"
#include "experiments/scenes/cloths.h"

namespace crosscheck {

struct BenchSuite {
  struct PeerCloth {
    int side;  // particles
    std::vector<Peer> peers;
    Scene (*of)(int side) = hooke;  // or of experiments/scenes/cloths.h: what suits the peers
    Scene scene() const { return of(side); }
    static Scene hooke(int side) { return hanging_cloth(side); }
  };
  std::vector<int> kernel_sides;    // of cloths that kernels run on
  std::vector<std::string> scenes;  // on which the engine's kernels are compared with the naive loop
  std::vector<PeerCloth> cloths;    // for the same error
  SameStepOptions same_step;
  ImplicitStepOptions implicit_step;
  MicrobenchmarkOptions kernels, on_scenes;
  TimedRunOptions turns;
  ThreadsOptions threads;
};

/// quick: within 90 s on a quiet machine of two cores; full: the largest cloth and every peer on each. The methods
/// named in `beside` are compared as well, on cloths of 16 and 32 particles a side. Throws InputError for an unknown
/// method.
BenchSuite bench_suite(bool full, const std::vector<std::string>& beside = {});

struct BenchResult {
  std::vector<BenchRow> rows;
  std::vector<std::string> notes;  // omissions, with their reasons
};
/// Threads first, then kernels, scenes, peers at the same error and at the same step, and the implicit step, measured
/// on one core, which the process keeps to from then on.
BenchResult bench(const BenchSuite& suite, const LockPatience& patience);

}  // namespace crosscheck
