// Integrators that are no engines: they solve the scene's equations, written apart, by somebody else's code.
#include "reference/independent/integrators.h"

#include "reference/methods/families.h"

namespace crosscheck {

std::vector<MethodRow> integrator_methods() {
  struct Integrator {
    const char *name, *what, *rule;
    Outcome (*run)(const Scene&, const Run&, Observer&);
    bool adaptive;
  };
  static constexpr Integrator table[] = {
      {"odeint/rk4", "Boost's odeint, classic Runge-Kutta, on a right-hand side written apart", "rk4", run_odeint_rk4,
       false},
      {"odeint/dopri5", "Boost's odeint, Dormand-Prince 5(4) with error control, on the same: give --tol, not --step",
       "", run_odeint_dopri5, true},
      {"sundials/arkode", "SUNDIALS ARKODE, Fehlberg 7(8) with error control, on the same: give --tol, not --step", "",
       run_arkode, true}};
  std::vector<MethodRow> rows;
  for (const Integrator& i : table)
    rows.push_back({i.name, [&i](const MethodOptions& options) -> Method {
                      if (!options.empty()) refuse_option(i.name, options[0], "none");
                      return {i.name, i.what, i.rule, i.run, ContactLoss::inferred, nullptr, i.adaptive};
                    }});
  return rows;
}

}  // namespace crosscheck
