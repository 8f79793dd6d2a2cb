// The energies of runs as tables.
#pragma once

#include "experiments/tables/typed.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// The ledger of a run of `engines`.
struct SceneEnergyRow {
  TABLE("SCENE-energy");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, t, "t", "s", "time");
  COLUMN(double, kinetic, "kinetic", "J", "kinetic energy of the free particles");
  COLUMN(double, elastic, "elastic", "J", "energy of the springs");
  COLUMN(double, gravitational, "gravitational", "J", "of the free particles, zero at the origin");
  COLUMN(double, drag, "drag", "J", "taken by drag since the start");
  COLUMN(double, dashpots, "dashpots", "J", "taken by dashpots since the start");
  COLUMN(double, contact, "contact loss", "J", "lost in contact since the start, less what moving spheres gave");
  COLUMN(bool, contact_inferred, "contact loss inferred", "1",
         "1 where the engine does not tell what contact took: it is what the balance lacks");
  COLUMN(double, wind, "wind work", "J", "work done by the wind since the start");
  COLUMN(double, pins, "pin work", "J", "work done by moved pins since the start");
  COLUMN(OptionalNumber, balance_error, "balance error", "J",
         "change of the sum of all these since the start; empty where no balance is claimed");
};

/// The ledger of a long run of `energy`.
struct SceneLedgerRow {
  TABLE("SCENE-ledger");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, t, "t", "s", "time");
  COLUMN(double, kinetic, "kinetic", "J", "kinetic energy of the free particles");
  COLUMN(double, elastic, "elastic", "J", "energy of the springs");
  COLUMN(double, gravitational, "gravitational", "J", "of the free particles, zero at the origin");
  COLUMN(double, drag, "drag", "J", "taken by drag since the start");
  COLUMN(double, dashpots, "dashpots", "J", "taken by dashpots since the start");
  COLUMN(double, contact, "contact loss", "J", "lost in contact since the start, less what moving spheres gave");
  COLUMN(double, wind, "wind work", "J", "work done by the wind since the start");
  COLUMN(double, pins, "pin work", "J", "work done by moved pins since the start");
  COLUMN(OptionalNumber, residual, "residual", "J",
         "change of the sum of all these since the start; empty where no balance is claimed");
  COLUMN(OptionalNumber, largest_residual, "largest residual", "J", "largest size of the residual so far");
};

/// A run of very many steps.
struct EnergyRow {
  TABLE("energy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why it failed or was refused");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(long, steps, "steps", "1", "steps taken");
  COLUMN(bool, undamped, "undamped", "1", "1 where the scene has no drag, no dashpots and no sphere");
  COLUMN(bool, symplectic, "symplectic", "1", "1 where the rule is symplectic");
  COLUMN(bool, closure_claimed, "closure claimed", "1",
         "1 where all that takes or gives energy is known, so that the residual should be zero");
  COLUMN(OptionalNumber, turned_over, "energy turned over", "J",
         "largest kinetic energy, or change of gravitational or elastic energy");
  COLUMN(OptionalNumber, largest_residual, "largest residual", "J",
         "largest size of the residual: of the balance of energies less that at the start");
  COLUMN(OptionalNumber, residual, "residual", "J", "residual at the end");
  COLUMN(OptionalNumber, drift, "drift", "J/s", "slope of the straight line through the residual");
  COLUMN(OptionalNumber, oscillation, "oscillation", "J", "RMS deviation of the residual from that line");
  COLUMN(OptionalNumber, growth, "growth of the residual", "1",
         "log10 of the largest residual over that of the first tenth of the run; 1: grows like time");
  COLUMN(OptionalNumber, equivalent_drag, "equivalent drag", "1/s",
         "drag rate that would take as much from the same motion; negative where energy is made");
  COLUMN(OptionalNumber, kinetic_at_start, "kinetic at start", "J", "kinetic energy at the start");
  COLUMN(OptionalNumber, elastic_at_start, "elastic at start", "J", "energy of the springs at the start");
  COLUMN(OptionalNumber, kinetic, "kinetic", "J", "kinetic energy at the end");
  COLUMN(OptionalNumber, elastic, "elastic", "J", "energy of the springs at the end");
  COLUMN(OptionalNumber, gravity, "gravity gave", "J", "what gravity gave over the run");
  COLUMN(OptionalNumber, drag, "drag took", "J", "what drag took over the run");
  COLUMN(OptionalNumber, dashpots, "dashpots took", "J", "what dashpots took over the run");
  COLUMN(OptionalNumber, contact, "contact took", "J", "what contact took over the run, less what moving spheres gave");
  COLUMN(bool, contact_inferred, "contact inferred", "1",
         "1 where the engine does not tell what contact took: it is what the balance lacks");
  COLUMN(OptionalNumber, wind, "wind gave", "J", "work done by the wind over the run");
  COLUMN(OptionalNumber, pins, "pins gave", "J", "work done by moved pins over the run");
};

/// The numerical damping of a rule on an undamped oscillator.
struct DampingRow {
  TABLE("energy-damping");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(double, h_omega, "h omega", "1", "step times angular frequency of the oscillator");
  COLUMN(OptionalNumber, equivalent_drag, "equivalent drag", "1/s",
         "drag rate that the damping of the measured energy amounts to");
  COLUMN(OptionalNumber, by_theory, "by theory", "1/s",
         "the same by the rule's stability function; empty where the rule has none");
};

/// The ledger of one run as rows; the balance error is empty where the contact loss was inferred, as no closure is
/// claimed there.
void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool contact_inferred);

}  // namespace crosscheck
