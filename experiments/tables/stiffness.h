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

}  // namespace crosscheck
