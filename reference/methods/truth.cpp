// Reference solutions, replayed like any other method.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "reference/method.h"
#include "reference/truth/discrete.h"
#include "reference/truth/truth.h"

namespace crosscheck {
namespace {

Outcome replay(const Truth& truth, const Run& run, Observer& observer) {
  Outcome out;
  out.step = time_grid(run).h;
  for (int i = 0; i < truth.trajectory.frames() && out.verdict == Verdict::ok; ++i) {
    out.end = truth.trajectory.t[i];
    out.verdict = observer.observe({out.end, truth.trajectory.x[i], truth.trajectory.v[i]}, true);
  }
  return out;
}

Method truth_method(Tier tier, const MethodOptions& options) {
  const std::string name = fmt::format("truth/{}", name_of(tier));
  if (!options.empty()) refuse_option(name, options[0], "none");
  return {name,
          tier == Tier::exact ? "closed form, where the scene has one"
                              : "two independent methods, refined; their difference gives the error bar",
          "",
          [tier](const Scene& scene, const Run& run, Observer& observer) {
            const auto truth = truth_of(scene, run);
            if (!truth || truth->tier != tier || truth->under_contact_rule)
              throw Unsupported(tier == Tier::exact
                                    ? "the scene has no closed form"
                                    : "the scene has a closed form, or its solution depends on the contact rule");
            return replay(*truth, run, observer);
          },
          ContactLoss::inferred};
}

MethodOptions names_of_discrete_rules() {
  MethodOptions names;
  for (const DiscreteStepper& rule : discrete_steppers()) names.emplace_back(rule.name);
  return names;
}

/// Closed form of a rule's discrete solution.
Method discrete_method(const MethodOptions& options) {
  const std::string name = "truth/exact-discrete";
  const std::string known = fmt::format("one of the rules +{}", fmt::join(names_of_discrete_rules(), ", +"));
  if (options.empty()) throw InputError(fmt::format("method {}: the rule is missing; expected {}", name, known));
  if (options.size() > 1) refuse_option(name, options[1], known);
  for (const DiscreteStepper& rule : discrete_steppers())
    if (rule.name == options[0])
      return {.name = name,
              .what = fmt::format("closed form of the solution by {}, for linear scenes", rule.name),
              .rule = "",
              .engine = [&rule](const Scene& scene, const Run& run,
                                Observer& observer) { return replay(discrete_truth(rule, scene, run), run, observer); },
              .contact = ContactLoss::inferred,
              .implicit = std::ranges::find(steppers(), rule.name, &Stepper::name)->evaluations == 0};
  refuse_option(name, options[0], known);
}

}  // namespace

std::vector<MethodRow> truth_methods() {
  return {{"truth/exact", [](const auto& options) { return truth_method(Tier::exact, options); }},
          {"truth/exact-discrete", discrete_method, names_of_discrete_rules()},
          {"truth/converged", [](const auto& options) { return truth_method(Tier::converged, options); }}};
}

}  // namespace crosscheck
