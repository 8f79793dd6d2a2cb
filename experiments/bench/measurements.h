// Measurements of the bench. Each appends rows with the times of a peer, the times of mysim, and their ratio.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "experiments/bench/microbenchmarks.h"
#include "experiments/tables/bench.h"
#include "experiments/timing/timing.h"
#include "mysim/base/progress.h"

namespace crosscheck {

struct BenchRecord {
  const LockPatience& patience;
  Progress& progress;
  std::vector<BenchRow> rows = {};
  std::vector<std::string> notes = {};  // omissions and their reasons
};

/// Sets both times and their ratio. `peer`, `mysim`: seconds of each round, to be multiplied by the respective factor.
void set_times(BenchRow& row, const std::vector<double>& peer, const std::vector<double>& mysim, double peer_factor = 1,
               double factor = 1);

/// Values of the column `work`.
namespace bench_work {
constexpr auto springs = "springs", springs_of_scene = "springs of a shipped scene", same_error = "same error",
               same_step = "same step", implicit_step = "linear implicit Euler step", two_threads = "two threads";
}
constexpr auto naive_loop_name = "naive loop";

/// CPU time per spring and step on a cloth with `side` particles a side, for each kernel and for the naive loop
/// (Eigen::Vector3d, spring by spring). The fused step is a whole step; all others compute forces only. `share`: the
/// achieved flop/s (flop_per_spring for each spring) relative to the peak of the same instruction set.
void measure_kernels(int side, const MicrobenchmarkOptions& options, BenchRecord& record);

/// Time of one evaluation of the spring forces on each scene with springs: naive loop, general kernel and, for regular
/// grids, the fused step, which is a whole step.
void measure_scenes(const std::vector<Scene>& scenes, const MicrobenchmarkOptions& options, BenchRecord& record);

/// A method to compare mysim with, and its settings: tolerances for adaptive methods, otherwise steps in units of
/// leapfrog's stability limit 2 / omega, where omega belongs to the scene's fastest vibration.
struct Peer {
  std::string method;
  std::vector<double> settings;
  bool other_model = false;  // converges to a different model, not to that of the scene's springs
};

struct EqualErrorOptions {
  std::shared_ptr<const Scene> scene;
  std::vector<Peer> peers;
  TimedRunOptions turns;
};
int work_of(const EqualErrorOptions& options);

/// Compares each run of each peer with the cheapest run of mysim whose error is smaller by at least two error bars of
/// the truth, so that mysim's run is certainly at least as accurate. The truth is suzuki4 at a sixteenth of its largest
/// step. Sets no ratio if the peer's error is within two error bars.
void measure_equal_error(const EqualErrorOptions& options, BenchRecord& record);

struct SameStepOptions {
  int side = 64;          // particles along each side of the cloth
  double duration = 0.2;  // s, of both runs
  TimedRunOptions turns;
};
/// Compares Bullet's explicit world with mysim's symplectic Euler. The integrators are the same, so that only the time
/// of a step differs. The first cloth has three stiffnesses, for which Bullet needs Crosscheck's own force class
/// (without faces); the second has two and uses Bullet's own spring force.
void measure_same_step(const SameStepOptions& options, BenchRecord& record);

struct ImplicitStepOptions {
  std::vector<int> sides;     // particles along each side of the cloth
  std::vector<double> rates;  // steps per second
  MicrobenchmarkOptions microbenchmarks;
};
/// Compares one step of `implicit-euler+linear` with one step of Eigen's SimplicialLDLT (implicit_step.h), starting
/// from a cloth that has fallen for half a second.
void measure_implicit_steps(const ImplicitStepOptions& options, BenchRecord& record);

struct ThreadsOptions {
  std::vector<int> sides;  // particles along each side of the cloth
  TimedRunOptions turns;
};
/// Wall time of a leapfrog step with one thread, and with +threads=2, which uses only one thread on small cloths.
/// `share` is the fraction of the cores' time that the threads got. Waiting threads spin, so the rest of the time went
/// to other processes, and the ratio is lower than on an idle machine. Adds a note if the share is below 95 %, or there
/// is only one core. Call it before the process is bound to a core.
void measure_threads(const ThreadsOptions& options, BenchRecord& record);

}  // namespace crosscheck
