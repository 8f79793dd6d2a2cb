// The plain loop, and rounds over the cases.
#include "experiments/regress/speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "experiments/estimate.h"
#include "experiments/observers.h"
#include "experiments/scenes/cloths.h"
#include "experiments/scenes/scenes.h"
#include "experiments/timing/timing.h"
#include "mysim/base/random.h"
#include "mysim/base/this_process.h"

namespace crosscheck {

PlainLoop::PlainLoop(const Scene& scene) : h_(1e-3 * scene.step) {
  const auto& particles = scene.model.particles;
  const auto n = static_cast<size_t>(particles.size());
  start_x_.assign(scene.start.x.data(), scene.start.x.data() + scene.start.x.size());
  start_v_.assign(scene.start.v.data(), scene.start.v.data() + scene.start.v.size());
  start_v_.resize(3 * n);  // first-order scenes have none
  force_.resize(3 * n);
  for (size_t i = 0; i < n; ++i) {
    inverse_mass_.push_back(particles.pinned[i] ? 0 : 1 / particles.mass[static_cast<Eigen::Index>(i)]);
    gravity_factor_.push_back(particles.pinned[i] ? 0 : 1);
  }
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) edges_.push_back({s.a, s.b, s.k, s.rest});
  if (const auto* gravity = scene.model.find<Gravity>())
    std::copy_n(gravity->acceleration.data(), 3, std::begin(gravity_));
}

double PlainLoop::seconds_of(long steps) {
  x_ = start_x_, v_ = start_v_;
  return cpu_time_of([&] { advance(steps); });
}

// aligned: what stands before it in the program must not change how fast it is
[[gnu::noinline, gnu::aligned(64)]] void PlainLoop::advance(long steps) {
  const size_t numbers = x_.size();
  for (long step = 0; step < steps; ++step) {
    std::fill(force_.begin(), force_.end(), 0.);
    for (const Edge& edge : edges_) {
      const double *a = &x_[3 * static_cast<size_t>(edge.a)], *b = &x_[3 * static_cast<size_t>(edge.b)];
      const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
      const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
      const double pull = length > 0 ? edge.stiffness * (length - edge.rest) / length : 0;
      double *on_a = &force_[3 * static_cast<size_t>(edge.a)], *on_b = &force_[3 * static_cast<size_t>(edge.b)];
      on_a[0] -= pull * dx, on_a[1] -= pull * dy, on_a[2] -= pull * dz;
      on_b[0] += pull * dx, on_b[1] += pull * dy, on_b[2] += pull * dz;
    }
    for (size_t i = 0; i < numbers; ++i) {
      v_[i] += h_ * (force_[i] * inverse_mass_[i / 3] + gravity_[i % 3] * gravity_factor_[i / 3]);
      x_[i] += h_ * v_[i];
    }
  }
}

namespace {

constexpr double resolution = 2e-3;   // s: shorter runs are repeated within a round until they have taken as much
constexpr double long_enough = 5e-3;  // s of CPU time by the estimate: a round of all cases takes half a second

/// From the start up to the end of the window, as far as that is not long; the same on every machine.
Run first_steps(const Scene& scene, const Method& method) {
  Run run = default_run(scene);
  run.samples = 1;  // the clock stops at samples
  const double each = estimated_seconds(method, scene, 1L), all = std::floor(scene.window / scene.step + 0.5);
  run.duration = scene.step * std::clamp(std::floor(long_enough / each), 2., std::max(2., all));
  return run;
}

/// A run that blows up, is refused or takes many times what it should has no speed.
bool ends_well(const Method& method, const SpeedCase& q) {
  TimeoutObserver timeout(2 + 20 * estimated_seconds(method, q.scene, q.run));
  return run_method(method, q.scene, q.run, {&timeout}).verdict == Verdict::ok;
}

double seconds_of(const Method& method, const SpeedCase& q) {
  const auto one_run = [&] {
    NullObserver null_observer;
    return method.engine(q.scene, q.run, null_observer).cpu_seconds;
  };
  return mean_time(one_run, resolution);
}

/// Takes small pieces of memory and gives some of them back, so that what is allocated next comes to lie elsewhere: a
/// small scene can take a quarter more time for where its arrays lie in memory, in any program.
class HeapShuffle {
 public:
  explicit HeapShuffle(std::mt19937_64& engine) {
    std::vector<std::unique_ptr<char[]>> given_back;
    for (size_t size = 16; size <= 1024; size += 16)  // malloc keeps a list for each of these sizes
      for (int i = 0; i < 8; ++i)
        (uniform(engine) < 0.5 ? kept_ : given_back).push_back(std::make_unique<char[]>(size));
    std::shuffle(given_back.begin(), given_back.end(), engine);
    for (auto& piece : given_back) piece.reset();
  }

 private:
  std::vector<std::unique_ptr<char[]>> kept_;
};

bool runs(const SpeedCase& q) { return ends_well(q.method, q) && (!q.against || ends_well(*q.against, q)); }

/// The number of steps of the plain loop that take long enough.
long steps_of_loop(const Scene& scene) {
  PlainLoop loop(scene);
  return repetitions_in(resolution / 2, [&](long steps) { return loop.seconds_of(steps); });
}

void measure_once(const SpeedCase& q, long loop_steps, Ratios& ratios) {
  PlainLoop loop(q.scene);
  const double per_steps = q.run.duration / q.scene.step / static_cast<double>(loop_steps);
  const double before = loop.seconds_of(loop_steps), is = seconds_of(q.method, q),
               was = q.against ? seconds_of(*q.against, q) : 0,
               plain = (before + loop.seconds_of(loop_steps)) / 2 * per_steps;
  ratios.is.push_back(is / plain);
  if (q.against) ratios.was.push_back(was / plain);
}

}  // namespace

std::string SpeedCase::in_words() const { return fmt::format("{} under {}", scene.name, method.name); }

std::vector<SpeedCase> speed_cases(const Selection& selection, const std::optional<Method>& against) {
  std::vector<Method> methods = selection.methods.empty() ? all_methods() : selection.methods;
  std::erase_if(methods, [](const Method& method) { return !method.family().in_process(); });
  std::vector<SpeedCase> all;
  const auto add = [&](const Scene& scene, const Method& method) {
    SpeedCase q{scene, method, against};
    q.run = first_steps(scene, method);
    if (passes(selection.filter, scene.name, method.name)) all.push_back(std::move(q));
  };
  if (against && !against->family().in_process()) return all;
  for (const Scene& scene : load_scenes(selection.scenes, selection.methods.empty() ? "" : selection.methods[0].name)) {
    const std::string own = find_method(scene.method).name;
    for (const Method& method : methods)
      if (against || method.name == own) add(scene, method);
  }
  if (!selection.scenes.empty()) return all;
  const Scene cloth = sized_cloth(32);  // large enough that no engine's overhead counts, small enough for its caches
  for (const Method& method : methods) add(cloth, method);
  return all;
}

std::vector<Ratios> measured_ratios(const std::vector<SpeedCase>& cases, int rounds, int seed) {
  std::mt19937_64 engine(static_cast<uint64_t>(seed));
  std::vector<long> loop_steps;  // 0: the case has no speed
  for (const SpeedCase& q : cases) loop_steps.push_back(runs(q) ? steps_of_loop(q.scene) : 0);
  std::vector<Ratios> all(cases.size());
  for (int round = 0; round < rounds; ++round) {
    const HeapShuffle shuffled(engine);
    for (size_t i = 0; i < cases.size(); ++i)
      if (loop_steps[i] > 0) measure_once(cases[i], loop_steps[i], all[i]);
  }
  return all;
}

}  // namespace crosscheck
