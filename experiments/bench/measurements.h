// The measurements of the bench. Each appends rows of one form: the times of a peer, those of mysim, and their ratio.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/bench/microbenchmarks.h"
#include "experiments/tables/bench.h"
#include "experiments/timing/timing.h"
#include "mysim/base/progress.h"

namespace crosscheck {

/// The results, and what each measurement needs besides its options.
struct BenchRecord {
  const LockPatience& patience;
  Progress& progress;
  std::vector<BenchRow> rows = {};
  std::vector<std::string> notes = {};  // omissions, with their reasons
};

/// Sets both times and their ratio, from the seconds of each round times a factor.
void set_times(BenchRow& row, const std::vector<double>& peer, const std::vector<double>& mysim, double peer_factor = 1,
               double factor = 1);

/// Kinds of work, as the column of that name has them.
namespace bench_work {
constexpr auto springs = "springs", springs_of_scene = "springs of a shipped scene", same_error = "same error",
               same_step = "same step", implicit_step = "linear implicit Euler step", two_threads = "two threads";
}
constexpr auto naive_loop_name = "naive loop";

/// CPU time per spring and step on a cloth with `side` particles along each side, kernel by kernel, beside the naive
/// loop: Eigen::Vector3d, spring by spring. Naive loop, plain loop and general kernel compute forces only; the fused
/// step is a whole step. `share` counts flop_per_spring, relative to the most that the same instructions do.
void measure_kernels(int side, const MicrobenchmarkOptions& options, BenchRecord& record);

/// One evaluation of the springs' forces in the engine's own kernels (the general one; where the springs are a grid
/// the fused step, a whole step) beside the naive loop, on each scene with springs.
void measure_scenes(const std::vector<Scene>& scenes, const MicrobenchmarkOptions& options, BenchRecord& record);

/// A method to compare with, and its settings: tolerances of those that control their error, else steps in units of
/// leapfrog's largest stable one, 2 / omega with the scene's fastest vibration omega.
struct Peer {
  std::string method;
  std::vector<double> settings;
  bool other_model = false;  // it converges to something else than the scene's springs
};

struct EqualErrorOptions {
  std::shared_ptr<const Scene> scene;
  std::vector<Peer> peers;
  TimedRunOptions turns;
};
/// The number of progress steps that this takes.
int work_of(const EqualErrorOptions& options);

/// Each run of each peer beside mysim's cheapest run that errs no more (the error bar of the truth counted against
/// mysim on both sides). The truth is suzuki4 at a sixteenth of its largest step. No ratio where the peer's error is
/// within the bar.
void measure_equal_error(const EqualErrorOptions& options, BenchRecord& record);

struct SameStepOptions {
  int side = 64;          // particles along a side of the cloth
  double duration = 0.2;  // s, over which both are followed
  TimedRunOptions turns;
};
/// Bullet's explicit world beside mysim's symplectic Euler, which is the same rule, so that only the time of a step
/// differs: on a cloth whose three stiffnesses a force class of Crosscheck's carries in Bullet (without faces), and on
/// one of two stiffnesses under Bullet's own spring force.
void measure_same_step(const SameStepOptions& options, BenchRecord& record);

struct ImplicitStepOptions {
  std::vector<int> sides;     // particles along a side of the cloth
  std::vector<double> rates;  // steps a second
  MicrobenchmarkOptions microbenchmarks;
};
/// One step of `implicit-euler+linear` beside one by Eigen's SimplicialLDLT (implicit_step.h), from a cloth that has
/// fallen for half a second.
void measure_implicit_steps(const ImplicitStepOptions& options, BenchRecord& record);

struct ThreadsOptions {
  std::vector<int> sides;  // particles along a side of each cloth
  TimedRunOptions turns;
};
/// Wall time of a step of leapfrog with one thread, and with +threads=2, which may use one where a cloth is small.
/// `share` is the part of the cores' time that the threads got: they spin while they wait, so that other processes had
/// the missing part, and the ratio is then less than the machine can give. A note says so below 95 %, and where there
/// is one core only. To be called before the process is bound to a core.
void measure_threads(const ThreadsOptions& options, BenchRecord& record);

}  // namespace crosscheck
