#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

struct LinkStiffnessRow {
  TABLE("stiffness");
  COLUMN(double, kLST, "kLST", "1", "Bullet's linear stiffness of the link");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(long, iterations, "iterations", "1", "iterations of the link constraint per step");
  COLUMN(double, formula, "formula", "N/m", "stiffness by the formula that maps it to kLST");
  COLUMN(double, measured, "measured", "N/m", "force over extension at rest");
  COLUMN(double, deviation, "deviation", "1", "measured over formula, less 1");
};

struct NetworkStiffnessRow {
  TABLE("stiffness-network");
  COLUMN(double, stiffness, "k h^2/mu", "1",
         "stiffness k of the links, made dimensionless by the step h and the reduced mass mu");
  COLUMN(double, step, "step", "s", "time step");
  COLUMN(long, iterations, "iterations", "1", "iterations of the link constraints per step");
  COLUMN(double, expected_sag, "sag asked", "m", "expected sag by Hooke's law");
  COLUMN(double, sag, "sag", "m", "measured sag of the chain");
  COLUMN(double, deviation, "deviation", "1", "measured sag over the expected one, less 1");
};

struct EffectiveStiffnessRow {
  TABLE("stiffness-effective");
  COLUMN(std::string, net, "net", "1", "net that hangs: a chain, or a cloth held along its upper edge");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, step, "step", "s", "time step of a frame");
  COLUMN(long, iterations, "iterations", "1",
         "iterations over all springs in that step; for mysim/xpbd, sub-steps of one pass each");
  COLUMN(double, stiffness, "k h^2/mu", "1",
         "stiffness k of the springs, made dimensionless by the step h and the reduced mass mu");
  COLUMN(double, expected_sag, "sag asked", "m", "sag of the scene at rest");
  COLUMN(OptionalNumber, sag, "sag", "m", "measured sag; empty if the run failed or did not come to rest");
  COLUMN(OptionalNumber, by_sag, "stiffness by sag", "1",
         "effective stiffness over the requested one: sag asked / sag");
  COLUMN(double, expected_period, "period asked", "s", "period of the scene's slowest vibration along gravity");
  COLUMN(OptionalNumber, period, "period", "s",
         "measured period; empty if the vibration is damped too soon, or if it has fewer than twelve steps");
  COLUMN(OptionalNumber, by_period, "stiffness by period", "1",
         "effective stiffness over the requested one: (period asked / period)^2");
};

struct PulledSheetRow {
  TABLE("stiffness-sheets");
  COLUMN(std::string, net, "net", "1", "springs of the sheet");
  COLUMN(double, structural, "structural", "N/m", "stiffness of springs along rows and columns");
  COLUMN(double, shear, "shear", "N/m", "stiffness of springs along diagonals");
  COLUMN(double, bend, "bend", "N/m", "stiffness of springs that skip one particle");
  COLUMN(double, angle, "angle", "degrees", "direction of the pull from a row");
  COLUMN(double, predicted, "young predicted", "N/m", "Young's modulus of the sheet by the formula for its springs");
  COLUMN(double, measured, "young measured", "N/m",
         "Young's modulus from the energies of strained nets, which are free to contract and to shear");
  COLUMN(double, deviation, "deviation", "1", "measured over predicted, less 1");
};

}  // namespace crosscheck
