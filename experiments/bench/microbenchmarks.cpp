#include "experiments/bench/microbenchmarks.h"

#include "experiments/timing/timing.h"
#include "mysim/base/this_process.h"

namespace crosscheck {

std::map<std::string, std::vector<double>> run_microbenchmarks(const std::vector<Microbenchmark>& all,
                                                               const MicrobenchmarkOptions& options,
                                                               const LockPatience& patience) {
  const MachineLock exclusive(MachineLock::Mode::exclusive, patience);
  std::vector<std::function<double()>> runs;
  for (const Microbenchmark& piece : all) {
    const auto seconds_of = [&once = piece.once](long count) {
      return cpu_time_of([&] {
        for (long i = 0; i < count; ++i) once();
      });
    };
    const long count = repetitions_in(options.seconds, seconds_of);
    runs.push_back([seconds_of, count] { return seconds_of(count) / static_cast<double>(count); });
  }
  const auto times = time_rounds(runs, options.rounds);
  std::map<std::string, std::vector<double>> by_name;
  for (size_t i = 0; i < all.size(); ++i) by_name[all[i].name] = times[i];
  return by_name;
}

}  // namespace crosscheck
