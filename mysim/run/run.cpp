#include "mysim/run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mysim/base/errors.h"

namespace crosscheck {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::energy:
      return "energy";
    case Verdict::nan:
      return "nan";
    case Verdict::stretch:
      return "stretch";
    case Verdict::solver:
      return "solver";
    case Verdict::frozen:
      return "frozen";
    case Verdict::timeout:
      return "timeout";
    case Verdict::crash:
      return "crash";
    case Verdict::unsupported:
      return "unsupported";
  }
  return "unknown";
}

std::string_view in_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::energy:
      return "blew up (ten times too fast)";
    case Verdict::nan:
      return "blew up (not a number)";
    case Verdict::stretch:
      return "overstretched (ten times too long)";
    case Verdict::solver:
      return "the solver gave up";
    case Verdict::frozen:
      return "frozen (forces act, nothing moves)";
    case Verdict::timeout:
      return "out of time";
    case Verdict::crash:
      return "the program failed";
    case Verdict::unsupported:
      return "unsupported";
  }
  return "unknown";
}

Run default_run(const Scene& scene) {
  return {scene.step, scene.duration, scene.samples, 0.01 * scene.tolerance / scene.size()};
}

TimeGrid time_grid(const Run& run) {
  const double interval = run.duration / run.samples;
  // keeps a step that divides the interval up to round-off: 1e-9 is far above round-off and far below one step
  const double wanted = std::ceil(interval / run.step * (1 - 1e-9));
  if (!(wanted <= 1e9))
    throw InputError(fmt::format("step {:g} s: expected at most 1e9 steps between two samples", run.step));
  const int steps = std::max(1, static_cast<int>(wanted));
  return {interval / steps, steps, run.samples};
}

int verdict_stride(const TimeGrid& grid, int particles) {
  const int n = grid.steps_per_sample;
  int states = std::clamp(std::min(8192, (1 << 20) / std::max(1, particles)) / grid.samples, 1, n);  // per sample
  while (n % states != 0) --states;
  return n / states;
}

bool Observers::every_step() const {
  return std::any_of(list_.begin(), list_.end(), [](const Observer* o) { return o->every_step(); });
}

Verdict Observers::observe(const State& state, bool sample) {
  Verdict first = Verdict::ok;
  for (Observer* o : list_)
    if (sample || o->every_step())
      if (const Verdict v = o->observe(state, sample); first == Verdict::ok) first = v;
  return first;
}

void Observers::contact(double lost) {
  for (Observer* o : list_) o->contact(lost);
}

}  // namespace crosscheck
