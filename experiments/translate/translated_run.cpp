#include "experiments/translate/translated_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/metrics.h"
#include "mysim/run/observers.h"

namespace crosscheck {
TranslatedRun run_translated(const Scene& source, const Translation& translation, const Method& method) {
  TranslatedRun result{.method = method.name};
  Run run = default_run(source);
  run.step = translation.h;
  Recorder translated;
  result.outcome = run_method(method, translation.back, run, {&translated});
  result.until = source.window;

  const std::optional<Truth> truth = truth_of(source, run);
  Trajectory beside;
  if (truth) {
    beside = truth->trajectory;
    result.bar = truth->error_bar;
    result.until = std::min(result.until, truth->until);
    result.beside = truth->under_contact_rule ? "the limit of mysim's contact rule"
                                              : fmt::format("the {} reference solution", name_of(truth->tier));
  } else {
    const Method representative = find_method(std::string(subject().representative));
    Recorder own;
    if (run_method(representative, source, run, {&own}).verdict == Verdict::ok) {
      beside = std::move(own.trajectory);
      result.beside = fmt::format("{} at the same step, another engine", representative.name);
    }
  }
  if (beside.frames() == 0) return result;
  result.motion = motion_of(beside);
  if (result.outcome.verdict != Verdict::ok) return result;
  const double distance = largest_rms_distance(translated.trajectory, beside, result.until);
  (truth && !truth->under_contact_rule ? result.error : result.difference) = distance;
  return result;
}

}  // namespace crosscheck
