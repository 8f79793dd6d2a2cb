#include "experiments/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/scenes/cloths.h"
#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/progress.h"
#include "mysim/base/text.h"
#include "mysim/base/this_process.h"
#include "mysim/run/run.h"
#include "mysim/scene/keys.h"

namespace crosscheck {
namespace {

double seconds_of_evaluation(const Method& method, const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  const auto* bending = scene.model.find<Bending>();
  const double elements = static_cast<double>(scene.start.x.cols()) +
                          (springs ? static_cast<double>(springs->list.size()) : 0) +
                          (bending ? static_cast<double>(bending->list.size()) : 0);
  return method.family().call + method.family().element * elements;
}

}  // namespace

double estimated_seconds(const Method& method, const Scene& scene, const Run& run) {
  double evaluations = 1;  // per step
  // iterations of conjugate gradients, measured on cloth-hang at steps of 0.5 to 17 ms (mysim with the multigrid of
  // cloth grids, and Bullet) and on jelly at 1 to 7 ms (mysim without multigrid)
  const double longer = time_grid(run).h / scene.step;
  if (const Stepper* rule = stepper_of(method))
    evaluations = rule->evaluations > 0  ? rule->evaluations
                  : cloth_grid_of(scene) ? 20 * std::pow(longer, 0.3)
                                         : 60 * std::sqrt(longer);
  if (method.implicit && !method.stepper && method.family().in_process()) evaluations = 2.5 * std::pow(longer, 0.8);
  if (method.adaptive) evaluations = 7;
  return evaluations * run.duration / time_grid(run).h * seconds_of_evaluation(method, scene);
}

double estimated_as_it_begins(const Method& method, const Scene& scene, Run run) {
  const double part = 1. / run.samples;
  run.duration *= part, run.samples = 1;
  const auto evaluations = static_cast<double>(run_method(method, scene, run, {}).evaluations);
  return evaluations / part * seconds_of_evaluation(method, scene);
}

double estimated_seconds(const Method& method, const Scene& scene, long steps) {
  return estimated_seconds(method, scene, {scene.step, scene.step * static_cast<double>(steps), 1});
}

namespace {

/// More steps than any practical run has: at 10 ns, the cost of the cheapest step of one particle, they take 3 hours.
constexpr double most_steps = 1e12;

double springs_and_constraints_in(const Scene& scene) {
  double count = 0;
  if (const auto* springs = scene.model.find<Springs>()) count += static_cast<double>(springs->list.size());
  if (const auto* hard = scene.model.find<Constraints>()) count += static_cast<double>(hard->list.size());
  return count;
}

std::string in_words_of_demand(const ResourceEstimate& estimate) {
  return fmt::format("{:.3g} steps, about {}", estimate.steps, format_duration(estimate.seconds));
}

void require_steps(const ResourceEstimate& estimate, const Scene& scene, const Run& run) {
  if (estimate.steps > most_steps)
    throw InputError(
        fmt::format("{}: a step of {} s makes {}; expected at most {:g} steps, which is a step of {:.3g} s or "
                    "more (--step, or time.step of the scene)",
                    scene.name, run.step, in_words_of_demand(estimate), most_steps, run.duration / most_steps));
}

void require_memory_for(const Scene& scene, const std::string& what, double bytes, const ResourceEstimate& estimate) {
  if (const double free = free_memory(); bytes > free)
    throw InputError(
        fmt::format("{}: {} takes about {} of memory ({} particles, {:.0f} springs; {}); expected at most "
                    "the {} that are free",
                    scene.name, what, format_bytes(bytes), scene.start.x.cols(), springs_and_constraints_in(scene),
                    in_words_of_demand(estimate), format_bytes(free)));
}

}  // namespace

ResourceEstimate resource_estimate_of(const Method& method, const Scene& scene, const Run& run) {
  const double particles = static_cast<double>(scene.start.x.cols()), springs = springs_and_constraints_in(scene);
  ResourceEstimate estimate{};
  // as in time_grid(), but accepts any number of steps
  const double interval = run.duration / run.samples;
  estimate.steps = run.samples * std::max(1., std::ceil(interval / run.step * (1 - 1e-9)));
  estimate.seconds =
      estimated_seconds(method, scene, {run.duration / estimate.steps, run.duration / estimate.steps, 1}) *
      estimate.steps;
  const double state = (scene.model.first_order() ? 3 : 6) * sizeof(double) * particles;
  estimate.memory = sizeof(Spring) * springs + 57 * particles;
  if (!method.stepper)
    estimate.memory += 300 * (springs + particles);
  else
    estimate.memory +=
        40 * springs + 8 * state + (method.stepper->evaluations == 0 ? 2 * 72 * (springs + particles) : 0);
  estimate.frames = (run.samples + 1.) * state;
  return estimate;
}

Run with_duration(const Method& method, const Scene& scene, Run run, double duration) {
  const double samples = std::max(1., std::round(scene.samples * (duration / scene.duration)));
  Run longer = run;
  longer.duration = duration;
  if (samples > most_samples) {
    const double interval = scene.duration / scene.samples;
    longer.samples = 1, longer.duration = interval;  // estimates one interval, then multiplies
    const ResourceEstimate one = resource_estimate_of(method, scene, longer);
    const ResourceEstimate all{one.steps * samples, one.seconds * samples, one.memory, one.frames / 2 * samples};
    throw InputError(
        fmt::format("--duration {}: {:.3g} samples, one every {:.3g} s as in {}, {}, {} of frames; expected "
                    "at most a million samples: a duration of up to {:.6g} s",
                    duration, samples, interval, scene.name, in_words_of_demand(all), format_bytes(all.frames),
                    interval * most_samples));
  }
  longer.samples = static_cast<int>(samples);
  return longer;
}

void require_resources_to_write(const Method& method, const Scene& scene, const Run& run,
                                const std::filesystem::path& folder) {
  const ResourceEstimate estimate = resource_estimate_of(method, scene, run);
  require_steps(estimate, scene, run);
  require_memory_for(scene, "a run by " + method.name, estimate.memory, estimate);
  if (const double free = free_disk(folder); estimate.frames > free)
    throw InputError(
        fmt::format("--out {}: {} frames of {} particles take {} ({}); expected at most the {} that are free "
                    "on the disk",
                    folder.string(), run.samples + 1, scene.start.x.cols(), format_bytes(estimate.frames),
                    in_words_of_demand(estimate), format_bytes(free)));
}

void require_resources_to_keep(const std::vector<Method>& methods, const Scene& scene, const Run& run) {
  double kept = 0, most = 0;
  ResourceEstimate all{};
  for (const Method& method : methods) {
    const ResourceEstimate estimate = resource_estimate_of(method, scene, run);
    require_steps(estimate, scene, run);
    kept += estimate.frames, most = std::max(most, estimate.memory);
    all.steps += estimate.steps, all.seconds += estimate.seconds;
  }
  require_memory_for(scene, fmt::format("{} frames by each of {} methods", run.samples + 1, methods.size()),
                     kept + most, all);
}

namespace {

class ProgressObserver : public Observer {
 public:
  ProgressObserver(Observer& inner, double duration, Progress& progress)
      : inner_(inner), duration_(duration), progress_(progress) {}
  bool every_step() const override { return inner_.every_step(); }
  bool between_samples() const override { return inner_.between_samples(); }
  Verdict observe(const State& state, bool sample) override {
    if (sample) progress_.part(state.t / duration_);
    return inner_.observe(state, sample);
  }
  void contact(double lost) override { inner_.contact(lost); }

 private:
  Observer& inner_;
  double duration_;
  Progress& progress_;
};

}  // namespace

Method with_progress(const Method& method, Progress& progress) {
  Method reporting = method;
  reporting.engine = [method, &progress](const Scene& scene, const Run& run, Observer& observer) {
    const double steps = run.duration / run.step;
    progress.begin(fmt::format("{} by {}{}", scene.name, method.name,
                               method.adaptive ? "" : fmt::format(", {:.0f} steps of {:.3g} s", steps, run.step)),
                   estimated_seconds(method, scene, run));
    ProgressObserver observed(observer, run.duration, progress);
    return method.engine(scene, run, observed);
  };
  return reporting;
}

}  // namespace crosscheck
