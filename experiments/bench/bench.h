// Speed, as ratios against peers in one run: all that `crosscheck bench` measures.
#pragma once

#include "experiments/bench/equal_error.h"
#include "experiments/bench/implicit_step.h"
#include "experiments/bench/micro.h"
#include "experiments/bench/same_step.h"
#include "experiments/bench/sheet.h"
#include "experiments/bench/threads.h"

namespace crosscheck {

struct BenchPlan {
  struct Sheet {
    int side;  // particles
    std::vector<Peer> peers;
    Scene (*of)(int side) = hooke;  // or of sheet.h: what suits the peers
    Scene scene() const { return of(side); }
    static Scene hooke(int side) { return sheet(side); }
  };
  std::vector<int> kernel_sides;    // of sheets that kernels run on
  std::vector<std::string> scenes;  // on which the engine's kernels stand beside the naive loop
  std::vector<Sheet> sheets;        // for the same error
  SameStepAsked same_step;
  ImplicitStepAsked implicit_step;
  MicroPlan kernels, on_scenes;
  TurnPlan turns;
  ThreadsAsked threads;
};

/// quick: within 90 s on a quiet machine of two cores; full: the largest sheet and every peer on each.
BenchPlan bench_plan(bool full);

/// The tables of threads.h, and then those of kernels.h, on_scenes.h, equal_error.h, same_step.h and implicit_step.h,
/// measured on one core, which the process keeps to from then on. Notes say what was left out and why.
Rows bench(const BenchPlan& plan);

}  // namespace crosscheck
