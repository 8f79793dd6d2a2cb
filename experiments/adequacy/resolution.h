// Grid dependence of a cloth: its motion and its rest at several resolutions.
#pragma once

#include <optional>
#include <vector>

#include "experiments/scenes/cloths.h"
#include "mysim/run/observers.h"

namespace crosscheck {

struct GridResult {
  int n;                         // particles along the longer side
  std::optional<double> error;   // m, largest RMS distance from the finest grid in the window, at 17 x 17 points
  std::optional<double> sag;     // m, height difference between the highest and lowest point at rest
  std::optional<double> factor;  // 1, common factor of all stiffnesses that gives the sag of the finest grid
  Verdict verdict;
  long evaluations = 0, springs = 0;
};

/// Runs the cloth with leapfrog at each resolution, in ascending order; the last one is the reference. Also computes
/// the state of rest with fixed pins and without winds and drag, if there is one.
std::vector<GridResult> grid_convergence(const Scene& scene, const std::vector<int>& sizes);

/// Exponent of y = a x^p and its standard error, from a least-squares fit of log y. power_law() returns nullopt for
/// fewer than three points.
struct PowerLaw {
  double exponent, deviation;
};
std::optional<PowerLaw> power_law(const std::vector<std::pair<double, double>>& points);

/// Scaling of the stiffness k of bend (skip-one) springs with the grid, for the same droop. The model is one line of a
/// cloth of 1 m and 0.1 kg, held flat by bend springs and kept from stretching by structural springs. Two pinned
/// particles, half a cell to either side of the clamp, hold the line flat there, so that the free length is the same on
/// all grids. Derivation: if lengths are preserved, a curvature kappa turns neighbouring cells of size d by d kappa,
/// which shortens a bend spring that spans two cells by d^3 kappa^2 / 4. The energy of one line is k d^6 kappa^4 / 32
/// per particle, and that of the cloth is k d^4 kappa^4 / 32 per area. Hence k must grow as d^-4.
struct BendSprings {
  int n;
  double cells;      // 1, number of cells in the free length: n - 3/2
  double stiffness;  // N/m, of a bend spring, for the same droop as with the first grid
  double droop;      // m
};
std::vector<BendSprings> bending_stiffness(const std::vector<int>& sizes);

}  // namespace crosscheck
