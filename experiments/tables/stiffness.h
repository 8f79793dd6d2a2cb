// The tables of experiment `stiffness`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// One position-based link.
struct LinkStiffnessRow {
  double kLST = 0, step = 0;
  long iterations = 0;
  double formula = 0, measured = 0, deviation = 0;

  static constexpr std::string_view table = "stiffness";
  static constexpr auto columns = [](auto&& column) {
    column("kLST", "1", &LinkStiffnessRow::kLST, "Bullet's linear stiffness of the link"),
        column("step", "s", &LinkStiffnessRow::step, "time step"),
        column("iterations", "1", &LinkStiffnessRow::iterations, "how often the link is solved in a step"),
        column("formula", "N/m", &LinkStiffnessRow::formula, "stiffness by the formula that hands it over"),
        column("measured", "N/m", &LinkStiffnessRow::measured, "force over extension when it hangs still"),
        column("deviation", "1", &LinkStiffnessRow::deviation, "measured over formula, less 1");
  };
};

/// A chain of three position-based links.
struct NetworkStiffnessRow {
  double stiffness = 0, step = 0;
  long iterations = 0;
  double expected_sag = 0, sag = 0, deviation = 0;

  static constexpr std::string_view table = "stiffness-network";
  static constexpr auto columns = [](auto&& column) {
    column("k h^2/mu", "1", &NetworkStiffnessRow::stiffness,
           "stiffness k of the links, made dimensionless by the step h and the reduced mass mu"),
        column("step", "s", &NetworkStiffnessRow::step, "time step"),
        column("iterations", "1", &NetworkStiffnessRow::iterations, "how often the link is solved in a step"),
        column("sag asked", "m", &NetworkStiffnessRow::expected_sag, "sag by Hooke's law"),
        column("sag", "m", &NetworkStiffnessRow::sag, "measured sag of the chain"),
        column("deviation", "1", &NetworkStiffnessRow::deviation, "measured over asked, less 1");
  };
};

/// The stiffness that a hanging net has under a method, by its sag and by its period.
struct EffectiveStiffnessRow {
  std::string net, method;
  double step = 0;
  long iterations = 0;
  double stiffness = 0, expected_sag = 0;
  std::optional<double> sag = {}, by_sag = {};
  double expected_period = 0;
  std::optional<double> period = {}, by_period = {};

  static constexpr std::string_view table = "stiffness-effective";
  static constexpr auto columns = [](auto&& column) {
    column("net", "1", &EffectiveStiffnessRow::net, "what hangs: a chain, or a cloth held along its upper edge"),
        column("method", "1", &EffectiveStiffnessRow::method, "method that was run"),
        column("step", "s", &EffectiveStiffnessRow::step, "time step of a frame"),
        column("iterations", "1", &EffectiveStiffnessRow::iterations,
               "iterations over all springs in that step; of mysim/xpbd sub-steps of one pass each"),
        column("k h^2/mu", "1", &EffectiveStiffnessRow::stiffness,
               "stiffness k of the springs, made dimensionless by the step h and the reduced mass mu"),
        column("sag asked", "m", &EffectiveStiffnessRow::expected_sag, "sag of the scene at rest"),
        column("sag", "m", &EffectiveStiffnessRow::sag, "measured; empty where the net failed or came to no rest"),
        column("stiffness by sag", "1", &EffectiveStiffnessRow::by_sag,
               "effective stiffness over the one asked for: sag asked / sag"),
        column("period asked", "s", &EffectiveStiffnessRow::expected_period,
               "period of the scene's slowest vibration along gravity"),
        column("period", "s", &EffectiveStiffnessRow::period,
               "measured; empty where it is damped too soon, or has less than twelve steps"),
        column("stiffness by period", "1", &EffectiveStiffnessRow::by_period,
               "effective stiffness over the one asked for: (period asked / period)^2");
  };
};

/// A sheet of springs pulled at an angle from its rows.
struct PulledSheetRow {
  std::string net;
  double structural = 0, shear = 0, bend = 0, angle = 0, predicted = 0, measured = 0, deviation = 0;

  static constexpr std::string_view table = "stiffness-sheets";
  static constexpr auto columns = [](auto&& column) {
    column("net", "1", &PulledSheetRow::net, "what springs the sheet has"),
        column("structural", "N/m", &PulledSheetRow::structural, "stiffness of springs along rows and columns"),
        column("shear", "N/m", &PulledSheetRow::shear, "stiffness of springs along diagonals"),
        column("bend", "N/m", &PulledSheetRow::bend, "stiffness of springs that skip one particle"),
        column("angle", "degrees", &PulledSheetRow::angle, "direction of the pull from a row"),
        column("young predicted", "N/m", &PulledSheetRow::predicted,
               "Young's modulus of the sheet by the formula of its springs"),
        column("young measured", "N/m", &PulledSheetRow::measured,
               "the same from energies of strained nets, free to contract and to shear"),
        column("deviation", "1", &PulledSheetRow::deviation, "measured over predicted, less 1");
  };
};

}  // namespace crosscheck
