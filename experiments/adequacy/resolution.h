// How a cloth depends on its grid: its motion and its rest at several resolutions.
#pragma once

#include <optional>
#include <vector>

#include "experiments/scenes/cloths.h"
#include "mysim/run/observers.h"

namespace crosscheck {

struct GridResult {
  int n;                         // particles along the longer side
  std::optional<double> error;   // m, largest RMS distance from the finest grid in the window, at 17 x 17 points
  std::optional<double> sag;     // m, how far the lowest point hangs below the highest one at rest
  std::optional<double> factor;  // 1, what all stiffnesses are to be multiplied by to sag as the finest grid does
  Verdict verdict;
  long evaluations = 0, springs = 0;
};

/// The cloth at each resolution by leapfrog, ascending; the last is the finest. Rests are looked for where the scene,
/// its pins standing still and its winds and drag left out, has one.
std::vector<GridResult> grid_convergence(const Scene& scene, const std::vector<int>& sizes);

/// y = a x^p by least squares in the logarithms: the exponent and its standard error. Nothing with fewer than three
/// points.
struct PowerLaw {
  double exponent, deviation;
};
std::optional<PowerLaw> power_law(const std::vector<std::pair<double, double>>& points);

/// How the stiffness k of bend (skip-one) springs must grow with the grid for a cloth to droop alike: one line of a
/// cloth of 1 m and 0.1 kg, clamped flat at one end (two pinned particles, half a cell to either side of the clamp, so
/// that the free length is the same on all grids), held flat by bend springs and kept from stretching by structural
/// ones. Derived: with the lengths kept, a curvature
/// kappa turns neighbouring cells of size d by d kappa, which shortens a bend spring over them by d^3 kappa^2 / 4; the
/// energy of one line is k d^6 kappa^4 / 32 per particle, of the cloth k d^4 kappa^4 / 32 per area: for the same cloth
/// k must grow as d^-4, as the fourth power of the number of cells.
struct BendSprings {
  int n;
  double cells;      // 1, in the free length: n - 3/2
  double stiffness;  // N/m, of the bend springs, so that the free end droops as at the first n
  double droop;      // m
};
std::vector<BendSprings> bending_stiffness(const std::vector<int>& sizes);

}  // namespace crosscheck
