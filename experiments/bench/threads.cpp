#include "experiments/bench/measurements.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "experiments/scenes/cloths.h"
#include "mysim/run/cloth_grid_world.h"

namespace crosscheck {
namespace {

constexpr auto rule = "mysim/leapfrog";
/// A loss of 5 % is the difference between speedups of 1.9 and 2.
constexpr double nearly_all = 0.95;

double cpu_of_all_threads() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class TimedCloth {
 public:
  TimedCloth(const Scene& scene, int threads)
      : h_(scene.step),
        world_(simd::make_cloth_grid_world(*find_method(rule).stepper, ContactRule::coulomb, scene, h_,
                                           {ExecutionPath::reproducible, threads}, no_observers_)) {}

  double step(long steps) {
    using Clock = std::chrono::steady_clock;
    const double cpu = cpu_of_all_threads();
    const auto begin = Clock::now();
    for (long i = 0; i < steps; ++i, ++taken_) world_->step(taken_ * h_, (taken_ + 1) * h_);
    const double wall = std::chrono::duration<double>(Clock::now() - begin).count();
    share_.push_back((cpu_of_all_threads() - cpu) / (threads() * wall));
    return wall / static_cast<double>(steps);
  }
  int threads() const { return world_->work().worker_seconds > 0 ? 2 : 1; }
  double share() const { return timing_of(share_).median; }

 private:
  Observers no_observers_{{}};
  double h_;
  std::unique_ptr<World> world_;
  long taken_ = 0;
  std::vector<double> share_;
};

}  // namespace

void measure_threads(const ThreadsOptions& options, BenchRecord& record) {
  if (cores_allowed() < 2) {
    record.notes.emplace_back("bench leaves out two threads: this process may use only one core");
    return;
  }
  for (const int side : options.sides) {
    const Scene scene = hanging_cloth(side);
    record.progress.begin(fmt::format("{}: two threads", scene.name));
    TimedCloth one(scene, 1), two(scene, 2);
    const MachineLock exclusive(MachineLock::Mode::exclusive, record.patience);
    const long steps =
        repetitions_in(options.turns.seconds, [&](long count) { return one.step(count) * static_cast<double>(count); });
    const std::vector<std::function<double()>> runs{[&] { return one.step(steps); }, [&] { return two.step(steps); }};
    const auto times = time_rounds(runs, options.turns.rounds);
    const bool both_at_work = two.threads() > 1;
    BenchRow row{.work = bench_work::two_threads,
                 .scene = scene.name,
                 .peer = "one thread",
                 .variant = both_at_work ? "" : "too small for a second thread",
                 .mysim = fmt::format("{}+threads=2", rule),
                 .instructions = simd::active_instruction_set(),
                 .unit = "step",
                 .share = two.share()};
    set_times(row, times[0], times[1]);
    if (both_at_work && *row.share < nearly_all)
      record.notes.push_back(fmt::format(
          "bench: two threads on {} received {:.0f} % of the time of two cores, because other programs ran: "
          "their ratio would be higher on an idle machine",
          scene.name, 100 * *row.share));
    record.rows.push_back(std::move(row));
  }
}

}  // namespace crosscheck
