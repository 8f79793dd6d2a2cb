#include "experiments/bench/kernels.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "experiments/bench/sheet.h"
#include "experiments/cost/cost.h"
#include "experiments/timing.h"

namespace crosscheck {
namespace {

using strip::Isa;

constexpr auto naive = "naive loop", double_precision = "double", single_precision = "single";

/// A sheet with a wave in it, so that every spring pulls.
Scene waving_sheet(int n) {
  Scene scene = sheet(n);
  for (int i = 0; i < scene.start.x.cols(); ++i)
    scene.start.x(1, i) += 0.03 * std::sin(9 * scene.start.x(0, i)) * std::sin(6 * scene.start.x(2, i));
  return scene;
}

struct Row {
  std::string kernel, instructions, precision;
  Piece once;
  std::string name() const { return fmt::format("{}, {}, {}", kernel, instructions, precision); }
};

void add_sweep(std::vector<Row>& rows, std::string kernel, Isa isa, std::string precision, std::optional<Piece> once) {
  if (once) rows.push_back({std::move(kernel), std::string(name_of(isa)), std::move(precision), std::move(*once)});
}

std::vector<Row> rows_for(const Scene& scene) {
  const std::string plainest(name_of(Isa::sse2));  // what the suite is compiled for
  std::vector<Row> rows{{naive, plainest, double_precision, naive_loop(scene)},
                        {"plain loop", plainest, double_precision, plain_loop(scene)}};
  for (const Isa isa : strip::available())
    rows.push_back({"general kernel", std::string(name_of(isa)), double_precision, general_kernel(scene, isa)});
  for (const Isa isa : strip::available()) {
    add_sweep(rows, "sweep, reproducible", isa, double_precision, sweep<double>(scene, isa, false));
    // with SSE2 both are the same
    if (isa != Isa::sse2) add_sweep(rows, "sweep, fastest", isa, double_precision, sweep<double>(scene, isa, true));
    add_sweep(rows, "sweep, fastest", isa, single_precision, sweep<float>(scene, isa, true));
  }
  return rows;
}

/// The most that an instruction set does.
struct Peak {
  std::string name;
  double operations;  // of a run
  Piece once;
};

std::string peak_name(std::string_view instructions, std::string_view precision) {
  return fmt::format("peak, {}, {}", instructions, precision);
}

template <class T>
Peak peak_of(Isa isa, const char* precision) {
  constexpr long rounds = 1000;
  const strip::Kernel<T> kernel = strip::kernel<T>(isa, false);
  T none = 0;
  return {peak_name(name_of(isa), precision), static_cast<double>(rounds) * kernel.multiply_and_add(0, &none),
          [kernel, sum = std::make_shared<T>(0)] { kernel.multiply_and_add(rounds, sum.get()); }};
}

std::vector<Peak> peaks() {
  std::vector<Peak> all;
  for (const Isa isa : strip::available()) {
    all.push_back(peak_of<double>(isa, double_precision));
    all.push_back(peak_of<float>(isa, single_precision));
  }
  return all;
}

}  // namespace

Table kernels_table(int side, const MicroPlan& plan) {
  const Scene scene = waving_sheet(side);
  const auto springs = static_cast<long>(scene.model.find<Springs>()->list.size());
  const std::vector<Row> rows = rows_for(scene);
  std::vector<Micro> micros;
  for (const Row& row : rows) micros.push_back({row.name(), row.once});
  const std::vector<Peak> most = peaks();
  for (const Peak& peak : most) micros.push_back({peak.name, peak.once});
  const auto times = measured(micros, plan);
  std::map<std::string, double> rate_of;  // GFLOP/s
  for (const Peak& peak : most) rate_of[peak.name] = peak.operations / timing_of(times.at(peak.name)).median / 1e9;
  Table table{"bench-kernels-cost",
              {{"particles a side", "1"},
               {"springs", "1"},
               {"kernel", "1"},
               {"instructions", "1"},
               {"precision", "1"},
               {"time per spring", "ns"},
               {"low", "ns"},
               {"high", "ns"},
               {"times the naive loop", "1"},
               {"ratio low", "1"},
               {"ratio high", "1"},
               {"rate", "GFLOP/s"},
               {"share of peak", "1"}},
              {}};
  for (const Row& row : rows) {
    const std::vector<double>& own = times.at(row.name());
    const Timing each = timing_of(own).times(1e9 / static_cast<double>(springs));
    const Timing ratio = timing_of(quotients(times.at(rows[0].name()), own));
    const double rate = flop_per_spring / each.median;
    table.add({static_cast<long>(side), springs, row.kernel, row.instructions, row.precision, each.median, each.low,
               each.high, ratio.median, ratio.low, ratio.high, rate,
               rate / rate_of.at(peak_name(row.instructions, row.precision))});
  }
  return table;
}

}  // namespace crosscheck
