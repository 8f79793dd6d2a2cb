#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// Tier of a truth. A limit of mysim's own contact rule is a truth of that rule only.
struct TruthKind {
  Tier tier = Tier::exact;
  bool of_contact_rule = false;
  bool operator==(const TruthKind&) const = default;
};
template <>
struct CellOf<TruthKind> {
  static constexpr std::string_view of_contact_rule = ", mysim's contact rule";
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
  COLUMN(std::string, reason, "reason", "1", "why the run failed or was refused");
  COLUMN(double, end, "end", "s", "last time reached");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(long, steps, "steps", "1", "steps taken");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations");
  COLUMN(long, coincident, "coincident springs", "1", "springs of zero length, summed over all evaluations");
  COLUMN(double, motion, "motion", "m", "largest RMS distance of the particles from their start");
  COLUMN(double, window, "window", "s", "time up to which single positions can be predicted, as stated by the scene");
  COLUMN(double, measured_window, "measured window", "s",
         "measured time until a perturbation of 1e-10 m has grown a thousandfold");
  COLUMN(double, growth, "perturbation growth", "1", "growth factor of a perturbation of 1e-10 m in the window");
  COLUMN(OptionalNumber, round_off_bound, "round-off bound", "m",
         "largest difference to expect between engines of the same rule, in the precision of this one; empty if single "
         "positions cannot be predicted");
  COLUMN(std::optional<bool>, same_rule, "same rule", "1",
         "whether the run shows the same integration rule as the method that differences refer to; empty if unknown");
  COLUMN(std::optional<std::string>, truth, "truth", "1", "origin of the truth; empty if none is known");
  COLUMN(std::optional<TruthKind>, truth_kind, "truth tier", "1", "tier of the truth");
  COLUMN(OptionalNumber, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(OptionalNumber, truth_until, "truth until", "s",
         "time up to which the truth is known, if that is not the end");
  COLUMN(OptionalNumber, error, "largest error", "m", "largest RMS distance from the truth in the window");
  COLUMN(OptionalNumber, contact_difference, "largest difference from converged contact", "m",
         "largest RMS distance in the window from the limit of mysim's contact rule");
  COLUMN(OptionalNumber, difference, "largest difference", "m",
         "largest RMS distance from mysim/symplectic-euler in the window");
  COLUMN(OptionalNumber, centre_difference, "largest difference of centres", "m",
         "largest distance of the centre of mass from that of mysim/symplectic-euler over the run");
  COLUMN(OptionalNumber, clearance, "smallest clearance", "m",
         "smallest distance of a particle from a sphere's contact surface; negative inside");
  COLUMN(OptionalNumber, creep, "creep at end", "m/s", "mean sliding speed of the touching particles at the end");
  COLUMN(OptionalNumber, step_limit, "predicted step limit", "s",
         "largest stable step by linear theory, for the fastest vibration at the start");
  COLUMN(std::string, different_law, "different law", "1", "ingredients that the method models with a different law");
};

struct EngineCostRow {
  TABLE("engines-cost");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(OptionalNumber, cpu, "cpu", "s", "CPU time of the stepping threads");
  COLUMN(OptionalNumber, cpu_per_step, "cpu per step", "s", "mean CPU time of a step");
  COLUMN(OptionalNumber, simulated_per_cpu, "simulated per cpu", "s/s", "simulated time over CPU time");
  COLUMN(OptionalNumber, process_cpu, "cpu of process", "s",
         "CPU time of a whole external program, including start-up and file access");
};

struct EngineTimeRow {
  TABLE("SCENE-engines");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, t, "t", "s", "time of the sample");
  COLUMN(OptionalNumber, error, "error", "m", "RMS distance from the truth");
  COLUMN(OptionalNumber, contact_difference, "difference from converged contact", "m",
         "RMS distance from the limit of mysim's contact rule");
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
  COLUMN(double, turned_over, "energy turned over", "J",
         "largest kinetic energy, or largest change of gravitational energy");
  COLUMN(OptionalNumber, balance_error, "largest balance error", "J",
         "largest change of the sum of all energies, losses and works");
  COLUMN(OptionalNumber, relative_balance_error, "relative balance error", "1",
         "largest balance error over the energy turned over");
  COLUMN(bool, contact_inferred, "contact loss inferred", "1",
         "1 if the engine does not report the energy lost in contact, so that no balance is claimed");
  COLUMN(OptionalNumber, contact, "contact took", "J",
         "energy lost in contact while the truth is known, less the energy that moving spheres supplied; empty without "
         "a truth");
  COLUMN(OptionalNumber, contact_in_truth, "contact takes in truth", "J", "energy lost in contact in the truth");
  COLUMN(OptionalNumber, contact_bar, "bar of contact in truth", "J", "error bar of the contact loss in the truth");
  COLUMN(OptionalNumber, contact_until, "contact until", "s", "end of the period that these three columns cover");
};

/// Statistics of a scene with contact, either of sixteen perturbed runs, or of one run relative to the spread of such
/// runs.
struct StatisticRow {
  TABLE("SCENE-statistics");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(std::string, quantity, "quantity", "1", "averaged quantity");
  COLUMN(std::string, unit, "unit", "1", "unit of mean and deviation");
  COLUMN(double, mean, "mean", "see unit",
         "mean over runs from perturbed starts, or the value of one run if no deviation");
  COLUMN(OptionalNumber, deviation, "deviation", "see unit", "standard deviation over these runs");
  COLUMN(OptionalNumber, apart, "apart", "1",
         "distance of the mean from that of mysim's perturbed runs, in their standard deviations");
};

}  // namespace crosscheck
