// Elastic moduli of the continuum that a regular spring network approximates, comparable with measured materials.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// Moduli of a line (dimension 1, in N), a sheet (2, N/m) or a block (3, Pa). Axis 1 points along the network's
/// shortest spacing, axis 2 is perpendicular to it within the network. c66 of a block is the shear modulus in the plane
/// of both axes.
struct Moduli {
  int dimension = 0;
  double c11 = 0, c22 = 0, c12 = 0, c66 = 0;
  double c16 = 0, c26 = 0;  // sheets only: coupling of stretch and shear, e.g. if cells have one diagonal
  bool cubic = true;        // the axes are equivalent, and stretch and shear are not coupled
  double c11_of_bend = 0;   // part of c11 due to skip-one springs

  /// Measure of anisotropy, 1 if isotropic: Zener's ratio 2 c66 / (c11 - c12) for cubic networks, the smallest divided
  /// by the largest Young's modulus for other sheets, and 0 for lines and other blocks.
  double anisotropy() const;
  /// Transverse contraction divided by extension under a pull along axis 1; 0 for a line.
  double poisson() const;
  /// Young's modulus along axis 1.
  double young() const;
  /// Young's modulus of a sheet at an angle (rad) from axis 1.
  double young_at(double angle) const;
  /// Smallest and largest Young's modulus of a sheet over all angles.
  std::pair<double, double> young_range() const;
};

struct NetModuli {
  std::optional<Moduli> moduli;
  std::string why_not;  // reason if there are no moduli
};

/// Moduli of a network whose springs have their rest lengths, are the same at every particle, and form opposite pairs.
/// A uniform strain then moves every particle affinely. With V, the area or volume per particle, the energy gives
///   C_ijkl = sum over the springs of one particle of k L^2 n_i n_j n_k n_l / (2 V)
/// (M. Born and K. Huang, Dynamical Theory of Crystal Lattices, chapter 5, for central forces). Springs along the edge
/// keep their full stiffness, so the moduli of a network of n particles per side deviate from these by O(1/n).
NetModuli moduli_of(const Model& model, const State& start);

/// "N", "N/m" or "Pa".
std::string_view unit_of_moduli(int dimension);
/// Sentences like "C11 = 1200 N/m, C12 = C66 = 200 N/m" and "Young's modulus 1167 N/m along an axis, ..."; only one for
/// a line. Only cubic networks with anisotropy 1 are called isotropic.
std::vector<std::string> sentences_of(const Moduli& moduli);
/// Returns a warning if skip-one springs contribute more than half of c11, otherwise an empty string.
std::string skip_one_warning(const Moduli& moduli);

/// Length scale of the folds of a sheet with bending rigidity: (B / w)^(1/3), where w is its weight per area.
struct BendingLength {
  double rigidity;  // B, N m
  double length;    // m; infinite without gravity
  double spacing;   // m, the largest spacing of the grid

  double spacings() const { return length / spacing; }
};

/// Returns nothing for a model without bending. w is the weight of all particles divided by the area of all cells, in
/// the initial state.
std::optional<BendingLength> bending_length_of(const Model& model, const State& start);
std::string sentence_of(const BendingLength& bending);
/// Returns a warning if the grid is coarser than half a fold, otherwise an empty string.
std::string coarse_grid_warning(const BendingLength& bending);

}  // namespace crosscheck
