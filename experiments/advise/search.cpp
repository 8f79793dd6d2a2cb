#include "experiments/advise/search.h"

#include <algorithm>

#include "experiments/metrics.h"
#include "experiments/stability/limit.h"
#include "mysim/frequency.h"

namespace crosscheck {

void Search::over(const Candidate& model, const Method& method) {
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

const Trial& Search::run(const Run& run) {
  for (const Trial& t : advice_.trials)  // done before
    if (t.model == model_->name && t.method == method_->name &&
        (method_->adaptive ? t.relative == run.tolerance : std::abs(t.step - run.step) < 1e-9 * run.step))
      return t;
  Farthest farthest(path_);
  Trial t{model_->name, method_->name, 0, 0, {}, {}, springs_of(model_->scene.model), limit_};
  t.outcome = run_method(*method_, model_->scene, run, {&farthest});
  t.step = t.outcome.step > 0 ? t.outcome.step : run.step;
  if (method_->adaptive) t.relative = run.tolerance;
  if (t.outcome.verdict == Verdict::ok) {
    t.error = farthest.distance();
    t.meets = *t.error + advice_.bar <= advice_.tolerance;
  }
  advice_.trials.push_back(std::move(t));
  return advice_.trials.back();
}
const Trial& Search::at(long steps) {
  Run r = default_run(model_->scene);
  r.step = r.duration / r.samples / static_cast<double>(steps);
  return run(r);
}
const Trial& Search::at_tolerance(double relative) {
  Run r = looked_at(*method_, model_->scene, path_);
  r.tolerance = relative;
  return run(r);
}
/// 1e9 spring evaluations take some seconds; a run that doubles them again and again would never end.
bool Search::hopeless(const Trial& t) const {
  return t.outcome.verdict == Verdict::unsupported || t.cost() > dearest();
}
/// What so many steps between two samples cost at least: nothing is run to see that it is too much.
bool Search::too_dear(long steps) const {
  const int evaluations = method_->stepper ? std::max(1, method_->stepper->evaluations) : 1;
  return static_cast<double>(steps) * advice_.scene.samples * evaluations *
             static_cast<double>(springs_of(model_->scene.model)) >
         dearest();
}

void Search::over_steps() {
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

void Search::over_tolerances() {
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

}  // namespace crosscheck
