// The table of methods, and how a name with options is read.
#include "reference/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "mysim/engine.h"
#include "mysim/errors.h"
#include "mysim/observers/watch.h"
#include "reference/bullet/worlds.h"
#include "reference/independent/integrators.h"
#include "reference/truth.h"

namespace crosscheck {
namespace {

/// An option behind a plus: "sticky" or "n=10".
struct Option {
  std::string key, value;
};

[[noreturn]] void refuse(const std::string& method, const Option& option, const std::string& known) {
  throw InputError(fmt::format("method {}: unknown option '+{}{}{}'; expected {}", method, option.key,
                               option.value.empty() ? "" : "=", option.value, known));
}

Method mysim_method(const Stepper& stepper, const std::vector<Option>& options) {
  ContactRule contact = ContactRule::coulomb;
  Stepper rule = stepper;
  const std::string name = fmt::format("mysim/{}", stepper.name);
  for (const Option& o : options) {
    if (o.key == "sticky" && o.value.empty())
      contact = ContactRule::sticky;
    else if (o.key == "linear" && o.value.empty() && stepper.linear)
      rule.step = stepper.linear;
    else
      refuse(name, o, stepper.linear ? "+linear, +sticky or none" : "+sticky or none");
  }
  return {name,
          fmt::format("{} (order {}{}; {})", stepper.what, stepper.order, stepper.symplectic ? ", symplectic" : "",
                      stepper.limit_formula),
          std::string(stepper.name),
          [rule, contact](const Scene& scene, const Run& run, Observer& observer) {
            Outcome out = simulate(rule, contact, scene, run, observer);
            if (contact == ContactRule::sticky && scene.model.find<Spheres>())
              out.different_law.push_back(
                  "contact: a touching particle is put back to where it came from and loses all its velocity");
            return out;
          },
          ContactLoss::reported,
          &stepper,
          stepper.adaptive};
}

Method deformable_explicit(const std::vector<Option>& options) {
  const std::string name = "bullet/deformable-explicit";
  if (!options.empty()) refuse(name, options[0], "none");
  return {name, "Bullet's deformable world, explicit: springs in N/m, Coulomb friction", "symplectic-euler",
          bullet::run_deformable_explicit, ContactLoss::inferred};
}

Method pbd(const std::vector<Option>& options) {
  const std::string name = "bullet/pbd";
  int n = 1;
  for (const Option& o : options) {
    const auto [end, error] = std::from_chars(o.value.data(), o.value.data() + o.value.size(), n);
    if (o.key != "n" || error != std::errc() || end != o.value.data() + o.value.size() || n < 1 || n > 1000)
      refuse(name, o, "+n=1 to +n=1000 (iterations)");
  }
  return {
      name, "Bullet's position-based world, stiffness mapped per link; different link and friction laws", "",
      [n](const Scene& scene, const Run& run, Observer& observer) { return bullet::run_pbd(scene, run, observer, n); },
      ContactLoss::inferred};
}

/// The best answer known, played through the observer like any other method.
Method truth_method(Tier tier, const std::vector<Option>& options) {
  const std::string name = fmt::format("truth/{}", name_of(tier));
  if (!options.empty()) refuse(name, options[0], "none");
  return {name,
          tier == Tier::exact ? "closed form, where the scene has one"
                              : "two independent routes, refined until they tell the error bar",
          "",
          [tier](const Scene& scene, const Run& run, Observer& observer) {
            const auto truth = truth_of(scene, run);
            if (!truth || truth->tier != tier || truth->of_contact_rule)
              throw Unsupported(tier == Tier::exact
                                    ? "the scene has no closed form"
                                    : "the scene has a closed form, or contacts on whose rule the answer depends");
            Outcome out;
            out.step = plan(run).h;
            for (int i = 0; i < truth->trajectory.frames() && out.verdict == Verdict::ok; ++i) {
              out.end = truth->trajectory.t[i];
              out.verdict = observer.observe({out.end, truth->trajectory.x[i], truth->trajectory.v[i]}, true);
            }
            return out;
          },
          ContactLoss::inferred};
}

/// An integrator that is no engine: it solves the scene's equations, written apart, by somebody else's code.
Method integrator(const std::string& name, const std::string& what, const std::string& rule, Engine engine,
                  bool adaptive, const std::vector<Option>& options) {
  if (!options.empty()) refuse(name, options[0], "none");
  return {name, what, rule, std::move(engine), ContactLoss::inferred, nullptr, adaptive};
}

// the table: a name, and how its method is made from the options
struct Row {
  std::string name;
  std::function<Method(const std::vector<Option>&)> make;
};

std::vector<Row> table() {
  std::vector<Row> rows;
  for (const Stepper& stepper : steppers())
    rows.push_back({fmt::format("mysim/{}", stepper.name),
                    [&stepper](const auto& options) { return mysim_method(stepper, options); }});
  rows.push_back({"bullet/deformable-explicit", deformable_explicit});
  rows.push_back({"bullet/pbd", pbd});
  auto add = [&](const char* name, const char* what, const char* rule, Engine engine, bool adaptive) {
    rows.push_back(
        {name, [=](const auto& options) { return integrator(name, what, rule, engine, adaptive, options); }});
  };
  add("odeint/rk4", "Boost's odeint, classic Runge-Kutta, on a right-hand side written apart", "rk4", run_odeint_rk4,
      false);
  add("odeint/dopri5", "Boost's odeint, Dormand-Prince 5(4) with error control, on the same: give --tol, not --step",
      "", run_odeint_dopri5, true);
  add("sundials/arkode", "SUNDIALS ARKODE, Fehlberg 7(8) with error control, on the same: give --tol, not --step", "",
      run_arkode, true);
  rows.push_back({"truth/exact", [](const auto& options) { return truth_method(Tier::exact, options); }});
  rows.push_back({"truth/converged", [](const auto& options) { return truth_method(Tier::converged, options); }});
  return rows;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(at, begin)) != std::string::npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

}  // namespace

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const Row& row : table()) methods.push_back(row.make({}));
  return methods;
}

Method find_method(const std::string& text) {
  const std::vector<std::string> parts = split(text, '+');
  const std::string name = parts[0].find('/') == std::string::npos ? "mysim/" + parts[0] : parts[0];
  std::vector<Option> options;
  for (size_t i = 1; i < parts.size(); ++i) {
    const size_t equals = parts[i].find('=');
    options.push_back({parts[i].substr(0, equals), equals == std::string::npos ? "" : parts[i].substr(equals + 1)});
  }
  std::vector<std::string> known;
  for (const Row& row : table()) {
    if (row.name == name) {
      Method method = row.make(options);
      for (size_t i = 1; i < parts.size(); ++i) method.name += "+" + parts[i];
      if (!options.empty()) method.rule.clear();
      return method;
    }
    known.push_back(row.name);
  }
  throw InputError(fmt::format("unknown method '{}'; expected one of: {}", text, fmt::join(known, ", ")));
}

std::vector<Method> find_methods(const std::string& list) {
  std::vector<Method> methods;
  for (const std::string& name : split(list, ',')) methods.push_back(find_method(name));
  return methods;
}

Outcome run_method(const Method& method, const Scene& scene, const Run& run, std::vector<Observer*> observers) {
  Watch watch(scene.model);
  observers.push_back(&watch);
  Observers all(std::move(observers));
  try {
    return method.engine(scene, run, all);
  } catch (const Unsupported& refusal) {
    Outcome out;
    out.verdict = Verdict::unsupported;
    out.reason = refusal.what();
    return out;
  }
}

}  // namespace crosscheck
