#include "experiments/bench/micro.h"

#include <benchmark/benchmark.h>

#include <stdexcept>

namespace crosscheck {
namespace {

/// Keeps the times and prints nothing.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.error_occurred) throw std::runtime_error(run.benchmark_name() + ": " + run.error_message);
      if (run.run_type == Run::RT_Iteration)
        times[run.run_name.function_name].push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
    }
  }
  std::map<std::string, std::vector<double>> times;
};

}  // namespace

std::map<std::string, std::vector<double>> measured(const std::vector<Micro>& all, const MicroPlan& plan) {
  std::vector<std::string> words{"bench", "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  for (const Micro& micro : all)
    benchmark::RegisterBenchmark(micro.name.c_str(),
                                 [once = micro.once](benchmark::State& state) {
                                   for (auto _ : state) once();
                                 })
        ->MinTime(plan.seconds)
        ->Repetitions(plan.repetitions);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  benchmark::Shutdown();
  return collector.times;
}

}  // namespace crosscheck
