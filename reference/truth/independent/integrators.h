// Integrators of libraries (odeint, SUNDIALS) on a right-hand side written apart from mysim's: methods like any other,
// and one of the two routes to a converged truth.
#pragma once

#include <optional>
#include <string>

#include "mysim/run/run.h"

namespace crosscheck {

// All but the two for contact throw Unsupported where there is contact. Those under error control keep the estimated
// error of each step below R (scene size + |component|), with R = run.tolerance and velocities times a time unit of the
// scene (velocity_time_unit): odeint in every component, SUNDIALS in the root mean square.

/// odeint's classic Runge-Kutta rule at run.step.
Outcome run_odeint_rk4(const Scene& scene, const Run& run, Observer& observer);
/// odeint's Dormand-Prince 5(4) to run.tolerance, with its own interpolant at the observed times.
Outcome run_odeint_dopri5(const Scene& scene, const Run& run, Observer& observer);
/// odeint's Dormand-Prince 5(4) in a scene with contact, cut at every impact, take-off, stop and slip, which
/// are located to round-off (event_driven.cpp); steps end at the samples and are at most run.step. Throws Unsupported
/// where there is no contact, and where a particle moves between two surfaces or rests between two that move.
Outcome run_event_driven(const Scene& scene, const Run& run, Observer& observer);
/// Moreau's midpoint rule at run.step in a scene with contact, at rest or moved, of any number of particles
/// (time_stepping.cpp): order 1 with contact. No method's name: a route to truth alone. Throws Unsupported where there
/// is no contact, and where a particle touches two surfaces at once.
Outcome run_time_stepping(const Scene& scene, const Run& run, Observer& observer);
/// odeint's extrapolation of the midpoint rule, of varying order (Bulirsch and Stoer), to run.tolerance; steps end at
/// the observed times. Its estimate compares results of different numbers of stages, so that it also sees an
/// error that comes from time alone: Fehlberg's 7(8) pair has the same weights there in both rules, and follows a moved
/// pin 1e-9 of the scene's size wrong under a tolerance of 1e-13.
Outcome run_odeint_bulirsch_stoer(const Scene& scene, const Run& run, Observer& observer);
/// SUNDIALS ARKODE, explicit, Fehlberg 7(8), to run.tolerance; steps end at the samples. Throws Unsupported with the
/// package's name where the suite was built without.
Outcome run_arkode(const Scene& scene, const Run& run, Observer& observer);
/// The same with ARKODE's default rule of order 4 (Zonneveld's 5 4 3).
Outcome run_arkode_order4(const Scene& scene, const Run& run, Observer& observer);
/// SUNDIALS CVODE, Adams' formulas of varying order with GMRES, to run.tolerance; steps end at the samples. Throws
/// Unsupported likewise.
Outcome run_cvode(const Scene& scene, const Run& run, Observer& observer);

std::string odeint_version();                   // Boost's, e.g. "1.74"
std::optional<std::string> sundials_version();  // none: the suite was built without

}  // namespace crosscheck
