// The tables of kernels.
#include "experiments/bench/spring_cost.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>

#include "experiments/cost/cost.h"
#include "experiments/scenes/cloths.h"
#include "experiments/tables/bench.h"
#include "experiments/timing/instruction_sets.h"
#include "experiments/timing/timing.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"

namespace crosscheck {
namespace {

using simd::InstructionSet;

constexpr auto naive = "naive loop", double_precision = "double", single_precision = "single";

/// A cloth with a wave in it, so that every spring pulls.
Scene waving_cloth(int n) {
  Scene scene = hanging_cloth(n);
  for (int i = 0; i < scene.start.x.cols(); ++i)
    scene.start.x(1, i) += 0.03 * std::sin(9 * scene.start.x(0, i)) * std::sin(6 * scene.start.x(2, i));
  return scene;
}

struct Row {
  std::string kernel;
  InstructionSet instructions;
  std::string precision;
  BenchmarkFunction once;
  std::string name() const { return fmt::format("{}, {}, {}", kernel, name_of(instructions), precision); }
};

void add_fused_step(std::vector<Row>& rows, std::string kernel, InstructionSet isa, std::string precision,
                    std::optional<BenchmarkFunction> once) {
  if (once) rows.push_back({std::move(kernel), isa, std::move(precision), std::move(*once)});
}

std::vector<Row> rows_for(const Scene& scene) {
  const InstructionSet baseline = InstructionSet::baseline;  // as the suite is compiled
  std::vector<Row> rows{{naive, baseline, double_precision, naive_loop(scene)},
                        {"plain loop", baseline, double_precision, plain_loop(scene)}};
  for (const InstructionSet isa : simd::supported_instruction_sets())
    rows.push_back({"general kernel", isa, double_precision, general_kernel(scene, isa)});
  for (const InstructionSet isa : simd::supported_instruction_sets()) {
    add_fused_step(rows, "sweep, reproducible", isa, double_precision, fused_step<double>(scene, isa, false));
    // on the baseline both are the same
    if (isa != InstructionSet::baseline)
      add_fused_step(rows, "sweep, fastest", isa, double_precision, fused_step<double>(scene, isa, true));
    add_fused_step(rows, "sweep, fastest", isa, single_precision, fused_step<float>(scene, isa, true));
  }
  return rows;
}

/// The most that an instruction set does.
struct Peak {
  std::string name;
  double operations;  // of a run
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

Table kernels_table(int side, const MicrobenchmarkOptions& options, const LockPatience& patience) {
  const Scene scene = waving_cloth(side);
  const auto springs = static_cast<long>(scene.model.find<Springs>()->list.size());
  const std::vector<Row> rows = rows_for(scene);
  std::vector<Microbenchmark> benchmarks;
  for (const Row& row : rows) benchmarks.push_back({row.name(), row.once});
  const std::vector<Peak> most = peaks();
  for (const Peak& peak : most) benchmarks.push_back({peak.name, peak.once});
  const auto times = run_microbenchmarks(benchmarks, options, patience);
  std::map<std::string, double> rate_of;  // GFLOP/s
  for (const Peak& peak : most) rate_of[peak.name] = peak.operations / timing_of(times.at(peak.name)).median / 1e9;
  Table table = table_of<KernelRow>();
  for (const Row& row : rows) {
    const std::vector<double>& own = times.at(row.name());
    const Timing each = timing_of(own).times(1e9 / static_cast<double>(springs));
    const Timing ratio = timing_of(ratios_of_rounds(times.at(rows[0].name()), own));
    const double rate = flop_per_spring / each.median;
    add(table, KernelRow{.side = side,
                         .springs = springs,
                         .kernel = row.kernel,
                         .instructions = row.instructions,
                         .precision = row.precision,
                         .time = each.median,
                         .low = each.low,
                         .high = each.high,
                         .ratio = ratio.median,
                         .ratio_low = ratio.low,
                         .ratio_high = ratio.high,
                         .rate = rate,
                         .share_of_peak = rate / rate_of.at(peak_name(name_of(row.instructions), row.precision))});
  }
  return table;
}

namespace {

using simd::InstructionSet;

long springs_of(const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  return springs ? static_cast<long>(springs->list.size()) : 0;
}

std::string naive_name(const Scene& scene) { return scene.name + ", naive loop"; }

}  // namespace

Table scenes_table(const std::vector<Scene>& scenes, const MicrobenchmarkOptions& options,
                   const LockPatience& patience) {
  struct KernelCase {
    const Scene* scene;
    std::string kernel;
    InstructionSet instructions;
    std::string name;
  };
  std::vector<KernelCase> cases;
  std::vector<Microbenchmark> benchmarks;
  const auto add_case = [&](const Scene& scene, const char* kernel, InstructionSet isa, BenchmarkFunction once) {
    cases.push_back({&scene, kernel, isa, fmt::format("{}, {}, {}", scene.name, kernel, name_of(isa))});
    benchmarks.push_back({cases.back().name, std::move(once)});
  };
  for (const Scene& scene : scenes) {
    if (springs_of(scene) == 0) continue;
    benchmarks.push_back({naive_name(scene), naive_loop(scene)});
    std::set<InstructionSet> sets;
    for (const CodePath& path : code_paths()) sets.insert(path.instructions);
    for (const InstructionSet isa : sets) add_case(scene, "general kernel", isa, general_kernel(scene, isa));
    for (const InstructionSet isa : sets)
      if (auto piece = fused_step<double>(scene, isa, false))
        add_case(scene, "sweep, reproducible", isa, std::move(*piece));
  }
  const auto times = run_microbenchmarks(benchmarks, options, patience);
  Table table = table_of<SceneKernelRow>();
  for (const KernelCase& kernel_case : cases) {
    const Scene& scene = *kernel_case.scene;
    const auto &own = times.at(kernel_case.name), &beside = times.at(naive_name(scene));
    const Timing each = timing_of(own).times(1e9), ratio = timing_of(ratios_of_rounds(beside, own));
    add(table, SceneKernelRow{.scene = scene.name,
                              .particles = scene.start.x.cols(),
                              .springs = springs_of(scene),
                              .kernel = kernel_case.kernel,
                              .instructions = kernel_case.instructions,
                              .time = each.median,
                              .low = each.low,
                              .high = each.high,
                              .naive = timing_of(beside).median * 1e9,
                              .ratio = ratio.median,
                              .ratio_low = ratio.low,
                              .ratio_high = ratio.high});
  }
  return table;
}

}  // namespace crosscheck
