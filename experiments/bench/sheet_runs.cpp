#include "experiments/bench/sheet_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/bench/pieces.h"
#include "mysim/frequency.h"
#include "mysim/observers/trajectory.h"
#include "reference/truth.h"

namespace crosscheck {
namespace {

/// mysim's ways to an accuracy: where the ladder of steps begins (in 2 / omega, below the rule's limit), and each step
/// over the next longer one.
struct Own {
  const char* method;
  double first, rung;
};
constexpr double fine = 0.8409, coarse = 0.5;  // 2^(-1/4); where runs are dear and a better rule is at hand
// the most accurate for its work first: where it errs less in as many evaluations there is no use in going on
constexpr Own own_methods[] = {{"mysim/suzuki4+fast", 1.3, fine},
                               {"mysim/leapfrog+fast", 0.95, fine},
                               {"mysim/leapfrog+single", 0.95, fine},
                               {"mysim/rk4", 1.35, coarse}};
constexpr double shortest = 0.05;        // step of any of them over its first
constexpr double truth_step = 1.36 / 8;  // in 2 / omega: an eighth of suzuki4's largest, and then halved

}  // namespace

SheetRuns::SheetRuns(const Scene& scene, Progress& progress)
    : scene_(scene), progress_(progress), unit_(2 / fastest_frequency(scene.model, scene.start)) {
  progress_.begin(fmt::format("{}: the truth", scene_.name));
  const Points coarse = end_of(truth_step);
  truth_ = end_of(truth_step / 2);
  bar_ = rms_distance(coarse, truth_);
}

Points SheetRuns::end_of(double part) const {
  Recorder recorder;
  run_method(find_method("mysim/suzuki4"), scene_, {part * unit_, scene_.duration, 1}, {&recorder});
  return recorder.trajectory.x.back();
}

SheetRun SheetRuns::done(const Method& method, double setting) const {
  Run run{unit_, scene_.duration, 1};
  (method.adaptive ? run.tolerance : run.step) = method.adaptive ? setting : setting * unit_;
  Recorder recorder;
  Outcome out = run_method(method, scene_, run, {&recorder});
  std::optional<double> error;
  if (out.verdict == Verdict::ok) error = rms_distance(recorder.trajectory.x.back(), truth_);
  return {method, run, std::move(out), method.adaptive ? setting : plan(run).h, error};
}

std::vector<SheetRun> SheetRuns::of(const std::vector<Peer>& peers) const {
  std::vector<SheetRun> runs;
  for (const Peer& peer : peers) {
    const Method method = find_method(peer.method);
    for (const double setting : peer.settings) {
      progress_.begin(fmt::format("{}: {}", scene_.name, peer.method));
      runs.push_back(done(method, setting));
      runs.back().other_model = peer.other_model;
    }
  }
  return runs;
}

std::vector<SheetRun> SheetRuns::own(double wanted, long most) const {
  std::vector<SheetRun> runs;
  const auto beaten = [&](const SheetRun& run) {
    return std::any_of(runs.begin(), runs.end(), [&](const SheetRun& other) {
      return other.method.name != run.method.name && other.ok() && run.ok() && *other.error <= *run.error &&
             other.outcome.evaluations <= run.outcome.evaluations;
    });
  };
  for (const Own& own : own_methods) {
    const Method method = find_method(own.method);
    progress_.begin(fmt::format("{}: {}", scene_.name, own.method));
    if (method.name.ends_with("+single") && !sweep<float>(scene_, strip::Isa::sse2, true)) continue;
    for (double part = own.first; part > shortest * own.first; part *= own.rung) {
      const SheetRun last = done(method, part);
      runs.push_back(last);
      if ((last.ok() && *last.error <= wanted) || beaten(last) || last.outcome.evaluations > most) break;
    }
  }
  return runs;
}

int SheetRuns::count(const std::vector<Peer>& peers) {
  int count = 1 + static_cast<int>(std::size(own_methods));
  for (const Peer& peer : peers) count += static_cast<int>(peer.settings.size());
  return count;
}

}  // namespace crosscheck
