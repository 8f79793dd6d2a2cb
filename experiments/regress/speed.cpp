// Rounds over questions.
#include "experiments/regress/speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "experiments/cost/sized_cloth.h"
#include "experiments/estimate.h"
#include "experiments/regress/patience.h"
#include "experiments/regress/plain_loop.h"
#include "experiments/scenes.h"
#include "mysim/uniform.h"

namespace crosscheck {
namespace {

constexpr double long_enough = 5e-3;  // s of CPU time by the estimate: a round of all questions takes half a second

bool inside(const Method& method) { return method.name.starts_with("mysim/") || method.name.starts_with("bullet/"); }

/// From the start up to the end of the window, as far as that is not long; the same on every machine.
Run first_steps(const Scene& scene, const Method& method) {
  Run run = default_run(scene);
  run.samples = 1;  // the clock stops at samples
  const double each = estimated_seconds(method, scene, 1L), all = std::floor(scene.window / scene.step + 0.5);
  run.duration = scene.step * std::clamp(std::floor(long_enough / each), 2., std::max(2., all));
  return run;
}

/// A run that blows up, is refused or takes many times what it should has no speed.
bool ends_well(const Method& method, const SpeedQuestion& q) {
  Patience patience(2 + 20 * estimated_seconds(method, q.scene, q.run));
  return run_method(method, q.scene, q.run, {&patience}).verdict == Verdict::ok;
}

class Nobody : public Observer {
 public:
  Verdict observe(const State&, bool) override { return Verdict::ok; }
};

double mean_seconds(double resolution, const std::function<double()>& run) {
  double sum = 0;
  int count = 0;
  do sum += run();
  while (++count < 1000 && sum < resolution);
  return sum / count;
}

double seconds_of(const Method& method, const SpeedQuestion& q, double resolution) {
  return mean_seconds(resolution, [&] {
    Nobody nobody;
    return method.engine(q.scene, q.run, nobody).cpu_seconds;
  });
}

/// Takes small pieces of memory and gives some of them back, so that what is asked for next comes to lie elsewhere: a
/// small scene can take a quarter more time for where its arrays lie beside each other, whoever wrote the program.
class OtherPlaces {
 public:
  explicit OtherPlaces(std::mt19937_64& engine) {
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

/// A question that is known to run, and how many steps of the plain loop take long enough.
struct Lane {
  bool runs;
  long steps = 1;

  Lane(const SpeedQuestion& q, double resolution)
      : runs(ends_well(q.method, q) && (!q.against || ends_well(*q.against, q))) {
    PlainLoop loop(q.scene);
    while (loop.seconds_of(steps) < resolution / 2 && steps < (1L << 40)) steps *= 2;
  }
};

void take_turn(const SpeedQuestion& q, const Lane& lane, double resolution, Ratios& ratios) {
  PlainLoop loop(q.scene);
  const double per_steps = q.run.duration / q.scene.step / static_cast<double>(lane.steps);
  const double before = loop.seconds_of(lane.steps), is = seconds_of(q.method, q, resolution),
               was = q.against ? seconds_of(*q.against, q, resolution) : 0,
               plain = (before + loop.seconds_of(lane.steps)) / 2 * per_steps;
  ratios.is.push_back(is / plain);
  if (q.against) ratios.was.push_back(was / plain);
}

}  // namespace

std::string SpeedQuestion::in_words() const { return fmt::format("{} under {}", scene.name, method.name); }

std::vector<SpeedQuestion> speed_questions(const Asked& asked, const std::optional<Method>& against) {
  std::vector<Method> methods = asked.methods.empty() ? all_methods() : asked.methods;
  std::erase_if(methods, [](const Method& method) { return !inside(method); });
  std::vector<SpeedQuestion> all;
  const auto add = [&](const Scene& scene, const Method& method) {
    SpeedQuestion q{scene, method, against};
    q.run = first_steps(scene, method);
    if (passes(asked.filter, scene.name, method.name)) all.push_back(std::move(q));
  };
  if (against && !inside(*against)) return all;
  for (const std::string& name : scenes_of(asked)) {
    const Scene scene = load_scene(name);
    const std::string own = find_method(scene.method).name;
    for (const Method& method : methods)
      if (against || method.name == own) add(scene, method);
  }
  if (!asked.scenes.empty()) return all;
  const Scene cloth = sized_cloth(32);  // large enough that no engine's overhead counts, small enough for its caches
  for (const Method& method : methods) add(cloth, method);
  return all;
}

std::vector<Ratios> measured_ratios(const std::vector<SpeedQuestion>& questions, const SpeedPlan& plan, int seed) {
  std::mt19937_64 engine(static_cast<uint64_t>(seed));
  std::vector<Lane> lanes;
  for (const SpeedQuestion& q : questions) lanes.emplace_back(q, plan.resolution);
  std::vector<Ratios> all(questions.size());
  for (int round = 0; round < plan.rounds; ++round) {
    const OtherPlaces elsewhere(engine);
    for (size_t i = 0; i < lanes.size(); ++i)
      if (lanes[i].runs) take_turn(questions[i], lanes[i], plan.resolution, all[i]);
  }
  return all;
}

}  // namespace crosscheck
