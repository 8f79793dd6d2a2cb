#include "experiments/bench/measurements.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "experiments/cost/cost.h"
#include "experiments/scenes/cloths.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"

namespace crosscheck {
namespace {

using simd::InstructionSet;

constexpr auto double_precision = "double", single_precision = "single";

/// A cloth with a wave, so that every spring exerts a force.
Scene waving_cloth(int n) {
  Scene scene = hanging_cloth(n);
  for (int i = 0; i < scene.start.x.cols(); ++i)
    scene.start.x(1, i) += 0.03 * std::sin(9 * scene.start.x(0, i)) * std::sin(6 * scene.start.x(2, i));
  return scene;
}

struct TimedKernel {
  std::string name;
  InstructionSet instructions;
  std::string precision;
  BenchmarkFunction once;
  std::string id() const { return fmt::format("{}, {}, {}", name, name_of(instructions), precision); }
};

std::vector<TimedKernel> kernels_of(const Scene& scene) {
  const InstructionSet baseline = InstructionSet::baseline;  // instruction set of the suite's build
  std::vector<TimedKernel> kernels{{naive_loop_name, baseline, double_precision, naive_loop(scene)},
                                   {"plain loop", baseline, double_precision, plain_loop(scene)}};
  const auto add = [&](const char* name, InstructionSet isa, const char* precision,
                       std::optional<BenchmarkFunction> once) {
    if (once) kernels.push_back({name, isa, precision, std::move(*once)});
  };
  for (const InstructionSet isa : simd::supported_instruction_sets())
    add("general kernel", isa, double_precision, general_kernel(scene, isa));
  for (const InstructionSet isa : simd::supported_instruction_sets()) {
    add("sweep, reproducible", isa, double_precision, fused_step<double>(scene, isa, false));
    add("sweep, fastest", isa, double_precision, fused_step<double>(scene, isa, true));
    add("sweep, fastest", isa, single_precision, fused_step<float>(scene, isa, true));
  }
  return kernels;
}

struct Peak {
  std::string name;
  double operations;  // per run
  BenchmarkFunction once;
};

std::string peak_name(std::string_view instructions, std::string_view precision) {
  return fmt::format("peak, {}, {}", instructions, precision);
}

template <class T>
Peak peak_of(InstructionSet isa, const char* precision) {
  constexpr long rounds = 1000;
  const simd::Kernel<T> kernel = simd::kernel<T>(isa, false);
  T none = 0;
  return {peak_name(name_of(isa), precision), static_cast<double>(rounds) * kernel.multiply_and_add(0, &none),
          [kernel, sum = std::make_shared<T>(0)] { kernel.multiply_and_add(rounds, sum.get()); }};
}

std::vector<Peak> peaks() {
  std::vector<Peak> all;
  for (const InstructionSet isa : simd::supported_instruction_sets()) {
    all.push_back(peak_of<double>(isa, double_precision));
    all.push_back(peak_of<float>(isa, single_precision));
  }
  return all;
}

}  // namespace

void measure_kernels(int side, const MicrobenchmarkOptions& options, BenchRecord& record) {
  record.progress.begin(fmt::format("kernels on a sheet of {0} x {0}", side));
  const Scene scene = waving_cloth(side);
  const auto springs = static_cast<double>(scene.model.find<Springs>()->list.size());
  const std::vector<TimedKernel> kernels = kernels_of(scene);
  std::vector<Microbenchmark> benchmarks;
  for (const TimedKernel& kernel : kernels) benchmarks.push_back({kernel.id(), kernel.once});
  const std::vector<Peak> most = peaks();
  for (const Peak& peak : most) benchmarks.push_back({peak.name, peak.once});
  const auto times = run_microbenchmarks(benchmarks, options, record.patience);
  std::map<std::string, double> peak_rate;  // 1/s
  for (const Peak& peak : most) peak_rate[peak.name] = peak.operations / timing_of(times.at(peak.name)).median;
  for (const TimedKernel& kernel : kernels) {
    BenchRow row{.work = bench_work::springs,
                 .scene = scene.name,
                 .peer = naive_loop_name,
                 .mysim = fmt::format("{}, {}", kernel.name, kernel.precision),
                 .instructions = kernel.instructions,
                 .unit = "spring"};
    set_times(row, times.at(kernels[0].id()), times.at(kernel.id()), 1 / springs, 1 / springs);
    row.share = flop_per_spring / *row.time / peak_rate.at(peak_name(name_of(kernel.instructions), kernel.precision));
    record.rows.push_back(std::move(row));
  }
}

void measure_scenes(const std::vector<Scene>& scenes, const MicrobenchmarkOptions& options, BenchRecord& record) {
  record.progress.begin("kernels on the shipped scenes");
  std::vector<BenchRow> rows;
  std::vector<Microbenchmark> benchmarks;
  const auto name = [](const BenchRow& row) {
    return fmt::format("{}, {}, {}", row.scene, row.mysim, name_of(row.instructions));
  };
  const auto naive_of = [](const std::string& scene) { return scene + ", " + naive_loop_name; };
  const auto add = [&](const Scene& scene, const char* kernel, InstructionSet isa, BenchmarkFunction once) {
    rows.push_back({.work = bench_work::springs_of_scene,
                    .scene = scene.name,
                    .peer = naive_loop_name,
                    .mysim = kernel,
                    .instructions = isa,
                    .unit = "evaluation"});
    benchmarks.push_back({name(rows.back()), std::move(once)});
  };
  for (const Scene& scene : scenes) {
    const auto* springs = scene.model.find<Springs>();
    if (!springs || springs->list.empty()) continue;
    benchmarks.push_back({naive_of(scene.name), naive_loop(scene)});
    for (const InstructionSet isa : compared_instruction_sets()) {
      add(scene, "general kernel", isa, general_kernel(scene, isa));
      if (auto step = fused_step<double>(scene, isa, false)) add(scene, "sweep, reproducible", isa, std::move(*step));
    }
  }
  const auto times = run_microbenchmarks(benchmarks, options, record.patience);
  for (BenchRow& row : rows) {
    set_times(row, times.at(naive_of(row.scene)), times.at(name(row)));
    record.rows.push_back(std::move(row));
  }
}

}  // namespace crosscheck
