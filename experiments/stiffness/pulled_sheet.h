// Virtual stretching: a net's moduli from the energy of its springs under small uniform strains, independently of the
// formula of mysim/model/moduli.h.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

struct NetSprings {
  double structural, shear, bend;  // N/m
  double spacing;                  // m
  int dimension = 2;
};

/// Nets with n, n + 1, ... particles a side. Their energies under a uniform strain are a polynomial in n, whose leading
/// coefficient is the energy of a cell. Differences between nets of different n extract this coefficient without edge
/// effects.
class StrainedNets {
 public:
  explicit StrainedNets(const NetSprings& net);
  const Scene& largest() const { return scenes_.back(); }

  /// Energy per area (J/m^2) or volume (J/m^3) after all positions are multiplied by 1 + strain.
  double energy_density(const Eigen::Matrix3d& strain) const;
  /// Stiffness (N/m) of a sheet for the strains along 1, along 2 and twice the shear, in axes turned by an angle (rad)
  /// around its normal. Uses central differences of the energy over strains of 1e-4, with a relative error of the order
  /// of 1e-8 from the springs' nonlinearity.
  Eigen::Matrix3d stiffness(double angle) const;
  /// Young's modulus (N/m) of a sheet that is pulled at an angle from a row, and is free to contract and to shear.
  double young(double angle) const;

 private:
  double cell_;  // m^2 or m^3
  int dimension_;
  std::vector<Scene> scenes_;
};

/// Sheets of three kinds, pulled at 0 to 45 degrees from a row.
std::vector<Point> pulled_sheet_points();

}  // namespace crosscheck
