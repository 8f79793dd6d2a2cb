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
  TABLE("engines");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(std::string, reason, "reason", "1", "why it failed or was refused");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(long, steps, "steps", "1", "steps taken");
  COLUMN(long, evaluations, "evaluations", "1", "evaluations of the forces");
  COLUMN(long, coincident, "coincident springs", "1", "springs met at zero length, over all evaluations");
  COLUMN(double, motion, "motion", "m", "largest RMS distance of the particles from their start");
  COLUMN(double, window, "window", "s", "how long single positions can be predicted, as the scene states it");
  COLUMN(double, measured_window, "measured window", "s",
         "the same as measured: until a perturbation of 1e-10 m has grown a thousandfold");
  COLUMN(double, growth, "perturbation growth", "1", "how many times that perturbation grows in the window");
  COLUMN(OptionalNumber, round_off_bound, "round-off bound", "m",
         "what engines of one rule may differ by in the precision of this one; empty where single positions cannot be "
         "predicted");
  COLUMN(std::optional<bool>, same_rule, "same rule", "1",
         "whether its runs show the rule of the method that differences are from; empty where it is not known");
  COLUMN(std::optional<std::string>, truth, "truth", "1", "how the truth was found; empty where none is known");
  COLUMN(std::optional<TruthKind>, truth_kind, "truth tier", "1", "how sure the truth is");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(OptionalNumber, truth_until, "truth until", "s",
         "until when the truth is known, where that is not to the end");
  COLUMN(OptionalNumber, error, "largest error", "m", "largest RMS distance from the truth in the window");
  COLUMN(OptionalNumber, contact_difference, "largest difference from converged contact", "m",
         "largest RMS distance in the window from what the in-house contact rule converges to");
  COLUMN(OptionalNumber, difference, "largest difference", "m",
         "largest RMS distance from mysim/symplectic-euler in the window");
  COLUMN(OptionalNumber, centre_difference, "largest difference of centres", "m",
         "largest distance of the centre of mass from that of mysim/symplectic-euler over the run");
  COLUMN(OptionalNumber, clearance, "smallest clearance", "m",
         "smallest distance of a particle from a sphere's contact surface; negative inside");
  COLUMN(OptionalNumber, creep, "creep at end", "m/s", "mean sliding speed of the touching particles at the end");
  COLUMN(OptionalNumber, step_limit, "predicted step limit", "s",
         "largest stable step by linear theory, for the fastest vibration at the start");
  COLUMN(std::string, different_law, "different law", "1", "ingredients that the method has under another law");
};

struct EngineCostRow {
  TABLE("engines-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(OptionalNumber, cpu, "cpu", "s", "CPU time of the stepping threads");
  COLUMN(OptionalNumber, cpu_per_step, "cpu per step", "s", "the same of one step, in the mean");
  COLUMN(OptionalNumber, simulated_per_cpu, "simulated per cpu", "s/s", "simulated time over CPU time");
  COLUMN(OptionalNumber, process_cpu, "cpu of process", "s",
         "CPU time of a whole outside program, its start and its files included");
};

struct EngineTimeRow {
  TABLE("SCENE-engines");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, t, "t", "s", "time of the sample");
  COLUMN(OptionalNumber, error, "error", "m", "RMS distance from the truth");
  COLUMN(OptionalNumber, contact_difference, "difference from converged contact", "m",
         "RMS distance from what the in-house contact rule converges to");
  COLUMN(OptionalNumber, difference, "difference", "m", "RMS distance from mysim/symplectic-euler");
  COLUMN(OptionalNumber, centre_difference, "difference of centres", "m",
         "distance of the centre of mass from that of mysim/symplectic-euler");
  COLUMN(OptionalNumber, clearance, "clearance", "m",
         "smallest distance of a particle from a sphere's contact surface; negative inside");
  COLUMN(OptionalNumber, creep, "creep", "m/s", "mean sliding speed of the touching particles");
};

struct EngineEnergyRow {
  TABLE("engines-energy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, turned_over, "energy turned over", "J", "largest kinetic energy, or change of the gravitational one");
  COLUMN(OptionalNumber, balance_error, "largest balance error", "J",
         "largest change of the sum of all energies, losses and works");
  COLUMN(OptionalNumber, relative_balance_error, "relative balance error", "1", "the same over the energy turned over");
  COLUMN(bool, contact_inferred, "contact loss inferred", "1",
         "1 where the engine does not tell what contact took, so that no balance is claimed");
  COLUMN(OptionalNumber, contact, "contact took", "J",
         "what contact took as long as the truth is known, less what moving spheres gave; empty without a truth");
  COLUMN(OptionalNumber, contact_in_truth, "contact takes in truth", "J", "the same of the truth");
  COLUMN(OptionalNumber, contact_bar, "bar of contact in truth", "J", "error bar of that");
  COLUMN(OptionalNumber, contact_until, "contact until", "s", "end of what these three add up");
};

/// Statistics of a scene with contact: of sixteen perturbed runs, or of one run in units of the spread of such runs.
struct StatisticRow {
  TABLE("SCENE-statistics");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(std::string, quantity, "quantity", "1", "what the mean is of");
  COLUMN(std::string, unit, "unit", "1", "unit of mean and deviation");
  COLUMN(double, mean, "mean", "see unit", "mean over runs from perturbed starts, or of one run without a deviation");
  COLUMN(OptionalNumber, deviation, "deviation", "see unit", "standard deviation over these runs");
  COLUMN(OptionalNumber, apart, "apart", "1",
         "distance of the mean from that of mysim's perturbed runs, in their standard deviations");
};

}  // namespace crosscheck
