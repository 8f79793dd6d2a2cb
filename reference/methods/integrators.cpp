// Other libraries as integrators of the separately written equations.

#include "reference/truth/independent/integrators.h"
#include "mysim/base/text.h"
#include "reference/method.h"

namespace crosscheck {

namespace {

struct Integrator {
  std::string name, option;  // option: selects the integrator; may be empty
  std::string what, rule;
  Outcome (*run)(const Scene&, const Run&, Observer&);
  bool adaptive, multistep = false;
};

std::vector<Integrator> integrators() {
  return {
      {"odeint/rk4", "", "Boost's odeint, classic Runge-Kutta, with an independently written right-hand side", "rk4",
       run_odeint_rk4, false},
      {"odeint/dopri5", "",
       "Boost's odeint, Dormand-Prince 5(4) with error control, same right-hand side: give --tol, not --step", "",
       run_odeint_dopri5, true},
      {"odeint/dopri5", "events",
       "Boost's odeint, Dormand-Prince 5(4), with contact: restarted where a particle hits, leaves, sticks or slips",
       "", run_event_driven, true},
      {"sundials/arkode", "",
       "SUNDIALS ARKODE, Fehlberg 7(8) with error control, same right-hand side: give --tol, not --step; +order=4: "
       "Zonneveld 4(3)",
       "", run_arkode, true},
      {"sundials/arkode", "order=4", "SUNDIALS ARKODE, Zonneveld 4(3) with error control, same right-hand side", "",
       run_arkode_order4, true},
      {"sundials/cvode", "",
       "SUNDIALS CVODE, Adams' formulas with GMRES and error control, same right-hand side: give --tol, not --step", "",
       run_cvode, true, true}};
}

Method integrator_method(const std::string& name, const MethodOptions& options) {
  std::string known = "none";
  for (const Integrator& i : integrators()) {
    if (i.name != name) continue;
    if (options.empty() ? i.option.empty() : options == MethodOptions{i.option})
      return {.name = i.name,
              .what = i.what,
              .rule = i.rule,
              .engine = i.run,
              .contact = ContactLoss::inferred,
              .adaptive = i.adaptive,
              .multistep = i.multistep};
    if (!i.option.empty()) known = "+" + i.option + " or none";
  }
  refuse_option(name, options.back(), known);
}

std::vector<MethodRow> rows_of(std::string_view family) {
  std::vector<MethodRow> rows;
  for (const Integrator& i : integrators())
    if (i.option.empty() && family_of(i.name).name == family)
      rows.push_back(
          {i.name, [name = i.name](const MethodOptions& options) { return integrator_method(name, options); }});
  return rows;
}

}  // namespace

std::vector<MethodRow> odeint_methods() { return rows_of("odeint"); }
std::vector<MethodRow> sundials_methods() { return rows_of("sundials"); }

}  // namespace crosscheck
