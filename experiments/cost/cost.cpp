#include "experiments/cost/cost.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "experiments/estimate.h"
#include "experiments/scenes/cloths.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/cost.h"
#include "experiments/timing/timing.h"
#include "mysim/base/this_process.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"
#include "mysim/simd/spring_graph/spring_kernel.h"

namespace crosscheck {
namespace {

/// Prevents the compiler from optimising away the work on `data`.
void keep(const double* data) { asm volatile("" : : "r"(data) : "memory"); }

#if defined(__SANITIZE_ADDRESS__)
// no clones: the function that chooses one runs before the sanitizer is ready
#else
[[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
void triad(double* __restrict a, const double* __restrict b, const double* __restrict c, size_t n) {
  for (size_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
}

}  // namespace

Kernel multiply_add_kernel() {
  constexpr long rounds = 400000;
  const simd::Kernel<double> kernel = simd::kernel<double>(simd::active_instruction_set(), false);
  double none = 0;
  const int each = kernel.multiply_and_add(0, &none);
  return {static_cast<double>(each) * rounds, 0, [kernel, sum = std::make_shared<double>(0)] {
            return cpu_time_of([&] { kernel.multiply_and_add(rounds, sum.get()); });
          }};
}

Kernel triad_kernel(double bytes) {
  const auto n = static_cast<size_t>(bytes / 24);
  const int rounds = std::max(1, static_cast<int>(32e6 / bytes));
  struct Arrays {
    std::vector<double> a, b, c;
  };
  auto arrays =
      std::make_shared<Arrays>(Arrays{std::vector<double>(n, 1), std::vector<double>(n, 2), std::vector<double>(n, 3)});
  return {2. * static_cast<double>(n) * rounds, 24. * static_cast<double>(n) * rounds, [arrays, n, rounds] {
            double* a = arrays->a.data();
            const double *b = arrays->b.data(), *c = arrays->c.data();
            return cpu_time_of([&] {
              for (int round = 0; round < rounds; ++round) {
                triad(a, b, c, n);
                keep(a);
              }
            });
          }};
}

namespace {

Run steps_of(const Scene& scene, long steps) { return {scene.step, scene.step * static_cast<double>(steps), 1}; }

/// Number of steps that take about 10 ms according to the estimate.
long steps_to_time(const Method& method, const Scene& scene) {
  const double each = estimated_seconds(method, scene, steps_of(scene, 1));
  return std::clamp(std::lround(0.01 / each), 2L, 2000L);
}

/// `run` returns its CPU time, s; `count`: number of steps or calls, known after a run.
struct TimedLoop {
  std::function<double()> run;
  std::shared_ptr<double> count = std::make_shared<double>(1);
};

/// `run` returns 0 if the method does not support the scene.
TimedLoop timed_steps(const Method& method, const Scene& scene, long steps, Outcome* outcome = nullptr) {
  TimedLoop loop;
  loop.run = [&method, &scene, steps, outcome, count = loop.count] {
    NullObserver null_observer;
    Outcome out = method.engine(scene, steps_of(scene, steps), null_observer);
    *count = static_cast<double>(std::max(1L, out.steps));
    const double seconds = out.steps > 0 ? out.cpu_seconds : 0;
    if (outcome) *outcome = std::move(out);
    return seconds;
  };
  return loop;
}

/// Times (s) of one step or call. In quick measurements, loops that take at least 5 ms need no warm-up, and those that
/// take at least 10 ms run only twice.
std::vector<std::vector<double>> times_of(const std::vector<TimedLoop>& loops, bool full) {
  std::vector<std::function<double()>> runs;
  for (const TimedLoop& loop : loops) runs.push_back(loop.run);
  auto times = time_round_robin(runs, full ? TimingOptions{.least = 9, .most = 9}
                                           : TimingOptions{.least = 2, .most = 3, .enough = 0.02, .warm = 0.005});
  for (size_t i = 0; i < loops.size(); ++i)
    for (double& time : times[i]) time /= *loops[i].count;
  return times;
}

long springs_of(const Scene& scene) { return static_cast<long>(scene.model.find<Springs>()->list.size()); }

}  // namespace

void cost_of_size(const Request& request, int n, TableSet& tables) {
  const Scene scene = sized_cloth(n);
  std::vector<Method> methods, requested = methods_of(request, scene);
  // also measures the same rule on a general spring graph, for comparison with engines without a fused step
  if (request.methods.empty()) requested.push_back(find_method(std::string(subject().representative) + "+plain"));
  for (Method& method : requested) {
    if (method.adaptive) continue;
    if (run_method(method, scene, steps_of(scene, 1), {}).verdict != Verdict::unsupported)
      methods.push_back(std::move(method));
  }
  std::vector<TimedLoop> loops;
  std::vector<Outcome> outcomes(methods.size());
  for (size_t i = 0; i < methods.size(); ++i)
    loops.push_back(timed_steps(methods[i], scene, steps_to_time(methods[i], scene), &outcomes[i]));
  const auto times = times_of(loops, request.full);
  const double noise = noise_floor(times);
  Table table = table_of<SizeCostRow>();
  const auto particles = static_cast<long>(scene.start.x.cols());
  for (size_t i = 0; i < methods.size(); ++i) {
    const Timing t = timing_of(times[i]);
    if (!(t.median > 0)) {
      tables.notes.push_back(fmt::format("{} does not report its CPU time", methods[i].name));
      continue;
    }
    add(table, SizeCostRow{.method = methods[i].name,
                           .side = n,
                           .particles = particles,
                           .springs = springs_of(scene),
                           .step = scene.step,
                           .steps_timed = outcomes[i].steps,
                           .evaluations_per_step = static_cast<double>(outcomes[i].evaluations) /
                                                   static_cast<double>(std::max(1L, outcomes[i].steps)),
                           .cpu = t.median,
                           .cpu_low = t.low,
                           .cpu_high = t.high,
                           .cpu_per_particle = t.median / static_cast<double>(particles),
                           .repetitions = t.repetitions,
                           .noise = noise,
                           .build = build_of(methods[i].name)});
  }
  tables.add(table);
}

namespace {

TimedLoop springs_alone(const Scene& scene) {
  auto kernel = std::make_shared<SpringKernel>(*scene.model.find<Springs>(), static_cast<int>(scene.start.x.cols()));
  auto forces = std::make_shared<Forces>(Forces{Points::Zero(3, scene.start.x.cols())});
  const int calls = std::max(2, static_cast<int>(2e6 / static_cast<double>(springs_of(scene))));
  const auto run = [kernel, forces, &scene, calls] {
    return cpu_time_of([&] {
      for (int i = 0; i < calls; ++i) kernel->add_force(scene.start.x, *forces);
    });
  };
  return {run, std::make_shared<double>(calls)};
}

TimedLoop forces_alone(const Scene& scene) {
  auto system = std::make_shared<System>(scene.model);
  auto state = std::make_shared<State>(scene.start);
  auto a = std::make_shared<Points>(Points::Zero(3, scene.start.x.cols()));
  const int calls = std::max(2, static_cast<int>(2e6 / static_cast<double>(springs_of(scene))));
  const auto run = [system, state, a, calls] {
    return cpu_time_of([&] {
      for (int i = 0; i < calls; ++i) system->position_acceleration(*state, *a);
    });
  };
  return {run, std::make_shared<double>(calls)};
}

/// a - b. The interval is as wide as both intervals together.
Timing minus(const Timing& a, const Timing& b) {
  return {a.median - b.median, a.low - b.high, a.high - b.low, std::min(a.repetitions, b.repetitions)};
}

}  // namespace

Table phases_table(int n, const std::vector<std::string>& methods, const std::vector<Timing>& times) {
  Table table = table_of<PhaseCostRow>();
  const auto add_phase = [&](size_t method, const char* phase, const Timing& time, double all, const char* how) {
    add(table, PhaseCostRow{methods.at(method), n, phase, time.median, time.low, time.high, time.median / all, how});
  };
  const double whole = times.at(3).median;
  add_phase(0, "springs", times[0], whole, "the spring kernel alone");
  add_phase(0, "other forces", minus(times[1], times[0]), whole, "all forces at a position, less the springs");
  add_phase(0, "integration and loop", minus(times[2], times[1]), whole, "a step without sphere, less its forces");
  add_phase(0, "contact", minus(times[3], times[2]), whole, "a step with the sphere, less one without");
  add_phase(0, "whole step", times[3], whole, "with the sphere");
  for (size_t i = 1; i < methods.size(); ++i)
    add_phase(i, "whole step", times.at(3 + i), times[3 + i].median,
              i == 1 ? "all in one pass over memory" : "its phases cannot be measured from outside");
  return table;
}

void cost_of_phases(const Request& request, int n, TableSet& tables) {
  const Scene plain = sized_cloth(n), above = sized_cloth(n, true);
  const Method ours = find_method("mysim/leapfrog+plain"), fused = find_method("mysim/leapfrog");
  std::vector<Method> others;
  for (Method& m : methods_of(request, above))
    if (m.family().is_default_peer() && run_method(m, above, steps_of(above, 1), {}).verdict != Verdict::unsupported)
      others.push_back(std::move(m));
  const long steps = steps_to_time(ours, above);
  std::vector<TimedLoop> loops{springs_alone(plain), forces_alone(plain), timed_steps(ours, plain, steps),
                               timed_steps(ours, above, steps), timed_steps(fused, above, steps)};
  std::vector<std::string> names{ours.name, fused.name};
  for (const Method& m : others) {
    loops.push_back(timed_steps(m, above, steps_to_time(m, above)));
    names.push_back(m.name);
  }
  std::vector<Timing> t;
  for (const auto& times : times_of(loops, request.full)) t.push_back(timing_of(times));
  tables.add(phases_table(n, names, t));
}

std::optional<std::string> doubt_about_peak(double peak, double triad) {
  if (!(peak < triad)) return std::nullopt;
  return fmt::format(
      "cost: the loop for the peak did {:.2g} billion operations per second, fewer than a = b + s c in the cache "
      "({:.2g}): the peak of the machine is higher than shown",
      peak / 1e9, triad / 1e9);
}

void cost_against_roofline(bool full, TableSet& tables) {
  std::vector<int> sides{16, 32, 64, 128};
  if (full) sides.insert(sides.end(), {256, 512});
  std::vector<Scene> scenes;
  for (const int n : sides) scenes.push_back(sized_cloth(n));
  std::vector<RooflineRow> loops;
  std::vector<TimedLoop> timed;
  const auto add_loop = [&](const std::string& name, double flop, double bytes, TimedLoop loop) {
    loops.push_back({.what = name, .work = flop, .bytes = bytes});
    timed.push_back(std::move(loop));
  };
  const auto add_kernel = [&](const std::string& name, const Kernel& k) { add_loop(name, k.flop, k.bytes, {k.run}); };
  add_kernel("peak of multiplications and additions", multiply_add_kernel());
  add_kernel("bandwidth, 24 kB", triad_kernel(24e3));
  add_kernel("bandwidth, 1 MB", triad_kernel(1e6));
  add_kernel("bandwidth, 96 MB", triad_kernel(96e6));
  for (size_t i = 0; i < scenes.size(); ++i) {
    const auto springs = static_cast<double>(springs_of(scenes[i]));
    add_loop(fmt::format("springs, {0} x {0}", sides[i]), flop_per_spring * springs,
             bytes_per_spring * springs + bytes_per_particle * static_cast<double>(scenes[i].start.x.cols()),
             springs_alone(scenes[i]));
  }
  const auto times = times_of(timed, full);
  Table table = table_of<RooflineRow>();
  for (size_t i = 0; i < loops.size(); ++i) {
    const Timing t = timing_of(times[i]);
    RooflineRow& row = loops[i];
    row.cpu = t.median, row.cpu_low = t.low, row.cpu_high = t.high;
    row.rate = row.work / t.median;
    if (row.bytes > 0) row.intensity = row.work / row.bytes, row.bandwidth = row.bytes / t.median;
    add(table, row);
  }
  if (const auto doubt = doubt_about_peak(loops[0].rate, loops[1].rate)) tables.notes.push_back(*doubt);
  tables.add(table);
}

std::vector<Point> cost_points(const Request& request) {
  if (request.scenes_only) return {};
  std::vector<int> sides{8, 16, 32, 64, 128};
  if (request.full) sides.insert(sides.end(), {256, 512});
  std::string content = request.full ? "full" : "quick";
  for (const Method& m : request.methods) content += fmt::format(" {} {}", m.name, m.fingerprint);
  Request alone = request;  // the experiment uses its own cloth
  alone.scenes.clear();
  std::vector<Point> points;
  for (const int n : sides)
    points.push_back(
        {fmt::format("cost: {0} x {0}", n), content, [=](TableSet& tables) { cost_of_size(alone, n, tables); }});
  for (const int n : {32, 64})
    points.push_back({fmt::format("cost: phases, {0} x {0}", n), content,
                      [=](TableSet& tables) { cost_of_phases(alone, n, tables); }});
  points.push_back(
      {"cost: roofline", content, [full = request.full](TableSet& tables) { cost_against_roofline(full, tables); }});
  for (Point& point : points) point.timed = true;
  return points;
}

}  // namespace crosscheck
