// Advice: models and methods one after another through the search, the cheapest that is met soundly, its file, its
// check.
#include "experiments/advise/advice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/adequacy/ladder.h"
#include "experiments/advise/search.h"
#include "experiments/metrics.h"
#include "mysim/errors.h"

namespace crosscheck {
namespace {

/// Rules of high order first: they set the price that the others are left at.
int urgency(const Method& m) {
  if (!m.stepper) return 20;
  return (m.stepper->evaluations == 0 ? 10 : 0) - m.stepper->order;
}

/// The least model that a file can say and whose own error leaves half of the tolerance.
std::optional<Candidate> least_of(const Scene& scene, double tolerance) {
  try {
    const Yardstick y = yardstick_of(scene, tolerance);
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
    return std::nullopt;  // no step of the yardstick is fine enough to tell a model's error from its own
  }
}

/// The scene's file with what was chosen.
std::string file_of(const Advice& a, const Candidate& model, const Trial& chosen, const Method& method) {
  Document file(a.scene.source, a.scene.name);
  for (const Ingredient& i : model.out)
    for (const std::string& key : i.keys) file.erase(key);
  file.set("time.method", chosen.method);
  if (method.adaptive)
    file.set("time.tolerance", 100 * chosen.relative * model.scene.size());  // as default_run reads it
  else
    file.set("time.step", chosen.step), file.set("time.tolerance", a.tolerance);
  return fmt::format(
      "# Advised by crosscheck: the cheapest run of {} that stays within {:.6g} m of its truth until {:.6g} s.\n{}",
      a.scene.name, a.tolerance, a.until, file.text());
}

void caveats_of(Advice& a, const Trial& t) {
  if (a.of_contact_rule)
    a.caveats.push_back("with contact this is a difference from what the in-house contact rule converges to, no error");
  if (a.until < a.scene.duration * (1 - 1e-9))
    a.caveats.push_back(
        fmt::format("the promise ends at {:.3g} s of {:.3g} s: later single positions are not predictable", a.until,
                    a.scene.duration));
  if (t.limit && t.step > *t.limit)
    a.caveats.push_back(
        fmt::format("the step is above the predicted stability limit of {:.3g} s: it holds for this "
                    "run, and may not for a longer one",
                    *t.limit));
  if (!t.outcome.different_law.empty())
    a.caveats.push_back(fmt::format("the method follows another law: {}", fmt::join(t.outcome.different_law, "; ")));
}

/// What can be promised at all, with the truth's bar in the window; throws CannotPromise where nothing can.
Advice promise_of(const Scene& scene, double tolerance, const TruePath& path) {
  const Truth& truth = path.truth();
  Advice a{scene, tolerance, truth.tier, truth.how, path.bar(), truth.of_contact_rule, path.until(), {}, 0,
           {},    {},        "",         0,         {}};
  // a third: what is left for the run's own error is then at least twice the bar
  if (!(a.bar <= tolerance / 3))
    throw CannotPromise(
        fmt::format("the truth is known to {:.2g} m only, and {:.2g} m is asked: ask for {:.2g} m or more", a.bar,
                    tolerance, 3 * a.bar));
  if (tolerance >= path.motion())
    throw CannotPromise(
        fmt::format("nothing in the scene moves by more than {:.3g} m (RMS), and {:.3g} m is asked: any "
                    "answer would do",
                    path.motion(), tolerance));
  return a;
}

/// Whether a trial takes shorter steps, or a tighter tolerance, than another of the same method and model.
bool finer(const Trial& x, const Trial& y) {
  if (x.model != y.model || x.method != y.method) return false;
  return y.relative > 0 ? x.relative < y.relative : x.step < y.step * (1 - 1e-9);
}

/// What a finer trial does not confirm was met by luck.
void mark_luck(std::vector<Trial>& trials) {
  for (Trial& t : trials)
    for (const Trial& o : trials) t.by_luck |= t.meets && !o.meets && !o.by_luck && finer(o, t);
  for (Trial& t : trials) t.meets &= !t.by_luck;
}

/// Met by it and by all finer trials, of which there is one at least.
bool sound(const std::vector<Trial>& trials, const Trial& t) {
  bool confirmed = false;
  for (const Trial& o : trials)
    if (finer(o, t)) {
      if (!o.meets) return false;
      confirmed = true;
    }
  return t.meets && confirmed;
}

/// The cheapest sound trial, of another method than that where one is given.
std::optional<size_t> cheapest(const std::vector<Trial>& trials, const std::string& but = "") {
  std::optional<size_t> best;
  for (size_t i = 0; i < trials.size(); ++i)
    if (trials[i].method != but && sound(trials, trials[i]) && (!best || trials[i].cost() < trials[*best].cost()))
      best = i;
  return best;
}

}  // namespace

Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods) {
  const TruePath path(scene, tolerance);
  Advice a = promise_of(scene, tolerance, path);

  std::vector<Candidate> models{{"full", scene, {}}};
  if (auto least = least_of(path.dense(), tolerance)) {
    least->scene.samples = scene.samples;  // what is tried is run as its file will be
    models.insert(models.begin(), std::move(*least));
  }
  std::stable_sort(methods.begin(), methods.end(),
                   [](const Method& x, const Method& y) { return urgency(x) < urgency(y); });
  Search search(a, path);
  for (const Candidate& model : models)
    for (const Method& method : methods) search.over(model, method);

  mark_luck(a.trials);
  const auto best = cheapest(a.trials);
  if (!best) throw CannotPromise(fmt::format("no method that was tried comes within {:.2g} m", tolerance));
  a.chosen = *best;
  const Trial& chosen = a.trials[a.chosen];
  a.second = cheapest(a.trials, chosen.method);

  const Candidate& model =
      *std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.name == chosen.model; });
  const Method method = find_method(chosen.method);
  for (const Ingredient& i : model.out) a.left_out.push_back(i.name);
  a.toml = file_of(a, model, chosen, method);
  const Scene written = parse_scene(a.toml, scene.name);
  Farthest farthest(path);
  const Outcome again = run_method(method, written, looked_at(method, written, path), {&farthest});
  a.checked = farthest.distance();
  if (again.verdict != Verdict::ok || !(a.checked + a.bar <= tolerance))
    throw CannotPromise(fmt::format("the advised file, run again, errs by {:.3g} m", a.checked));
  caveats_of(a, chosen);
  return a;
}

}  // namespace crosscheck
