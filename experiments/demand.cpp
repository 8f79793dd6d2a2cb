// Bytes and steps.
#include "experiments/demand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/estimate.h"
#include "mysim/errors.h"
#include "mysim/free_room.h"
#include "mysim/progress.h"
#include "mysim/scene_keys.h"

namespace crosscheck {
namespace {

/// Far beyond any question: three hours at the ten nanoseconds that the cheapest step of one particle takes.
constexpr double most_steps = 1e12;

double springs_and_hard_in(const Scene& scene) {
  double count = 0;
  if (const auto* springs = scene.model.find<Springs>()) count += static_cast<double>(springs->list.size());
  if (const auto* hard = scene.model.find<Constraints>()) count += static_cast<double>(hard->list.size());
  return count;
}

std::string told_demand(const Demand& demand) {
  return fmt::format("{:.3g} steps, about {}", demand.steps, rough_duration(demand.seconds));
}

void require_steps(const Demand& demand, const Scene& scene, const Run& run) {
  if (demand.steps > most_steps)
    throw InputError(
        fmt::format("{}: a step of {} s makes {}; expected at most {:g} steps, which is a step of {:.3g} s or "
                    "more (--step, or time.step of the scene)",
                    scene.name, run.step, told_demand(demand), most_steps, run.duration / most_steps));
}

void require_memory_for(const Scene& scene, const std::string& what, double bytes, const Demand& demand) {
  if (const double free = free_memory(); bytes > free)
    throw InputError(
        fmt::format("{}: {} takes about {} of memory ({} particles, {:.0f} springs; {}); expected at most "
                    "the {} that are free",
                    scene.name, what, in_bytes(bytes), scene.start.x.cols(), springs_and_hard_in(scene),
                    told_demand(demand), in_bytes(free)));
}

}  // namespace

Demand demand_of(const Method& method, const Scene& scene, const Run& run) {
  const double particles = static_cast<double>(scene.start.x.cols()), springs = springs_and_hard_in(scene);
  Demand demand{};
  // as plan() does, without its refusal
  const double interval = run.duration / run.samples;
  demand.steps = run.samples * std::max(1., std::ceil(interval / run.step * (1 - 1e-9)));
  demand.seconds =
      estimated_seconds(method, scene, {run.duration / demand.steps, run.duration / demand.steps, 1}) * demand.steps;
  const double state = (scene.model.first_order() ? 3 : 6) * sizeof(double) * particles;
  demand.memory = sizeof(Spring) * springs + 57 * particles;
  if (!method.stepper)
    demand.memory += 300 * (springs + particles);
  else
    demand.memory += 40 * springs + 8 * state + (method.stepper->evaluations == 0 ? 2 * 72 * (springs + particles) : 0);
  demand.frames = (run.samples + 1.) * state;
  return demand;
}

Run lengthened(const Method& method, const Scene& scene, Run run, double duration) {
  const double samples = std::max(1., std::round(scene.samples * (duration / scene.duration)));
  Run longer = run;
  longer.duration = duration;
  if (samples > most_samples) {
    const double interval = scene.duration / scene.samples;
    longer.samples = 1, longer.duration = interval;  // what a single interval takes, so often
    const Demand one = demand_of(method, scene, longer);
    const Demand all{one.steps * samples, one.seconds * samples, one.memory, one.frames / 2 * samples};
    throw InputError(fmt::format(
        "--duration {}: {:.3g} samples, one each {:.3g} s as in {}, {}, {} of frames; expected "
        "at most a million samples: a duration of up to {:.6g} s",
        duration, samples, interval, scene.name, told_demand(all), in_bytes(all.frames), interval * most_samples));
  }
  longer.samples = static_cast<int>(samples);
  return longer;
}

void require_room_to_write(const Method& method, const Scene& scene, const Run& run,
                           const std::filesystem::path& folder) {
  const Demand demand = demand_of(method, scene, run);
  require_steps(demand, scene, run);
  require_memory_for(scene, "a run by " + method.name, demand.memory, demand);
  if (const double free = free_disk(folder); demand.frames > free)
    throw InputError(
        fmt::format("--out {}: {} frames of {} particles take {} ({}); expected at most the {} that are free "
                    "on the disk",
                    folder.string(), run.samples + 1, scene.start.x.cols(), in_bytes(demand.frames),
                    told_demand(demand), in_bytes(free)));
}

void require_room_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run) {
  double kept = 0, most = 0;
  Demand all{};
  for (const Method& method : methods) {
    const Demand demand = demand_of(method, scene, run);
    require_steps(demand, scene, run);
    kept += demand.frames, most = std::max(most, demand.memory);
    all.steps += demand.steps, all.seconds += demand.seconds;
  }
  require_memory_for(scene, fmt::format("{} frames by each of {} methods", run.samples + 1, methods.size()),
                     kept + most, all);
}

}  // namespace crosscheck
