// The energies of runs as tables.
#pragma once

#include "experiments/tables/typed.h"
#include "mysim/run/observers.h"

namespace crosscheck {

/// The ledger of a run of `engines`.
struct SceneEnergyRow {
  std::string method;
  double t = 0, kinetic = 0, elastic = 0, gravitational = 0, drag = 0, dashpots = 0, contact = 0;
  bool contact_inferred = false;
  double wind = 0, pins = 0;
  std::optional<double> balance_error = {};

  static constexpr std::string_view table = "SCENE-energy";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &SceneEnergyRow::method, "method that was run"), column("t", "s", &SceneEnergyRow::t, "time"),
        column("kinetic", "J", &SceneEnergyRow::kinetic, "kinetic energy of the free particles"),
        column("elastic", "J", &SceneEnergyRow::elastic, "energy of the springs"),
        column("gravitational", "J", &SceneEnergyRow::gravitational, "of the free particles, zero at the origin"),
        column("drag", "J", &SceneEnergyRow::drag, "taken by drag since the start"),
        column("dashpots", "J", &SceneEnergyRow::dashpots, "taken by dashpots since the start"),
        column("contact loss", "J", &SceneEnergyRow::contact,
               "lost in contact since the start, less what moving spheres gave"),
        column("contact loss inferred", "1", &SceneEnergyRow::contact_inferred,
               "1 where the engine does not tell what contact took: it is what the balance lacks"),
        column("wind work", "J", &SceneEnergyRow::wind, "work done by the wind since the start"),
        column("pin work", "J", &SceneEnergyRow::pins, "work done by moved pins since the start"),
        column("balance error", "J", &SceneEnergyRow::balance_error,
               "change of the sum of all these since the start; empty where no balance is claimed");
  };
};

/// The ledger of a long run of `energy`.
struct SceneLedgerRow {
  std::string method;
  double t = 0, kinetic = 0, elastic = 0, gravitational = 0, drag = 0, dashpots = 0, contact = 0, wind = 0, pins = 0;
  std::optional<double> residual = {}, largest_residual = {};

  static constexpr std::string_view table = "SCENE-ledger";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &SceneLedgerRow::method, "method that was run"), column("t", "s", &SceneLedgerRow::t, "time"),
        column("kinetic", "J", &SceneLedgerRow::kinetic, "kinetic energy of the free particles"),
        column("elastic", "J", &SceneLedgerRow::elastic, "energy of the springs"),
        column("gravitational", "J", &SceneLedgerRow::gravitational, "of the free particles, zero at the origin"),
        column("drag", "J", &SceneLedgerRow::drag, "taken by drag since the start"),
        column("dashpots", "J", &SceneLedgerRow::dashpots, "taken by dashpots since the start"),
        column("contact loss", "J", &SceneLedgerRow::contact,
               "lost in contact since the start, less what moving spheres gave"),
        column("wind work", "J", &SceneLedgerRow::wind, "work done by the wind since the start"),
        column("pin work", "J", &SceneLedgerRow::pins, "work done by moved pins since the start"),
        column("residual", "J", &SceneLedgerRow::residual,
               "change of the sum of all these since the start; empty where no balance is claimed"),
        column("largest residual", "J", &SceneLedgerRow::largest_residual, "largest size of the residual so far");
  };
};

/// A run of very many steps.
struct EnergyRow {
  std::string scene, method;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double end = 0, step = 0;
  long steps = 0;
  bool undamped = false, symplectic = false, closure_claimed = false;
  std::optional<double> turned_over = {}, largest_residual = {}, residual = {}, drift = {}, oscillation = {},
                        growth = {}, equivalent_drag = {}, kinetic_at_start = {}, elastic_at_start = {}, kinetic = {},
                        elastic = {}, gravity = {}, drag = {}, dashpots = {}, contact = {};
  bool contact_inferred = false;
  std::optional<double> wind = {}, pins = {};

  static constexpr std::string_view table = "energy";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &EnergyRow::scene, "scene"), column("method", "1", &EnergyRow::method, "method that was run"),
        column("verdict", "1", &EnergyRow::verdict, "how the run ended"),
        column("reason", "1", &EnergyRow::reason, "why it failed or was refused"),
        column("end", "s", &EnergyRow::end, "last time reached"),
        column("step", "s", &EnergyRow::step, "time step taken"),
        column("steps", "1", &EnergyRow::steps, "steps taken"),
        column("undamped", "1", &EnergyRow::undamped, "1 where the scene has no drag, no dashpots and no sphere"),
        column("symplectic", "1", &EnergyRow::symplectic, "1 where the rule is symplectic"),
        column("closure claimed", "1", &EnergyRow::closure_claimed,
               "1 where all that takes or gives energy is known, so that the residual should be zero"),
        column("energy turned over", "J", &EnergyRow::turned_over,
               "largest kinetic energy, or change of gravitational or elastic energy"),
        column("largest residual", "J", &EnergyRow::largest_residual,
               "largest size of the residual: of the balance of energies less that at the start"),
        column("residual", "J", &EnergyRow::residual, "residual at the end"),
        column("drift", "J/s", &EnergyRow::drift, "slope of the straight line through the residual"),
        column("oscillation", "J", &EnergyRow::oscillation, "RMS deviation of the residual from that line"),
        column("growth of the residual", "1", &EnergyRow::growth,
               "log10 of the largest residual over that of the first tenth of the run; 1: grows like time"),
        column("equivalent drag", "1/s", &EnergyRow::equivalent_drag,
               "drag rate that would take as much from the same motion; negative where energy is made"),
        column("kinetic at start", "J", &EnergyRow::kinetic_at_start, "kinetic energy at the start"),
        column("elastic at start", "J", &EnergyRow::elastic_at_start, "energy of the springs at the start"),
        column("kinetic", "J", &EnergyRow::kinetic, "kinetic energy at the end"),
        column("elastic", "J", &EnergyRow::elastic, "energy of the springs at the end"),
        column("gravity gave", "J", &EnergyRow::gravity, "what gravity gave over the run"),
        column("drag took", "J", &EnergyRow::drag, "what drag took over the run"),
        column("dashpots took", "J", &EnergyRow::dashpots, "what dashpots took over the run"),
        column("contact took", "J", &EnergyRow::contact,
               "what contact took over the run, less what moving spheres gave"),
        column("contact inferred", "1", &EnergyRow::contact_inferred,
               "1 where the engine does not tell what contact took: it is what the balance lacks"),
        column("wind gave", "J", &EnergyRow::wind, "work done by the wind over the run"),
        column("pins gave", "J", &EnergyRow::pins, "work done by moved pins over the run");
  };
};

/// The numerical damping of a rule on an undamped oscillator.
struct DampingRow {
  std::string method;
  Verdict verdict = Verdict::ok;
  double end = 0, step = 0, h_omega = 0;
  std::optional<double> equivalent_drag = {}, by_theory = {};

  static constexpr std::string_view table = "energy-damping";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &DampingRow::method, "method that was run"),
        column("verdict", "1", &DampingRow::verdict, "how the run ended"),
        column("end", "s", &DampingRow::end, "last time reached"),
        column("step", "s", &DampingRow::step, "time step taken"),
        column("h omega", "1", &DampingRow::h_omega, "step times angular frequency of the oscillator"),
        column("equivalent drag", "1/s", &DampingRow::equivalent_drag,
               "drag rate that the damping of the measured energy amounts to"),
        column("by theory", "1/s", &DampingRow::by_theory,
               "the same by the rule's stability function; empty where the rule has none");
  };
};

/// The ledger of one run as rows; the balance error is empty where the contact loss was inferred, as no closure is
/// claimed there.
void add_ledger(Table& table, const std::string& method, const std::vector<LedgerRow>& rows, bool contact_inferred);

}  // namespace crosscheck
