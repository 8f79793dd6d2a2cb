// mysim's steppers as methods.
#include <fmt/format.h>

#include "mysim/engine.h"
#include "reference/methods/families.h"

namespace crosscheck {
namespace {

Method mysim_method(const Stepper& stepper, const MethodOptions& options) {
  ContactRule contact = ContactRule::coulomb;
  Precision precision = Precision::reproducible;
  Stepper rule = stepper;
  std::string same_as(stepper.name);  // another contact rule changes nothing where nothing touches
  const std::string name = fmt::format("mysim/{}", stepper.name);
  for (const std::string& option : options) {
    if (option == "sticky")
      contact = ContactRule::sticky;
    else if (option == "linear" && stepper.linear)
      rule.step = stepper.linear, same_as += "+linear";
    else if (option == "plain" && stepper.chain)
      precision = Precision::plain;
    else if (option == "fast" && stepper.chain)
      precision = Precision::fastest;
    else if (option == "single" && stepper.chain)
      precision = Precision::single;
    else
      refuse_option(name, option, stepper.linear ? "+linear, +sticky or none" : "+sticky or none");
  }
  return {name,
          fmt::format("{} (order {}{}; {})", stepper.what, stepper.order, stepper.symplectic ? ", symplectic" : "",
                      stepper.limit_formula),
          same_as,
          [rule, contact, precision](const Scene& scene, const Run& run, Observer& observer) {
            Outcome out = simulate(rule, contact, scene, run, observer, precision);
            if (contact == ContactRule::sticky && scene.model.find<Spheres>())
              out.different_law.push_back(
                  "contact: a touching particle is put back to where it came from and loses all its velocity");
            return out;
          },
          ContactLoss::reported,
          &stepper,
          stepper.adaptive};
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
