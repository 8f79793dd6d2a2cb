// The tables of experiment `engines`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// Of what tier a truth is. What the in-house contact rule converges to is a truth of that rule only.
struct TruthKind {
  Tier tier = Tier::exact;
  bool of_contact_rule = false;
  bool operator==(const TruthKind&) const = default;
};
template <>
struct CellOf<TruthKind> {
  static constexpr std::string_view of_contact_rule = ", in-house contact rule";
  static Cell write(const TruthKind& kind) {
    return std::string(name_of(kind.tier)).append(kind.of_contact_rule ? of_contact_rule : "");
  }
  static TruthKind read(const Cell& cell) {
    std::string word = CellOf<std::string>::read(cell);
    const bool of_rule = word.ends_with(of_contact_rule);
    if (of_rule) word.resize(word.size() - of_contact_rule.size());
    return {CellOf<Tier>::read(word), of_rule};
  }
};

struct EngineRow {
  std::string scene, method;
  Verdict verdict = Verdict::ok;
  std::string reason;
  double end = 0, step = 0;
  long steps = 0, evaluations = 0, coincident = 0;
  double motion = 0, window = 0, measured_window = 0, growth = 0;
  std::optional<double> round_off_bound = {};
  std::optional<bool> same_rule = {};
  std::optional<std::string> truth = {};
  std::optional<TruthKind> truth_kind = {};
  std::optional<double> truth_bar = {}, truth_until = {}, error = {}, contact_difference = {}, difference = {},
                        centre_difference = {}, clearance = {}, creep = {}, step_limit = {};
  std::string different_law = {};

  static constexpr std::string_view table = "engines";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &EngineRow::scene, "scene"), column("method", "1", &EngineRow::method, "method that was run"),
        column("verdict", "1", &EngineRow::verdict, "how the run ended"),
        column("reason", "1", &EngineRow::reason, "why it failed or was refused"),
        column("end", "s", &EngineRow::end, "last time reached"),
        column("step", "s", &EngineRow::step, "time step taken"),
        column("steps", "1", &EngineRow::steps, "steps taken"),
        column("evaluations", "1", &EngineRow::evaluations, "evaluations of the forces"),
        column("coincident springs", "1", &EngineRow::coincident, "springs met at zero length, over all evaluations"),
        column("motion", "m", &EngineRow::motion, "largest RMS distance of the particles from their start"),
        column("window", "s", &EngineRow::window, "how long single positions can be predicted, as the scene states it"),
        column("measured window", "s", &EngineRow::measured_window,
               "the same as measured: until a perturbation of 1e-10 m has grown a thousandfold"),
        column("perturbation growth", "1", &EngineRow::growth, "how many times that perturbation grows in the window"),
        column("round-off bound", "m", &EngineRow::round_off_bound,
               "what engines of one rule may differ by in the precision of this one; empty where single positions "
               "cannot be predicted"),
        column("same rule", "1", &EngineRow::same_rule,
               "whether its runs show the rule of the method that differences are from; empty where it is not known"),
        column("truth", "1", &EngineRow::truth, "how the truth was found; empty where none is known"),
        column("truth tier", "1", &EngineRow::truth_kind, "how sure the truth is"),
        column("truth bar", "m", &EngineRow::truth_bar, "error bar of the truth"),
        column("truth until", "s", &EngineRow::truth_until,
               "until when the truth is known, where that is not to the end"),
        column("largest error", "m", &EngineRow::error, "largest RMS distance from the truth in the window"),
        column("largest difference from converged contact", "m", &EngineRow::contact_difference,
               "largest RMS distance in the window from what the in-house contact rule converges to"),
        column("largest difference", "m", &EngineRow::difference,
               "largest RMS distance from mysim/symplectic-euler in the window"),
        column("largest difference of centres", "m", &EngineRow::centre_difference,
               "largest distance of the centre of mass from that of mysim/symplectic-euler over the run"),
        column("smallest clearance", "m", &EngineRow::clearance,
               "smallest distance of a particle from a sphere's contact surface; negative inside"),
        column("creep at end", "m/s", &EngineRow::creep, "mean sliding speed of the touching particles at the end"),
        column("predicted step limit", "s", &EngineRow::step_limit,
               "largest stable step by linear theory, for the fastest vibration at the start"),
        column("different law", "1", &EngineRow::different_law, "ingredients that the method has under another law");
  };
};

struct EngineCostRow {
  std::string scene, method;
  std::optional<double> cpu = {}, cpu_per_step = {}, simulated_per_cpu = {}, process_cpu = {};

  static constexpr std::string_view table = "engines-cost";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &EngineCostRow::scene, "scene"),
        column("method", "1", &EngineCostRow::method, "method that was run"),
        column("cpu", "s", &EngineCostRow::cpu, "CPU time of the stepping threads"),
        column("cpu per step", "s", &EngineCostRow::cpu_per_step, "the same of one step, in the mean"),
        column("simulated per cpu", "s/s", &EngineCostRow::simulated_per_cpu, "simulated time over CPU time"),
        column("cpu of process", "s", &EngineCostRow::process_cpu,
               "CPU time of a whole outside program, its start and its files included");
  };
};

struct EngineTimeRow {
  std::string method;
  double t = 0;
  std::optional<double> error = {}, contact_difference = {}, difference = {}, centre_difference = {}, clearance = {},
                        creep = {};

  static constexpr std::string_view table = "SCENE-engines";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &EngineTimeRow::method, "method that was run"),
        column("t", "s", &EngineTimeRow::t, "time of the sample"),
        column("error", "m", &EngineTimeRow::error, "RMS distance from the truth"),
        column("difference from converged contact", "m", &EngineTimeRow::contact_difference,
               "RMS distance from what the in-house contact rule converges to"),
        column("difference", "m", &EngineTimeRow::difference, "RMS distance from mysim/symplectic-euler"),
        column("difference of centres", "m", &EngineTimeRow::centre_difference,
               "distance of the centre of mass from that of mysim/symplectic-euler"),
        column("clearance", "m", &EngineTimeRow::clearance,
               "smallest distance of a particle from a sphere's contact surface; negative inside"),
        column("creep", "m/s", &EngineTimeRow::creep, "mean sliding speed of the touching particles");
  };
};

struct EngineEnergyRow {
  std::string scene, method;
  Verdict verdict = Verdict::ok;
  double end = 0, turned_over = 0;
  std::optional<double> balance_error = {}, relative_balance_error = {};
  bool contact_inferred = false;
  std::optional<double> contact = {}, contact_in_truth = {}, contact_bar = {}, contact_until = {};

  static constexpr std::string_view table = "engines-energy";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &EngineEnergyRow::scene, "scene"),
        column("method", "1", &EngineEnergyRow::method, "method that was run"),
        column("verdict", "1", &EngineEnergyRow::verdict, "how the run ended"),
        column("end", "s", &EngineEnergyRow::end, "last time reached"),
        column("energy turned over", "J", &EngineEnergyRow::turned_over,
               "largest kinetic energy, or change of the gravitational one"),
        column("largest balance error", "J", &EngineEnergyRow::balance_error,
               "largest change of the sum of all energies, losses and works"),
        column("relative balance error", "1", &EngineEnergyRow::relative_balance_error,
               "the same over the energy turned over"),
        column("contact loss inferred", "1", &EngineEnergyRow::contact_inferred,
               "1 where the engine does not tell what contact took, so that no balance is claimed"),
        column("contact took", "J", &EngineEnergyRow::contact,
               "what contact took as long as the truth is known, less what moving spheres gave; empty without a truth"),
        column("contact takes in truth", "J", &EngineEnergyRow::contact_in_truth, "the same of the truth"),
        column("bar of contact in truth", "J", &EngineEnergyRow::contact_bar, "error bar of that"),
        column("contact until", "s", &EngineEnergyRow::contact_until, "end of what these three add up");
  };
};

/// Statistics of a scene with contact: of sixteen perturbed runs, or of one run in units of the spread of such runs.
struct StatisticRow {
  std::string method, quantity, unit;
  double mean = 0;
  std::optional<double> deviation = {}, apart = {};

  static constexpr std::string_view table = "SCENE-statistics";
  static constexpr auto columns = [](auto&& column) {
    column("method", "1", &StatisticRow::method, "method that was run"),
        column("quantity", "1", &StatisticRow::quantity, "what the mean is of"),
        column("unit", "1", &StatisticRow::unit, "unit of mean and deviation"),
        column("mean", "see unit", &StatisticRow::mean,
               "mean over runs from perturbed starts, or of one run without a deviation"),
        column("deviation", "see unit", &StatisticRow::deviation, "standard deviation over these runs"),
        column("apart", "1", &StatisticRow::apart,
               "distance of the mean from that of mysim's perturbed runs, in their standard deviations");
  };
};

}  // namespace crosscheck
