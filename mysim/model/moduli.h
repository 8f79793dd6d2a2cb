// What continuum a regular net of springs is: its moduli, which mean the same outside the scene.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mysim/model/model.h"

namespace crosscheck {

/// Moduli of a line (dimension 1, unit N), a sheet (2, N/m) or a block (3, Pa). Axis 1 lies along the net's shortest
/// spacing, axis 2 across it in the net. Of a block c66 is the shear modulus in that plane.
struct Moduli {
  int dimension = 0;
  double c11 = 0, c22 = 0, c12 = 0, c66 = 0;
  double c16 = 0, c26 = 0;  // for sheets only: the coupling of stretch and shear, as in cells with one diagonal
  bool cubic = true;        // the axes are alike, and stretch and shear are not coupled
  double c11_of_bend = 0;   // the part of c11 that skip-one springs give

  /// 1 if all directions are alike: Zener's ratio 2 c66 / (c11 - c12) of a cubic net; of any other sheet the least
  /// Young's modulus over the largest; 0 of a line, and of a block that is not cubic.
  double anisotropy() const;
  /// Contraction across over extension along axis 1, pulled along axis 1; 0 of a line.
  double poisson() const;
  /// Young's modulus along axis 1.
  double young() const;
  /// Young's modulus of a sheet pulled at an angle from axis 1, rad.
  double young_at(double angle) const;
  /// The least and the largest Young's modulus of a sheet over all angles.
  std::pair<double, double> young_range() const;
};

struct NetModuli {
  std::optional<Moduli> moduli;
  std::string why_not;  // where there are none
};

/// The moduli of a net whose springs are at rest and the same everywhere, each with one opposite to it: then a uniform
/// strain moves every particle with it, and the energy per area or volume V of a particle gives
///   C_ijkl = sum over the springs of one particle of k L^2 n_i n_j n_k n_l / (2 V)
/// (M. Born and K. Huang, Dynamical Theory of Crystal Lattices, chapter 5, for central forces). Springs at the edge
/// are not halved in a net, so that a net of n particles a side differs by O(1/n).
NetModuli moduli_of(const Model& model, const State& start);

/// "N", "N/m" or "Pa".
std::string_view unit_of_moduli(int dimension);
/// "C11 = 1200 N/m, C12 = C66 = 200 N/m", and "Young's modulus 1167 N/m along an axis, ..."; of a line one sentence.
/// Isotropic is said of cubic nets of anisotropy 1 alone.
std::vector<std::string> sentences_of(const Moduli& moduli);
/// What skip-one springs do, where they make more than half of c11; else empty.
std::string skip_one_warning(const Moduli& moduli);

/// How a sheet with bending falls into folds: over the length (B / w)^(1/3), w its weight per area.
struct BendingLength {
  double rigidity;  // B, N m
  double length;    // m; infinite without gravity
  double spacing;   // m, the largest of the grid

  double spacings() const { return length / spacing; }
};

/// Nothing without bending. Weight and spacing are those of the start, the weight that of all particles over the area
/// of all cells.
std::optional<BendingLength> bending_length_of(const Model& model, const State& start);
std::string sentence_of(const BendingLength& bending);
/// What a grid does that is coarser than half a fold; else empty.
std::string coarse_grid_warning(const BendingLength& bending);

}  // namespace crosscheck
