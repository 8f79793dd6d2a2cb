#include "experiments/regress/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/estimate.h"
#include "experiments/regress/patience.h"

namespace crosscheck {
namespace {

/// Estimates are those of release builds. Without optimisation each number that Eigen reads is a call of several
/// functions: mysim's rules on cloth-hang, chain and spring take up to 350 times as long. Told by the assertions, as
/// fmt's headers turn optimisation on for a while, after which g++ says that it is on.
#ifdef NDEBUG
constexpr double slower = 1;
#else
constexpr double slower = 350;
#endif

}  // namespace

std::string Question::in_words() const {
  return fmt::format("{} under {}{}", scene.name, method.name, without.empty() ? "" : " without " + without);
}

Run run_over_window(const Scene& scene) {
  Run run = default_run(scene);
  run.samples = std::max(1, static_cast<int>(std::lround(scene.samples * scene.window / scene.duration)));
  run.duration = scene.duration / scene.samples * run.samples;
  run.timed = false;
  return run;
}

Answered answer_to(const Question& question) {
  const Scene& scene = question.scene;
  const Run run = run_over_window(scene);
  Recorder recorder;
  Ledger ledger(scene.model, question.method.contact);
  Patience patience(2 + 20 * slower * estimated_seconds(question.method, scene, run));
  std::vector<Observer*> observers{&recorder, &patience};
  if (!scene.model.first_order()) observers.push_back(&ledger);
  Answered answered;
  answered.outcome = run_method(question.method, scene, run, observers);
  answered.trajectory = std::move(recorder.trajectory);
  answered.ledger = ledger.rows();
  return answered;
}

Answered as_compared(const Answered& answered) {
  if (answered.outcome.verdict == Verdict::ok) return answered;
  Answered half{answered.outcome, {}, {}};
  const Trajectory& path = answered.trajectory;
  for (int i = 0; i < path.frames() && path.t[i] <= answered.outcome.end / 2; ++i)
    half.trajectory.t.push_back(path.t[i]), half.trajectory.x.push_back(path.x[i]);
  return half;
}

const Quantity* find(const std::vector<Quantity>& all, const std::string& name) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  return at == all.end() ? nullptr : &*at;
}

}  // namespace crosscheck
