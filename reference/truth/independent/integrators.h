// Library integrators (odeint, SUNDIALS) on the independent right-hand side: methods, and one of two routes to a
// converged truth.
#pragma once

#include <optional>
#include <string>

#include "mysim/run/run.h"

namespace crosscheck {

// All but the two for contact throw Unsupported if there is contact. Integrators under error control keep the estimated
// error of each step below R (scene size + |component|), with R = run.tolerance and velocities multiplied by a time
// unit of the scene (velocity_time_unit): odeint in every component, SUNDIALS in the root mean square.

/// odeint's classic Runge-Kutta rule at run.step.
Outcome run_odeint_rk4(const Scene& scene, const Run& run, Observer& observer);
/// odeint's Dormand-Prince 5(4) to run.tolerance, interpolated at the observed times.
Outcome run_odeint_dopri5(const Scene& scene, const Run& run, Observer& observer);
/// odeint's Dormand-Prince 5(4) with contact (event_driven.cpp), interrupted at every impact, take-off, stop and slip,
/// which are located to round-off. Steps end at the samples and are at most run.step. Throws Unsupported if there is no
/// contact, or if a particle moves between two surfaces or rests between two moving ones.
Outcome run_event_driven(const Scene& scene, const Run& run, Observer& observer);
/// Moreau's midpoint rule at run.step, with contact between any number of particles and fixed or moving solids
/// (time_stepping.cpp): order 1. A route to truth only, not a method. Throws Unsupported if there is no contact, or if
/// a particle touches two surfaces at once.
Outcome run_time_stepping(const Scene& scene, const Run& run, Observer& observer);
/// odeint's extrapolation of the midpoint rule, of varying order (Bulirsch and Stoer), to run.tolerance; steps end at
/// the observed times. Its estimate compares different numbers of stages, so it also detects errors due to explicit
/// time dependence alone. Both rules of Fehlberg's 7(8) pair weight this dependence alike. For a moved pin, the pair's
/// error is therefore 1e-9 of the scene's size despite a tolerance of 1e-13.
Outcome run_odeint_bulirsch_stoer(const Scene& scene, const Run& run, Observer& observer);
/// SUNDIALS ARKODE, explicit, Fehlberg 7(8), to run.tolerance; steps end at the samples. Throws Unsupported with the
/// package's name if the suite was built without it.
Outcome run_arkode(const Scene& scene, const Run& run, Observer& observer);
/// Like run_arkode, with ARKODE's default rule of order 4 (Zonneveld's 5 4 3).
Outcome run_arkode_order4(const Scene& scene, const Run& run, Observer& observer);
/// SUNDIALS CVODE, Adams' formulas of varying order with GMRES, to run.tolerance; steps end at the samples. Throws like
/// run_arkode.
Outcome run_cvode(const Scene& scene, const Run& run, Observer& observer);

std::string odeint_version();                   // Boost's, e.g. "1.74"
std::optional<std::string> sundials_version();  // nullopt: built without it

}  // namespace crosscheck
