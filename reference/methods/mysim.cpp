#include <fmt/format.h>

#include <charconv>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "mysim/run/contacts.h"
#include "mysim/run/engine.h"
#include "reference/method.h"

namespace crosscheck {
namespace {

/// N in "threads=N", 1 to 256.
std::optional<int> threads_in(const std::string& option) {
  constexpr std::string_view key = "threads=";
  if (!option.starts_with(key)) return std::nullopt;
  int n = 0;
  const char *begin = option.data() + key.size(), *end = option.data() + option.size();
  const auto [rest, error] = std::from_chars(begin, end, n);
  if (error != std::errc() || rest != end || n < 1 || n > 256) return std::nullopt;
  return n;
}

Method mysim_method(const Stepper& stepper, const MethodOptions& options) {
  ContactRule contact = ContactRule::coulomb;
  Execution execution;
  Stepper rule = stepper;
  std::string same_as(stepper.name);  // without +sticky, which each run reports as a different law
  const std::string name = fmt::format("mysim/{}", stepper.name);
  std::string path_option;  // the option that selected the path
  const auto choose = [&](const std::string& option, ExecutionPath path) {
    if (!path_option.empty() && path_option != option)
      throw InputError(fmt::format("method {}: +{} and +{} each choose how a step is computed; expected one of them",
                                   name, path_option, option));
    path_option = option;
    execution.path = path;
  };
  for (const std::string& option : options) {
    const auto asked = contact_rule_of_option(option);
    if (asked == ContactRule::events && !locates_events(stepper))
      throw InputError(fmt::format(
          "method {}: expected +events with leapfrog or implicit-midpoint only; it needs a rule of order 2 that "
          "evaluates its forces at one place in each step",
          name));
    if (asked)
      contact = *asked;
    else if (option == "linear" && stepper.linear)
      rule.step = stepper.linear, same_as += "+linear";
    else if (option == "plain" && stepper.composition)
      choose(option, ExecutionPath::general);
    else if (option == "fast" && stepper.composition)
      choose(option, ExecutionPath::fastest);
    else if (option == "single" && stepper.composition)
      choose(option, ExecutionPath::single_precision);
    else if (const auto threads = threads_in(option); threads && stepper.composition)
      execution.threads = *threads;
    else
      refuse_option(name, option,
                    fmt::format("{}+sticky{} or none",
                                stepper.linear            ? "+linear, "
                                : locates_events(stepper) ? "+events, "
                                                          : "",
                                stepper.composition ? ", +fast, +single, +plain, +threads=N" : ""));
  }
  if (contact == ContactRule::events) {
    same_as += "+events";  // with contact, the rules with and without events differ by more than round-off
    if (execution.path == ExecutionPath::single_precision)
      throw InputError(fmt::format("method {}: +events requires double precision; expected no +single", name));
  }
  Method method{name,
                fmt::format("{} (order {}{}; {})", stepper.what, stepper.order,
                            stepper.symplectic ? ", symplectic" : "", stepper.limit_formula),
                same_as,
                [rule, contact, execution](const Scene& scene, const Run& run, Observer& observer) {
                  Outcome out = simulate(rule, contact, scene, run, observer, execution);
                  if (contact == ContactRule::sticky && has_contact(scene.model))
                    out.different_law.push_back(
                        "contact: a touching particle returns to its previous position and loses all its velocity");
                  return out;
                },
                ContactLoss::reported,
                &stepper,
                stepper.adaptive,
                stepper.evaluations == 0,
                stepper.hard_constraints,
                false,
                false,
                stepper.hard_constraints || rule.step == stepper.linear ? "implicit-euler" : ""};
  method.sticky_contact = contact == ContactRule::sticky;
  return method;
}

}  // namespace

std::vector<MethodRow> mysim_methods() {
  std::vector<MethodRow> rows;
  for (const Stepper& stepper : steppers())
    rows.push_back({fmt::format("mysim/{}", stepper.name),
                    [&stepper](const auto& options) { return mysim_method(stepper, options); }});
  return rows;
}

}  // namespace crosscheck
