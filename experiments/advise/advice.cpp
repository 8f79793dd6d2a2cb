#include "experiments/advise/advice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/adequacy/ablation.h"
#include "experiments/metrics.h"
#include "mysim/base/errors.h"
#include "mysim/model/system.h"
#include "mysim/run/contacts.h"
#include "mysim/scene/toml.h"

namespace crosscheck {

namespace {

/// Value of `time.tolerance` (m) in the advised file for a relative tolerance. It is rounded to 20 bits, so that a run
/// of the file has exactly the tolerance of the trial.
double written_tolerance(const Scene& scene, double relative) {
  int exponent = 0;
  const double part = std::frexp(100 * relative * scene.size(), &exponent);
  return std::ldexp(std::round(std::ldexp(part, 20)), exponent - 20);
}

struct Candidate {
  std::string name;  // "full", or "without ..."
  Scene scene;
  std::vector<Ingredient> out;
};

/// The smallest model that a scene file can express and whose error is at most half the tolerance.
std::optional<Candidate> least_of(const Scene& scene, double tolerance) {
  try {
    const ReferenceSolution y = reference_solution_of(scene, tolerance);
    Candidate least{"full", scene, {}};
    for (bool more = true; more;) {
      more = false;
      std::optional<Ingredient> best;
      double of_best = tolerance / 2;
      for (const Ingredient& i : ingredients_of(least.scene)) {
        if (i.keys.empty()) continue;
        Outcome out;
        const auto error = model_error(without(least.scene, i), y, y.truth.trajectory, out);
        if (error && *error <= of_best) best = i, of_best = *error;
      }
      if (!best) break;
      least.scene = without(least.scene, *best);
      least.out.push_back(*best);
      more = true;
    }
    if (least.out.empty()) return std::nullopt;
    std::vector<std::string> names;
    for (const Ingredient& i : least.out) names.push_back(i.name);
    least.name = fmt::format("without {}", fmt::join(names, ", "));
    return least;
  } catch (const Unsupported&) {
    return std::nullopt;  // no step is fine enough for the reference solution
  }
}

std::string file_of(const Advice& a, const Candidate& model, const Trial& chosen, const Method& method) {
  TomlDocument file(a.scene.source, a.scene.name);
  for (const Ingredient& i : model.out)
    for (const std::string& key : i.keys) file.erase(key);
  if (!chosen.method.starts_with(program_prefix)) file.set("time.method", chosen.method);
  if (method.adaptive)
    file.set("time.tolerance", written_tolerance(model.scene, chosen.relative));
  else
    file.set("time.step", chosen.step), file.set("time.tolerance", a.tolerance);
  return fmt::format(
      "# Advised by crosscheck: cheapest run of {} within {:.6g} m of the reference solution until {:.6g} s.\n{}",
      a.scene.name, a.tolerance, a.until, file.text());
}

void caveats_of(Advice& a, const Trial& t) {
  if (t.method.starts_with(program_prefix))
    a.caveats.push_back(fmt::format("a scene file cannot name a program: run it with --method {}", t.method));
  if (a.under_contact_rule)
    a.caveats.push_back("with contact this is a difference from the limit of mysim's contact rule, not an error");
  if (a.until < a.scene.duration * (1 - 1e-9))
    a.caveats.push_back(
        fmt::format("the guarantee ends at {:.3g} s of {:.3g} s: single positions are not predictable after that",
                    a.until, a.scene.duration));
  if (t.limit && t.step > *t.limit)
    a.caveats.push_back(
        fmt::format("the step is above the predicted stability limit of {:.3g} s: it holds for this "
                    "run, but may fail in a longer one",
                    *t.limit));
  if (!t.outcome.different_law.empty())
    a.caveats.push_back(
        fmt::format("the method follows a different law: {}", fmt::join(t.outcome.different_law, "; ")));
}

/// The advice before any trials. Throws CannotGuarantee if the reference solution does not permit advice.
Advice guarantee_of(const Scene& scene, double tolerance, const DenseTruth& path) {
  const Truth& truth = path.truth();
  Advice a{.scene = scene,
           .tolerance = tolerance,
           .tier = truth.tier,
           .truth = truth.how,
           .error_bar = path.error_bar(),
           .under_contact_rule = truth.under_contact_rule,
           .until = path.until()};
  // requires an error bar of at most a third of the tolerance, which leaves two thirds to the run's own error
  if (!(a.error_bar <= tolerance / 3))
    throw CannotGuarantee(fmt::format(
        "the reference solution is known to {:.2g} m only, but {:.2g} m is requested; request {:.2g} m or more",
        a.error_bar, tolerance, 3 * a.error_bar));
  if (tolerance >= path.motion())
    throw CannotGuarantee(
        fmt::format("nothing in the scene moves by more than {:.3g} m (RMS), but {:.3g} m is requested: any "
                    "model would meet that",
                    path.motion(), tolerance));
  return a;
}

/// Runs a method, and returns the outcome and the distance from the reference solution (m).
using Measured = std::function<std::pair<Outcome, double>(const Method&, const Scene&, const Setting&)>;

Measured at_samples(const Truth& truth, double until) {
  return [&truth, until](const Method& method, const Scene& scene, const Setting& setting) {
    Recorder recorder;
    Run run = setting.applied_to(default_run(scene));
    Outcome out = run_method(method, scene, run, {&recorder});
    return std::pair(std::move(out), distance_over_time(recorder.trajectory, truth.trajectory, until).largest);
  };
}

Measured after_steps(const DenseTruth& path) {
  return [&path](const Method& method, const Scene& scene, const Setting& setting) {
    MaxErrorObserver farthest(path);
    Outcome out = run_method(method, scene, setting.applied_to(observed_run(method, scene, path)), {&farthest});
    return std::pair(std::move(out), farthest.distance());
  };
}

/// Tries all methods on all models, and chooses. Throws CannotGuarantee if none meets the tolerance.
void search(Advice& a, const std::vector<Candidate>& models, const std::vector<Method>& methods, double bound,
            const Measured& measured) {
  a.trials.clear();
  std::vector<TriedRun> runs;
  for (const Candidate& model : models) {
    const long springs = springs_of(model.scene.model);
    const auto trial = [&](const Method& method, const Setting& setting) -> std::optional<TriedRun> {
      auto [out, distance] = measured(method, model.scene, setting);
      const double limit = stability_limit(method, model.scene);
      Trial t{model.name,
              method.name,
              out.step > 0 ? out.step : setting.value,
              setting.tolerance ? setting.value : 0,
              {},
              {},
              springs,
              method.adaptive || !std::isfinite(limit) ? std::nullopt : std::optional(limit)};
      if (out.verdict == Verdict::ok) t.error = distance;
      t.outcome = std::move(out);
      a.trials.push_back(std::move(t));
      const Trial& done = a.trials.back();
      return TriedRun{.verdict = done.outcome.verdict, .error = done.error, .cost = done.cost()};
    };
    StepSearch search(model.scene, default_run(model.scene), bound, trial, runs, 4,
                      model.name);  // abandons a method at four times the best cost
    search.search(methods);
  }
  for (size_t i = 0; i < runs.size(); ++i) {
    Trial& t = a.trials[i];
    t.meets = runs[i].is_within(bound);
    t.accidental = t.meets && std::ranges::any_of(runs, [&](const TriedRun& other) {
                     return other.method == runs[i].method && other.model == runs[i].model &&
                            other.setting.value < runs[i].setting.value * (1 - 1e-9) && !other.is_within(bound);
                   });
    t.meets &= !t.accidental;
  }
  const auto chosen = recommend(runs, bound);
  if (!chosen) throw CannotGuarantee(fmt::format("none of the methods tried comes within {:.2g} m", a.tolerance));
  a.chosen = chosen->run, a.tied = chosen->tied, a.second = chosen->second, a.bound = chosen->bound;
  a.of_full.reset();
  if (a.trials[a.chosen].model == "full") return;
  std::erase_if(runs, [](const TriedRun& run) { return run.model != "full"; });  // these trials are the last ones
  if (const auto full = recommend(runs, bound)) a.of_full = a.trials.size() - runs.size() + full->run;
}

/// Writes the chosen run's scene and runs it. Returns false if the error after any step exceeds the tolerance.
bool written_and_checked(Advice& a, const std::vector<Candidate>& models, const DenseTruth& path) {
  const Trial& chosen = a.trials[a.chosen];
  const Candidate& model = *std::ranges::find(models, chosen.model, &Candidate::name);
  const Method method = find_method(chosen.method);
  a.left_out.clear();
  for (const Ingredient& i : model.out) a.left_out.push_back(i.name);
  a.toml = file_of(a, model, chosen, method);
  Scene written = parse_scene(a.toml, a.scene.name);
  a.wishes = keep_wishes(a.scene, written);
  Trial last = chosen;
  if (written.step < chosen.step && !method.adaptive) {
    last.step = written.step;
    a.toml = file_of(a, model, last, method);
    written = parse_scene(a.toml, a.scene.name);
    a.caveats.push_back("the step is shorter than the tolerance requires, in order to meet the wishes");
  }
  MaxErrorObserver farthest(path);
  last.outcome = run_method(method, written, observed_run(method, written, path), {&farthest});
  a.checked = farthest.distance();
  if (method.adaptive) last.relative = default_run(written).tolerance;
  last.error = a.checked;
  const bool kept = last.outcome.verdict == Verdict::ok && a.checked + a.error_bar <= a.tolerance;
  a.trials[a.chosen] = std::move(last);
  return kept;
}

}  // namespace

Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods) {
  const DenseTruth path(scene, tolerance);
  Advice a = guarantee_of(scene, tolerance, path);
  std::vector<Candidate> models{{"full", scene, {}}};
  if (auto least = least_of(path.dense(), tolerance)) {
    least->scene.samples = scene.samples;  // the trials use the same samples as a run of the written file
    models.insert(models.begin(), std::move(*least));
  }
  // a truth sampled at the scene's own interval has a larger error bar than the densely sampled truth
  const auto sampled = truth_of(scene, default_run(scene));
  bool kept = false;
  if (sampled && sampled->error_bar < tolerance) try {
      search(a, models, methods, tolerance - sampled->error_bar,
             at_samples(*sampled, std::min(scene.window, sampled->until)));
      kept = written_and_checked(a, models, path);
    } catch (const CannotGuarantee&) {
    }
  if (!kept) {
    a.between_samples = true, a.caveats.clear();
    search(a, models, methods, tolerance - a.error_bar, after_steps(path));
    if (!written_and_checked(a, models, path))
      throw CannotGuarantee(fmt::format("the advised file has an error of {:.3g} m when it is run again", a.checked));
  }
  caveats_of(a, a.trials[a.chosen]);
  return a;
}

}  // namespace crosscheck
