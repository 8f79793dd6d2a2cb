// What the page's script calls of the engine. Texts go through one buffer; numbers lie where the functions say.
#include <memory>
#include <optional>
#include <string>

#include "report/lab/live_run.h"

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace crosscheck {
namespace {

/// All that the module holds: one scene, one run.
struct Lab {
  std::string text;
  std::optional<Scene> scene;
  std::unique_ptr<LiveRun> run;
  std::uint64_t hash = 0;
};
Lab& lab() {
  static Lab only;
  return only;
}

const char* shown(std::string text) {
  lab().text = std::move(text);
  return lab().text.c_str();
}

}  // namespace

/// A place for a text of so many bytes.
EXPORT(text_of) char* text_of(int bytes) {
  lab().text.assign(static_cast<size_t>(bytes), ' ');
  return lab().text.data();
}

/// Reads a scene from the text (TOML); the number of its particles.
EXPORT(read_scene) int read_lab_scene() {
  lab().run.reset();
  lab().scene = parse_scene(std::string(lab().text), "scene");
  return lab().scene->model.particles.size();
}
EXPORT(duration) double duration() { return lab().scene->duration; }
EXPORT(default_step) double default_step() { return lab().scene->step; }
EXPORT(highest_frequency) double frequency() { return highest_frequency_bound(lab().scene->model, lab().scene->start); }

/// The steppers, by their place in the table.
EXPORT(steppers) int count_of_steppers() { return static_cast<int>(steppers().size()); }
EXPORT(stepper_name) const char* stepper_name(int which) { return shown(std::string(steppers()[static_cast<size_t>(which)].name)); }

EXPORT(start) void start(int stepper, double step, double duration, int sticky) {
  lab().run = std::make_unique<LiveRun>(
      *lab().scene, LiveSettings{&steppers()[static_cast<size_t>(stepper)], step, duration,
                                 sticky ? ContactRule::sticky : ContactRule::coulomb});
}
EXPORT(advance) int advance(int steps) { return lab().run->advance(steps); }
EXPORT(time) double time_now() { return lab().run->state().t; }
EXPORT(positions) const double* positions() { return lab().run->state().x.data(); }
EXPORT(velocities) const double* velocities() { return lab().run->state().v.data(); }
EXPORT(verdict) int verdict() { return static_cast<int>(lab().run->outcome().verdict); }
EXPORT(reason) const char* reason() { return shown(lab().run->outcome().reason); }
EXPORT(fingerprint) const std::uint64_t* fingerprint() {
  lab().hash = hash_of(lab().run->state());
  return &lab().hash;
}

}  // namespace crosscheck
