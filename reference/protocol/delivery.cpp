// Checks and plays frames.
#include "reference/protocol/delivery.h"

#include <fmt/format.h>

#include "mysim/errors.h"
#include "reference/npy.h"

namespace crosscheck {

std::vector<Points> read_positions(const std::filesystem::path& file, const Scene& scene, const Run& run,
                                   bool cut_short) {
  const int frames = plan(run).samples + 1;
  std::vector<Points> x = read_npy(file, cut_short ? 1 : frames, frames, scene.model.particles.size());
  // single precision knows the start to 1e-7 of its coordinates
  const double off = largest_column(x[0] - scene.start.x), scale = scene.size() + largest_column(scene.start.x);
  if (!(off <= 1e-6 * scale))
    throw InputError(fmt::format("{}: expected the scene's start as the first frame, got one that is {:.3g} m off",
                                 file.string(), off));
  return x;
}

void play(const Frames& frames, const Scene& scene, const Run& run, Observer& observer, Outcome& out) {
  const StepPlan steps = plan(run);
  const bool moving = !scene.model.first_order() && !frames.v.empty();
  for (size_t i = 0; i < frames.x.size(); ++i) {
    const double t = steps.time(static_cast<int>(i), 0);
    const Verdict verdict = observer.observe({t, frames.x[i], moving ? frames.v[i] : Points(3, 0)}, true);
    out.end = t;
    if (verdict == Verdict::ok) continue;
    out.verdict = verdict;
    out.reason = fmt::format("the run failed at t = {:.4g} s", t);
    return;
  }
}

}  // namespace crosscheck
