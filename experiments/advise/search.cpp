// The search: longest steps first, halved until they meet the tolerance, then refined.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/adequacy/ladder.h"
#include "experiments/advise/advice.h"
#include "experiments/metrics.h"
#include "experiments/stability/limit.h"
#include "mysim/errors.h"
#include "mysim/frequency.h"

namespace crosscheck {
namespace {

struct Candidate {
  std::string name;
  Scene scene;
  std::vector<Ingredient> out;
};

class Search {
 public:
  Search(Advice& advice, const Truth& truth) : advice_(advice), truth_(truth) {}

  void over(const Candidate& model, const Method& method) {
    model_ = &model;
    method_ = &method;
    limit_.reset();
    if (const Stepper* rule = rule_of(method); rule && !method.adaptive && !model.scene.model.first_order()) {
      const double omega = fastest_frequency(model.scene.model, model.scene.start);
      const double gamma = uniform_drag_rate(model.scene.model).value_or(0);
      if (const double limit = rule->limit(omega, gamma); std::isfinite(limit)) limit_ = limit;
    }
    method.adaptive ? over_tolerances() : over_steps();
  }

 private:
  /// The run with that many steps between two samples, or with that relative tolerance.
  const Trial& run(const Run& run) {
    for (const Trial& t : advice_.trials)  // done before
      if (t.model == model_->name && t.method == method_->name &&
          (method_->adaptive ? t.relative == run.tolerance : std::abs(t.step - run.step) < 1e-9 * run.step))
        return t;
    Recorder recorder;
    Trial t{model_->name, method_->name, 0, 0, {}, {}, springs_of(model_->scene.model), limit_};
    t.outcome = run_method(*method_, model_->scene, run, {&recorder});
    t.step = t.outcome.step > 0 ? t.outcome.step : run.step;
    if (method_->adaptive) t.relative = run.tolerance;
    if (t.outcome.verdict == Verdict::ok) {
      t.error = largest_rms_distance(recorder.trajectory, truth_.trajectory, advice_.until);
      t.meets = *t.error + advice_.bar <= advice_.tolerance;
    }
    advice_.trials.push_back(std::move(t));
    return advice_.trials.back();
  }
  const Trial& at(long steps) {
    Run r = default_run(model_->scene);
    r.step = r.duration / r.samples / static_cast<double>(steps);
    return run(r);
  }
  const Trial& at_tolerance(double relative) {
    Run r = default_run(model_->scene);
    r.tolerance = relative;
    return run(r);
  }
  /// 1e9 spring evaluations take some seconds; a run that doubles them again and again would never end.
  bool hopeless(const Trial& t) const {
    return t.outcome.verdict == Verdict::unsupported || t.cost() > std::min(4 * best_, 1e9);
  }
  /// What so many steps between two samples cost at least: nothing is run to see that it is too much.
  bool too_dear(long steps) const {
    const int evaluations = method_->stepper ? std::max(1, method_->stepper->evaluations) : 1;
    return static_cast<double>(steps) * advice_.scene.samples * evaluations *
               static_cast<double>(springs_of(model_->scene.model)) >
           std::min(4 * best_, 1e9);
  }
  /// Whether a refinement of a run that meets could still be the cheapest.
  bool worth(double cost, double ratio) const { return cost * ratio < best_; }

  void over_steps() {
    const double interval = advice_.scene.duration / advice_.scene.samples;
    // from twice the stable step on
    long meets = 1, fails = 0;
    if (limit_ && *limit_ > 0) meets = std::max(1l, static_cast<long>(interval / *limit_ / 2));
    constexpr long most = 1l << 22;  // where a run fails at once, however short its steps
    double cost = 0;
    for (bool confirmed = false; !confirmed;) {
      if (too_dear(meets)) return;
      const Trial& t = at(meets);
      if (t.meets) {
        cost = t.cost();
        // a smaller step must do as well: one that is right by luck is none
        const bool luck = !at(2 * meets).meets;
        if (!luck) confirmed = true;
        if (luck) fails = meets, meets *= 4;
      } else {
        if (hopeless(t) || meets >= most) return;
        fails = meets, meets *= 2;
      }
    }
    while (fails == 0 && meets > 1) {
      const Trial& t = at(meets / 2);
      if (t.meets)
        meets /= 2, cost = t.cost();
      else
        fails = meets / 2;
    }
    while (meets > fails + 1 && static_cast<double>(meets) > 1.05 * static_cast<double>(fails) &&
           worth(cost, static_cast<double>(fails) / static_cast<double>(meets))) {
      const long middle = std::clamp(std::lround(std::sqrt(static_cast<double>(meets) * static_cast<double>(fails))),
                                     fails + 1, meets - 1);
      const Trial& t = at(middle);
      (t.meets ? meets : fails) = middle;
      if (t.meets) cost = t.cost();
    }
    keep(cost);
  }

  void over_tolerances() {
    constexpr double loosest = 1e-1, tightest = 1e-13;
    double meets = loosest, fails = 0, cost = 0;
    for (bool confirmed = false; !confirmed;) {
      const Trial& t = at_tolerance(meets);
      if (t.meets) {
        cost = t.cost();
        confirmed = at_tolerance(meets / 4).meets;
        if (!confirmed) fails = meets, meets /= 16;
      } else {
        if (hopeless(t)) return;
        fails = meets, meets /= 4;
      }
      if (meets < tightest) return;
    }
    // the cost of a fifth-order rule goes as the fifth root of its tolerance
    while (fails > 0 && fails / meets > 1.28 && worth(cost, std::pow(meets / fails, 0.2))) {
      const double middle = std::sqrt(meets * fails);
      const Trial& t = at_tolerance(middle);
      (t.meets ? meets : fails) = middle;
      if (t.meets) cost = t.cost();
    }
    keep(cost);
  }

  void keep(double cost) { best_ = std::min(best_, cost); }

  Advice& advice_;
  const Truth& truth_;
  const Candidate* model_ = nullptr;
  const Method* method_ = nullptr;
  std::optional<double> limit_;
  double best_ = INFINITY;
};

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

}  // namespace

Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods) {
  const auto truth = truth_of(scene, default_run(scene));
  if (!truth) throw CannotPromise("no truth is known for the scene: nothing to promise against");
  Advice a{scene,
           tolerance,
           truth->tier,
           truth->how,
           0,
           truth->of_contact_rule,
           std::min({scene.window, scene.duration, truth->until}),
           {},
           0,
           {},
           {},
           "",
           0,
           {}};
  double motion = 0;
  const Trajectory& path = truth->trajectory;
  for (int i = 0; i < path.frames() && path.t[i] <= a.until * (1 + 1e-9); ++i) {
    a.bar = std::max(a.bar, truth->bars.empty() ? truth->bar : truth->bars[i]);
    motion = std::max(motion, rms_distance(path.x[i], path.x[0]));
  }
  // a third: what is left for the run's own error is then at least twice the bar
  if (!(a.bar <= tolerance / 3))
    throw CannotPromise(
        fmt::format("the truth is known to {:.2g} m only, and {:.2g} m is asked: ask for {:.2g} m or more", a.bar,
                    tolerance, 3 * a.bar));
  if (tolerance >= motion)
    throw CannotPromise(
        fmt::format("nothing in the scene moves by more than {:.3g} m (RMS), and {:.3g} m is asked: any "
                    "answer would do",
                    motion, tolerance));

  std::vector<Candidate> models{{"full", scene, {}}};
  if (auto least = least_of(scene, tolerance)) models.insert(models.begin(), std::move(*least));
  std::stable_sort(methods.begin(), methods.end(),
                   [](const Method& x, const Method& y) { return urgency(x) < urgency(y); });
  Search search(a, *truth);
  for (const Candidate& model : models)
    for (const Method& method : methods) search.over(model, method);

  // what a shorter step does not confirm was met by luck
  for (Trial& t : a.trials)
    for (const Trial& o : a.trials)
      t.by_luck |= t.meets && !o.meets && !o.by_luck && o.model == t.model && o.method == t.method &&
                   (t.relative > 0 ? o.relative < t.relative : o.step < t.step * (1 - 1e-9));
  for (Trial& t : a.trials) t.meets &= !t.by_luck;
  // taken: met by it and by all shorter steps (or tighter tolerances) of the same method and model
  const auto sound = [&](const Trial& t) {
    bool shorter = false;
    for (const Trial& o : a.trials) {
      if (o.model != t.model || o.method != t.method) continue;
      const double x = t.relative > 0 ? o.relative : o.step, y = t.relative > 0 ? t.relative : t.step;
      if (x < y * (1 - 1e-9) && !o.meets) return false;
      shorter |= x < y * (1 - 1e-9);
    }
    return t.meets && shorter;
  };
  std::optional<size_t> best;
  for (size_t i = 0; i < a.trials.size(); ++i)
    if (sound(a.trials[i]) && (!best || a.trials[i].cost() < a.trials[*best].cost())) best = i;
  if (!best) throw CannotPromise(fmt::format("no method that was tried comes within {:.2g} m", tolerance));
  a.chosen = *best;
  const Trial& chosen = a.trials[a.chosen];
  for (size_t i = 0; i < a.trials.size(); ++i)
    if (a.trials[i].method != chosen.method && sound(a.trials[i]) &&
        (!a.second || a.trials[i].cost() < a.trials[*a.second].cost()))
      a.second = i;

  const Candidate& model =
      *std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.name == chosen.model; });
  const Method method = find_method(chosen.method);
  for (const Ingredient& i : model.out) a.left_out.push_back(i.name);
  a.toml = file_of(a, model, chosen, method);
  const Scene written = parse_scene(a.toml, scene.name);
  Recorder recorder;
  const Outcome again = run_method(method, written, default_run(written), {&recorder});
  a.checked = largest_rms_distance(recorder.trajectory, path, a.until);
  if (again.verdict != Verdict::ok || !(a.checked + a.bar <= tolerance))
    throw CannotPromise(fmt::format("the advised file, run again, errs by {:.3g} m", a.checked));
  caveats_of(a, chosen);
  return a;
}

}  // namespace crosscheck
