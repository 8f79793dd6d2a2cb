#include "experiments/regress/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/estimate.h"
#include "experiments/observers.h"
#include "experiments/scenes/ingredients.h"
#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/pattern.h"
#include "mysim/base/text.h"

namespace crosscheck {
namespace {

/// Factor for estimated times, which are those of release builds. Without optimisation, each access to a number through
/// Eigen is several function calls: mysim's rules on cloth-hang, chain and spring take up to 350 times as long.
/// __OPTIMIZE__ cannot be used here, because fmt's headers switch optimisation on temporarily, and afterwards g++
/// reports it as on.
#ifdef NDEBUG
constexpr double slower = 1;
#else
constexpr double slower = 350;
#endif

}  // namespace

std::string Case::in_words() const {
  return fmt::format("{} under {}{}", scene.name, method.name, without.empty() ? "" : " without " + without);
}

Run run_over_window(const Scene& scene) {
  Run run = default_run(scene);
  run.samples = std::max(1, static_cast<int>(std::lround(scene.samples * scene.window / scene.duration)));
  run.duration = scene.duration / scene.samples * run.samples;
  run.timed = false;
  return run;
}

CaseRun run_case(const Case& test_case) {
  const Scene& scene = test_case.scene;
  const Run run = run_over_window(scene);
  Recorder recorder;
  Ledger ledger(scene.model, test_case.method.contact);
  TimeoutObserver timeout(2 + 20 * slower * estimated_seconds(test_case.method, scene, run));
  std::vector<Observer*> observers{&recorder, &timeout};
  if (!scene.model.first_order()) observers.push_back(&ledger);
  CaseRun case_run;
  case_run.outcome = run_method(test_case.method, scene, run, observers);
  case_run.trajectory = std::move(recorder.trajectory);
  case_run.ledger = ledger.rows();
  return case_run;
}

CaseRun comparable_part(const CaseRun& case_run) {
  if (case_run.outcome.verdict == Verdict::ok) return case_run;
  CaseRun half{case_run.outcome, {}, {}};
  const Trajectory& path = case_run.trajectory;
  for (int i = 0; i < path.frames() && path.t[i] <= case_run.outcome.end / 2; ++i)
    half.trajectory.t.push_back(path.t[i]), half.trajectory.x.push_back(path.x[i]);
  return half;
}

const Quantity* find(const std::vector<Quantity>& all, const std::string& name) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.name == name; });
  return at == all.end() ? nullptr : &*at;
}

namespace {

constexpr double fast = 0.5, slowest = 20;  // s

std::vector<Method> engines() {
  std::vector<Method> methods;
  for (Method& method : all_methods())
    if (selected_by_default(method.name)) methods.push_back(std::move(method));
  return methods;
}

double seconds(const Case& q) {
  Run run = default_run(q.scene);
  run.duration = q.scene.window, run.samples = 1;
  return estimated_seconds(q.method, q.scene, run) + q.method.family().start;
}

}  // namespace

bool selected_by_default(const std::string& method) { return family_of(method).is_engine(); }

bool passes(const std::string& filter, const std::string& scene, const std::string& method) {
  return filter.empty() || glob_matches(filter, scene) || glob_matches(filter, scene + "/" + method);
}

std::vector<Case> cases(const Selection& selection) {
  std::vector<Case> all;
  bool any = false;
  const auto add = [&](Case q) {
    if (!passes(selection.filter, q.scene.name, q.method.name)) return;
    any = true;
    const double cost = seconds(q);
    q.slow = cost > fast;
    if (cost <= (selection.full ? slowest : fast)) all.push_back(std::move(q));
  };
  const std::vector<Method> methods = selection.methods.empty() ? engines() : selection.methods;
  for (const Scene& scene : load_scenes(selection.scenes, selection.methods.empty() ? "" : selection.methods[0].name)) {
    const std::string own = find_method(scene.method).name;
    for (const Method& method : methods) {
      add({scene, method, "", false, scene.hash});
      if (method.name != own && selection.methods.empty()) continue;
      for (const Ingredient& ingredient : ingredients_of(scene))
        if (ingredient.name != "rotation")  // rotation is the only term of a first-order scene and must stay
          add({without(scene, ingredient), method, ingredient.name, false, scene.hash});
    }
  }
  if (!any) throw InputError(fmt::format("--filter {}: no scene and method match", selection.filter));
  return all;
}

}  // namespace crosscheck
