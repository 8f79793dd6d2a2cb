// Bisection over steps and tolerances for each model and method; the cheapest sound one, its file, its check.
#include "experiments/advise/advice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/adequacy/ablation.h"
#include "experiments/metrics.h"
#include "experiments/stability/limit.h"
#include "mysim/base/errors.h"
#include "mysim/model/system.h"
#include "mysim/run/contacts.h"
#include "mysim/scene/toml.h"

namespace crosscheck {

namespace {

/// The key time.tolerance (m) of a file for a relative tolerance, in 20 bits: a run of the file has a trial's, bit for
/// bit.
double written_tolerance(const Scene& scene, double relative) {
  int exponent = 0;
  const double part = std::frexp(100 * relative * scene.size(), &exponent);
  return std::ldexp(std::round(std::ldexp(part, 20)), exponent - 20);
}

}  // namespace

void Search::try_all(const Candidate& model, const Method& method) {
  model_ = &model;
  method_ = &method;
  limit_.reset();
  if (const Stepper* rule = stepper_of(method); rule && !method.adaptive && !model.scene.model.first_order()) {
    const double omega = highest_frequency(model.scene.model, model.scene.start);
    const double gamma = uniform_drag_rate(model.scene.model).value_or(0);
    if (const double limit = rule->limit(omega, gamma); std::isfinite(limit)) limit_ = limit;
  }
  method.adaptive ? search_tolerances() : search_steps();
}

const Trial& Search::run(const Run& run) {
  for (const Trial& t : advice_.trials)  // done before
    if (t.model == model_->name && t.method == method_->name &&
        (method_->adaptive ? t.relative == run.tolerance : std::abs(t.step - run.step) < 1e-9 * run.step))
      return t;
  MaxErrorObserver farthest(path_);
  Trial t{model_->name, method_->name, 0, 0, {}, {}, springs_of(model_->scene.model), limit_};
  t.outcome = run_method(*method_, model_->scene, run, {&farthest});
  t.step = t.outcome.step > 0 ? t.outcome.step : run.step;
  if (method_->adaptive) t.relative = run.tolerance;
  if (t.outcome.verdict == Verdict::ok) {
    t.error = farthest.distance();
    t.meets = *t.error + advice_.error_bar <= advice_.tolerance;
  }
  advice_.trials.push_back(std::move(t));
  return advice_.trials.back();
}
const Trial& Search::trial_at(long steps) {
  Run r = default_run(model_->scene);
  r.step = r.duration / r.samples / static_cast<double>(steps);
  return run(r);
}
const Trial& Search::trial_at_tolerance(double relative) {
  Run r = observed_run(*method_, model_->scene, path_);
  r.tolerance = 0.01 * written_tolerance(model_->scene, relative) / model_->scene.size();  // as default_run reads it
  return run(r);
}
/// 1e9 spring evaluations take some seconds; a run that doubles them again and again would never end.
bool Search::hopeless(const Trial& t) const {
  return t.outcome.verdict == Verdict::unsupported || t.cost() > cost_limit();
}
/// The least cost of so many steps between two samples, without a run.
bool Search::too_costly(long steps) const {
  const int evaluations = method_->stepper ? std::max(1, method_->stepper->evaluations) : 1;
  return static_cast<double>(steps) * advice_.scene.samples * evaluations *
             static_cast<double>(springs_of(model_->scene.model)) >
         cost_limit();
}

void Search::search_steps() {
  const double interval = advice_.scene.duration / advice_.scene.samples;
  // from twice the stable step on
  long meets = 1, fails = 0;
  if (limit_ && *limit_ > 0) meets = std::max(1l, static_cast<long>(interval / *limit_ / 2));
  constexpr long most = 1l << 22;  // where a run fails at once, however short its steps
  double cost = 0;
  for (bool confirmed = false; !confirmed;) {
    if (too_costly(meets)) return;
    const Trial& t = trial_at(meets);
    if (t.meets) {
      cost = t.cost();
      // a smaller step must do as well: an accidental success is none
      const bool accidental = !trial_at(2 * meets).meets;
      if (!accidental) confirmed = true;
      if (accidental) fails = meets, meets *= 4;
    } else {
      if (hopeless(t) || meets >= most) return;
      fails = meets, meets *= 2;
    }
  }
  while (fails == 0 && meets > 1) {
    const Trial& t = trial_at(meets / 2);
    if (t.meets)
      meets /= 2, cost = t.cost();
    else
      fails = meets / 2;
  }
  while (meets > fails + 1 && static_cast<double>(meets) > 1.05 * static_cast<double>(fails) &&
         may_improve(cost, static_cast<double>(fails) / static_cast<double>(meets))) {
    const long middle = std::clamp(std::lround(std::sqrt(static_cast<double>(meets) * static_cast<double>(fails))),
                                   fails + 1, meets - 1);
    const Trial& t = trial_at(middle);
    (t.meets ? meets : fails) = middle;
    if (t.meets) cost = t.cost();
  }
  record_cost(cost);
}

void Search::search_tolerances() {
  constexpr double loosest = 1e-1, tightest = 1e-13;
  double meets = loosest, fails = 0, cost = 0;
  for (bool confirmed = false; !confirmed;) {
    const Trial& t = trial_at_tolerance(meets);
    if (t.meets) {
      cost = t.cost();
      confirmed = trial_at_tolerance(meets / 4).meets;
      if (!confirmed) fails = meets, meets /= 16;
    } else {
      if (hopeless(t)) return;
      fails = meets, meets /= 4;
    }
    if (meets < tightest) return;
  }
  // the cost of a fifth-order rule goes as the fifth root of its tolerance
  while (fails > 0 && fails / meets > 1.28 && may_improve(cost, std::pow(meets / fails, 0.2))) {
    const double middle = std::sqrt(meets * fails);
    const Trial& t = trial_at_tolerance(middle);
    (t.meets ? meets : fails) = middle;
    if (t.meets) cost = t.cost();
  }
  record_cost(cost);
}

// Advice: the search over all models and methods, the cheapest confirmed trial, its scene file, and the check of that.

namespace {

/// Rules of high order first: they set the cost at which the others are given up.
int search_order(const Method& m) {
  if (!m.stepper) return 20;
  return (m.stepper->evaluations == 0 ? 10 : 0) - m.stepper->order;
}

/// The least model that a scene file can express and that leaves half of the tolerance.
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
    return std::nullopt;  // no step of the reference solution is fine enough for a model's error
  }
}

/// The scene's file with what was chosen.
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
      "# Advised by crosscheck: the cheapest run of {} that stays within {:.6g} m of its truth until {:.6g} s.\n{}",
      a.scene.name, a.tolerance, a.until, file.text());
}

void caveats_of(Advice& a, const Trial& t) {
  if (t.method.starts_with(program_prefix))
    a.caveats.push_back(fmt::format("a scene file cannot name a program: run it with --method {}", t.method));
  if (a.under_contact_rule)
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

/// The advice without its trials; throws CannotGuarantee where the truth allows none.
Advice guarantee_of(const Scene& scene, double tolerance, const DenseTruth& path) {
  const Truth& truth = path.truth();
  Advice a{
      scene, tolerance, truth.tier, truth.how, path.error_bar(), truth.under_contact_rule, path.until(), {}, 0, {}, {},
      "",    0,         {},         {}};
  // a third: what is left for the run's own error is then at least twice the bar
  if (!(a.error_bar <= tolerance / 3))
    throw CannotGuarantee(
        fmt::format("the truth is known to {:.2g} m only, and {:.2g} m is asked: ask for {:.2g} m or more", a.error_bar,
                    tolerance, 3 * a.error_bar));
  if (tolerance >= path.motion())
    throw CannotGuarantee(
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

/// Marks trials that a finer one does not confirm.
void mark_accidental(std::vector<Trial>& trials) {
  for (Trial& t : trials)
    for (const Trial& o : trials) t.accidental |= t.meets && !o.meets && !o.accidental && finer(o, t);
  for (Trial& t : trials) t.meets &= !t.accidental;
}

/// Whether the tolerance is met by the trial and by all finer ones, of which there is one at least.
bool is_confirmed(const std::vector<Trial>& trials, const Trial& t) {
  bool confirmed = false;
  for (const Trial& o : trials)
    if (finer(o, t)) {
      if (!o.meets) return false;
      confirmed = true;
    }
  return t.meets && confirmed;
}

/// The cheapest confirmed trial, of another method than that where one is given.
std::optional<size_t> cheapest(const std::vector<Trial>& trials, const std::string& but = "") {
  std::optional<size_t> best;
  for (size_t i = 0; i < trials.size(); ++i)
    if (trials[i].method != but && is_confirmed(trials, trials[i]) &&
        (!best || trials[i].cost() < trials[*best].cost()))
      best = i;
  return best;
}

}  // namespace

std::vector<Method> advisable_methods(const Scene& scene) {
  std::vector<Method> methods;
  for (Method& m : all_methods()) {
    if (!m.family().is_subject()) continue;
    if (scene.model.find<Spheres>() && m.stepper && locates_events(*m.stepper))
      methods.push_back(find_method(m.name + "+events"));
    methods.push_back(std::move(m));
  }
  return methods;
}

Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods) {
  const DenseTruth path(scene, tolerance);
  Advice a = guarantee_of(scene, tolerance, path);

  std::vector<Candidate> models{{"full", scene, {}}};
  if (auto least = least_of(path.dense(), tolerance)) {
    least->scene.samples = scene.samples;  // what is tried is run as its file will be
    models.insert(models.begin(), std::move(*least));
  }
  std::stable_sort(methods.begin(), methods.end(),
                   [](const Method& x, const Method& y) { return search_order(x) < search_order(y); });
  Search search(a, path);
  for (const Candidate& model : models)
    for (const Method& method : methods) search.try_all(model, method);

  mark_accidental(a.trials);
  const auto best = cheapest(a.trials);
  if (!best) throw CannotGuarantee(fmt::format("no method that was tried comes within {:.2g} m", tolerance));
  a.chosen = *best;
  const Trial& chosen = a.trials[a.chosen];
  a.second = cheapest(a.trials, chosen.method);

  const Candidate& model =
      *std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.name == chosen.model; });
  const Method method = find_method(chosen.method);
  for (const Ingredient& i : model.out) a.left_out.push_back(i.name);
  a.toml = file_of(a, model, chosen, method);
  Scene written = parse_scene(a.toml, scene.name);
  a.wishes = keep_wishes(scene, written);
  Trial last = chosen;
  if (written.step < chosen.step && !method.adaptive) {
    last.step = written.step;
    a.toml = file_of(a, model, last, method);
    written = parse_scene(a.toml, scene.name);
    a.caveats.push_back("the step is shorter than the tolerance needs: it keeps the wishes");
  }
  // the very file, by the run that `crosscheck run` makes
  MaxErrorObserver farthest(path);
  last.outcome = run_method(method, written, observed_run(method, written, path), {&farthest});
  a.checked = farthest.distance();
  if (last.outcome.verdict != Verdict::ok || !(a.checked + a.error_bar <= tolerance))
    throw CannotGuarantee(fmt::format("the advised file, run again, errs by {:.3g} m", a.checked));
  last.error = a.checked;
  a.trials[a.chosen] = std::move(last);
  caveats_of(a, a.trials[a.chosen]);
  return a;
}

}  // namespace crosscheck
