#include "experiments/bench/kernels.h"

#include <fmt/format.h>

#include <memory>

#include "experiments/bench/sheet.h"
#include "experiments/cost/cost.h"
#include "experiments/timing.h"
#include "mysim/spring_kernel.h"
#include "mysim/strip/kernels.h"
#include "mysim/strip/sheet_body.h"

namespace crosscheck {
namespace {

/// A sheet with a wave in it, so that every spring pulls.
Scene waving_sheet(int n) {
  Scene scene = sheet(n);
  for (int i = 0; i < scene.start.x.cols(); ++i)
    scene.start.x(1, i) += 0.03 * std::sin(9 * scene.start.x(0, i)) * std::sin(6 * scene.start.x(2, i));
  return scene;
}

struct Row {
  std::string kernel, instructions, precision;
  int n;
  std::function<void()> once;
  std::string name() const { return fmt::format("{}, {}, {}, {}", kernel, instructions, precision, n); }
};

/// Spring by spring on Eigen's vectors, as one writes it first.
std::function<void()> naive_loop(const Scene& scene) {
  struct Work {
    std::vector<Spring> springs;
    std::vector<Vec3> x, f;
  };
  auto work = std::make_shared<Work>();
  work->springs = scene.model.find<Springs>()->list;
  for (int i = 0; i < scene.start.x.cols(); ++i) work->x.push_back(scene.start.x.col(i));
  work->f.resize(work->x.size());
  return [work] {
    for (Vec3& f : work->f) f.setZero();
    for (const Spring& s : work->springs) {
      const Vec3 d = work->x[s.a] - work->x[s.b];
      const double length = d.norm();
      const Vec3 force = s.k * (s.rest - length) / length * d;
      work->f[s.a] += force;
      work->f[s.b] -= force;
    }
    asm volatile("" : : "r"(work->f.data()) : "memory");
  };
}

std::function<void()> plain_loop(const Scene& scene) {
  auto forces = std::make_shared<Forces>();
  forces->f = Points::Zero(3, scene.start.x.cols());
  return [forces, scene] {
    forces->clear();
    add_force(*scene.model.find<Springs>(), scene.model.particles, scene.start, *forces);
  };
}

std::function<void()> general_kernel(const Scene& scene) {
  struct Work {
    SpringKernel kernel;
    Forces forces;
  };
  auto work =
      std::make_shared<Work>(Work{SpringKernel(*scene.model.find<Springs>(), scene.model.particles.size()), {}});
  work->forces.f = Points::Zero(3, scene.start.x.cols());
  return [work, x = scene.start.x] {
    work->forces.clear();
    work->kernel.add_force(x, work->forces);
  };
}

template <class T>
std::function<void()> sweep(const Scene& scene, strip::Isa isa, bool fast) {
  struct Work {
    strip::SheetBody<T> body;
    strip::Lines<T> lose, push, span;
  };
  const auto weave = strip::weave_of(*scene.model.find<Springs>(), scene.model.particles.size());
  auto work = std::make_shared<Work>(Work{strip::SheetBody<T>(*weave), {}, {}, {}});
  const double h = scene.step, m = scene.model.particles.mass[0];
  const auto all = [&](double value) { return work->body.spread(Eigen::ArrayXd::Constant(1, value)); };
  // strongly damped: it comes to rest, and its springs go on being computed
  work->lose = all(0.1), work->push = all(h / m), work->span = all(h);
  work->body.put(scene.start.x, scene.start.v);
  strip::Sheet<T>& sheet = work->body.sheet();
  sheet.lose = work->lose.data(), sheet.push = work->push.data(), sheet.span = work->span.data();
  const strip::Stride<T> stride{{0, 0, 0}, static_cast<T>(h / 2), static_cast<T>(h / 2), nullptr, 0, nullptr, nullptr};
  return [work, stride, kernel = strip::kernel<T>(isa, fast)] { kernel.sweep(work->body.sheet(), stride); };
}

std::vector<Row> rows_for(int n) {
  const Scene scene = waving_sheet(n);
  std::vector<Row> rows{{"naive loop", "SSE2", "double", n, naive_loop(scene)},
                        {"plain loop", "SSE2", "double", n, plain_loop(scene)},
                        {"general kernel", "SSE2", "double", n, general_kernel(scene)}};
  for (const strip::Isa isa : strip::available()) {
    const std::string name(name_of(isa));
    rows.push_back({"sweep, reproducible", name, "double", n, sweep<double>(scene, isa, false)});
    if (isa != strip::Isa::sse2) rows.push_back({"sweep, fastest", name, "double", n, sweep<double>(scene, isa, true)});
    rows.push_back({"sweep, fastest", name, "single", n, sweep<float>(scene, isa, true)});
  }
  return rows;
}

/// The most that a set of instructions does, in operations a second.
template <class T>
Micro peak_of(strip::Isa isa, const std::string& name) {
  return {name, [kernel = strip::kernel<T>(isa, false), sum = std::make_shared<T>(0)] {
            kernel.multiply_and_add(1000, sum.get());
          }};
}

std::string peak_name(const std::string& instructions, const std::string& precision) {
  return fmt::format("peak, {}, {}", instructions, precision);
}

std::vector<double> quotients(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) all.push_back(a[i] / b[i]);
  return all;
}

}  // namespace

Table kernels_table(const KernelsAsked& asked) {
  std::vector<Row> rows;
  std::vector<Micro> micros;
  for (const int n : asked.sizes)
    for (Row& row : rows_for(n)) rows.push_back(std::move(row));
  for (const Row& row : rows) micros.push_back({row.name(), row.once});
  std::map<std::string, double> operations;  // of a run of each peak
  for (const strip::Isa isa : strip::available()) {
    const std::string name(name_of(isa));
    micros.push_back(peak_of<double>(isa, peak_name(name, "double")));
    micros.push_back(peak_of<float>(isa, peak_name(name, "single")));
    double none = 0;
    float nothing = 0;
    operations[peak_name(name, "double")] = 1000. * strip::kernel<double>(isa, false).multiply_and_add(0, &none);
    operations[peak_name(name, "single")] = 1000. * strip::kernel<float>(isa, false).multiply_and_add(0, &nothing);
  }
  const auto times = measured(micros, asked.plan);
  Table table{"bench-kernels-cost",
              {{"particles a side", "1"},
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
    const double springs = static_cast<double>(sheet(row.n).model.find<Springs>()->list.size());
    const std::vector<double>& own = times.at(row.name());
    const Timing each = timing_of(own).times(1e9 / springs);
    const Timing ratio = timing_of(quotients(times.at(Row{"naive loop", "SSE2", "double", row.n, {}}.name()), own));
    const std::string peak = peak_name(row.instructions == "SSE2" ? "sse2" : row.instructions, row.precision);
    const double rate = flop_per_spring / each.median,
                 most = operations.at(peak) / timing_of(times.at(peak)).median / 1e9;
    table.add({static_cast<long>(row.n), row.kernel, row.instructions, row.precision, each.median, each.low, each.high,
               ratio.median, ratio.low, ratio.high, rate, rate / most});
  }
  return table;
}

}  // namespace crosscheck
