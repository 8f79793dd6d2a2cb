#pragma once

#include "experiments/tables/typed.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// The ledger of a run in experiment `engines`.
struct SceneEnergyRow {
  TABLE("SCENE-energy");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, t, "t", "s", "time");
  COLUMN(double, kinetic, "kinetic", "J", "kinetic energy of the free particles");
  COLUMN(double, elastic, "elastic", "J", "energy of the springs");
  COLUMN(double, gravitational, "gravitational", "J", "gravitational energy of the free particles, zero at the origin");
  COLUMN(double, drag, "drag", "J", "energy dissipated by drag since the start");
  COLUMN(double, dashpots, "dashpots", "J", "energy dissipated by dashpots since the start");
  COLUMN(double, contact, "contact loss", "J",
         "energy lost in contact since the start, less the energy that moving spheres supplied");
  COLUMN(bool, contact_inferred, "contact loss inferred", "1",
         "1 if the engine does not report the energy lost in contact, which is then inferred from the energy balance");
  COLUMN(double, wind, "wind work", "J", "work done by the wind since the start");
  COLUMN(double, pins, "pin work", "J", "work done by moving pins since the start");
  COLUMN(OptionalNumber, balance_error, "balance error", "J",
         "change of the sum of all these energies since the start; empty if no closed balance is claimed");
};

/// The ledger of a long run in experiment `energy`.
struct SceneLedgerRow {
  TABLE("SCENE-ledger");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, t, "t", "s", "time");
  COLUMN(double, kinetic, "kinetic", "J", "kinetic energy of the free particles");
  COLUMN(double, elastic, "elastic", "J", "energy of the springs");
  COLUMN(double, gravitational, "gravitational", "J", "gravitational energy of the free particles, zero at the origin");
  COLUMN(double, drag, "drag", "J", "energy dissipated by drag since the start");
  COLUMN(double, dashpots, "dashpots", "J", "energy dissipated by dashpots since the start");
  COLUMN(double, contact, "contact loss", "J",
         "energy lost in contact since the start, less the energy that moving spheres supplied");
  COLUMN(double, wind, "wind work", "J", "work done by the wind since the start");
  COLUMN(double, pins, "pin work", "J", "work done by moving pins since the start");
  COLUMN(OptionalNumber, residual, "residual", "J",
         "change of the sum of all these energies since the start; empty if no closed balance is claimed");
  COLUMN(OptionalNumber, largest_residual, "largest residual", "J", "largest absolute value of the residual so far");
};

struct EnergyRow {
  TABLE("energy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(long, steps, "steps", "1", "steps taken");
  COLUMN(bool, undamped, "undamped", "1", "1 if the scene has no drag, no dashpots and no sphere");
  COLUMN(bool, symplectic, "symplectic", "1", "1 if the rule is symplectic");
  COLUMN(bool, closure_claimed, "closure claimed", "1",
         "1 if all energy gains and losses are known, so that the residual should be zero");
  COLUMN(OptionalNumber, turned_over, "energy turned over", "J",
         "largest kinetic energy, or largest change of gravitational or elastic energy");
  COLUMN(OptionalNumber, largest_residual, "largest residual", "J",
         "largest absolute value of the residual, which is the change of the energy balance since the start");
  COLUMN(OptionalNumber, residual, "residual", "J", "residual at the end");
  COLUMN(OptionalNumber, drift, "drift", "J/s", "slope of the straight line through the residual");
  COLUMN(OptionalNumber, oscillation, "oscillation", "J", "RMS deviation of the residual from this straight line");
  COLUMN(OptionalNumber, growth, "growth of the residual", "1",
         "log10 of the largest residual over that of the first tenth of the run; 1: it grows linearly with time");
  COLUMN(OptionalNumber, equivalent_drag, "equivalent drag", "1/s",
         "drag rate that would dissipate as much in the same motion; negative if energy is created");
  COLUMN(OptionalNumber, kinetic_at_start, "kinetic at start", "J", "kinetic energy at the start");
  COLUMN(OptionalNumber, elastic_at_start, "elastic at start", "J", "energy of the springs at the start");
  COLUMN(OptionalNumber, kinetic, "kinetic", "J", "kinetic energy at the end");
  COLUMN(OptionalNumber, elastic, "elastic", "J", "energy of the springs at the end");
  COLUMN(OptionalNumber, gravity, "gravity gave", "J", "work done by gravity over the run");
  COLUMN(OptionalNumber, drag, "drag took", "J", "energy dissipated by drag over the run");
  COLUMN(OptionalNumber, dashpots, "dashpots took", "J", "energy dissipated by dashpots over the run");
  COLUMN(OptionalNumber, contact, "contact took", "J",
         "energy lost in contact over the run, less the energy that moving spheres supplied");
  COLUMN(bool, contact_inferred, "contact inferred", "1",
         "1 if the engine does not report the energy lost in contact, which is then inferred from the energy balance");
  COLUMN(OptionalNumber, wind, "wind gave", "J", "work done by the wind over the run");
  COLUMN(OptionalNumber, pins, "pins gave", "J", "work done by moving pins over the run");
};

struct DampingRow {
  TABLE("energy-damping");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(double, h_omega, "h omega", "1", "step times angular frequency of the oscillator");
  COLUMN(OptionalNumber, equivalent_drag, "equivalent drag", "1/s",
         "drag rate equivalent to the measured decay of the energy");
  COLUMN(OptionalNumber, by_theory, "by theory", "1/s",
         "equivalent drag by the stability function of the rule; empty if the rule has none");
};

/// Appends the ledger of one run. If the contact loss was inferred from the energy balance, the balance cannot be
/// checked, and the column of its error stays empty.
void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool contact_inferred);

}  // namespace crosscheck
