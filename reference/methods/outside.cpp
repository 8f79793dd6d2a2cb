// Programs and trajectories from outside. Of them samples alone are seen: nothing is known of what happened between.
#include <fmt/format.h>

#include "reference/methods/families.h"
#include "reference/protocol/delivery.h"
#include "reference/protocol/exec_engine.h"

namespace crosscheck {

Method exec_method(const std::string& text) {
  return {"exec:" + text, "an outside program that speaks the engine protocol", "",
          [program = find_program(text)](const Scene& scene, const Run& run, Observer& observer) {
            return run_program(program, scene, run, observer);
          },
          ContactLoss::sampled};
}

Method trajectory_method(const std::filesystem::path& file, const Scene& scene, const Run& run) {
  Frames frames{read_positions(file, scene, run), {}};
  return {"file:" + file.filename().string(), "a trajectory from a file", "",
          [frames = std::move(frames)](const Scene& s, const Run& r, Observer& observer) {
            Outcome out;
            play(frames, s, r, observer, out);
            return out;
          },
          ContactLoss::sampled};
}

}  // namespace crosscheck
