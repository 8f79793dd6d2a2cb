// Google Benchmark; in no other file.
#include "experiments/bench/microbenchmarks.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crosscheck {
namespace {

/// The reason why a benchmark gave no times, or "". Google Benchmark 1.8 renamed what 1.7 calls an error.
template <class Run>
std::string error_of(const Run& run) {
  if constexpr (requires { run.error_occurred; })
    return run.error_occurred ? run.error_message : "";
  else
    return run.skipped != decltype(run.skipped){} ? run.skip_message : "";
}

/// Keeps the times and prints nothing.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (const std::string error = error_of(run); !error.empty())
        throw std::runtime_error(run.benchmark_name() + ": " + error);
      times[run.run_name.function_name] = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    }
  }
  std::map<std::string, double> times;  // s, of one run of each
};

/// One round; with nothing known of how long each takes, Google Benchmark finds it out.
std::map<std::string, double> round_of(const std::vector<Microbenchmark>& all, double seconds,
                                       const std::map<std::string, double>& known) {
  for (const Microbenchmark& piece : all) {
    auto* entry = benchmark::RegisterBenchmark(piece.name.c_str(), [once = piece.once](benchmark::State& state) {
      for (auto _ : state) once();
    });
    if (const auto time = known.find(piece.name); time != known.end())
      entry->Iterations(std::max(1L, std::lround(seconds / time->second)));
    else
      entry->MinTime(seconds);
  }
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  return collector.times;
}

}  // namespace

std::map<std::string, std::vector<double>> run_microbenchmarks(const std::vector<Microbenchmark>& all,
                                                               const MicrobenchmarkOptions& options,
                                                               const LockPatience& patience) {
  const MachineLock exclusive(MachineLock::Mode::exclusive, patience);
  const auto first = round_of(all, options.seconds, {});
  std::map<std::string, std::vector<double>> times;
  for (int round = 0; round < options.rounds; ++round)
    for (const auto& [name, seconds] : round_of(all, options.seconds, first)) times[name].push_back(seconds);
  return times;
}

}  // namespace crosscheck
