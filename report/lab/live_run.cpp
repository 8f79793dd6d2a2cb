#include "report/lab/live_run.h"

#include <bit>

#include "mysim/base/hash.h"

namespace crosscheck {
namespace {

/// As many samples as the scene has in its own duration.
Run run_of(const Scene& scene, const LiveSettings& settings) {
  Run run = default_run(scene);
  run.samples = std::max(1, static_cast<int>(std::lround(scene.samples * settings.duration / scene.duration)));
  run.step = settings.step, run.duration = settings.duration, run.timed = false;
  return run;
}

}  // namespace

LiveRun::LiveRun(Scene scene, const LiveSettings& settings)
    : scene_(std::move(scene)),
      run_(run_of(scene_, settings)),
      ledger_(scene_.model, ContactLoss::reported),
      monitor_(scene_, run_),
      observers_(monitor_, {&ledger_}),
      world_(make_world(*settings.stepper, settings.contact, scene_, run_, observers_)),
      loop_(std::make_unique<RunLoop>(*world_, run_, observers_)) {}

int LiveRun::advance(int steps) {
  for (int taken = 0; taken < steps; ++taken)
    if (!loop_->step()) return taken;
  return steps;
}

std::uint64_t hash_of(const State& state) {
  Fnv1a hash;
  const auto add = [&](double value) {
    const auto word = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i) hash.add(static_cast<unsigned char>(word >> (8 * i)));
  };
  add(state.t);
  for (const Points* points : {&state.x, &state.v})
    for (Eigen::Index i = 0; i < points->size(); ++i) add(points->data()[i]);
  return hash.value();
}

}  // namespace crosscheck
