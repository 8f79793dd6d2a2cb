// The Jacobian of a scene about a state, and its eigenvalues, which determine the stable steps of explicit rules.
#pragma once

#include <Eigen/SparseCore>

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The equation w'' = -K w - C w' of the free coordinates, where w = sqrt(m) u, and u is the offset from the state (m).
/// Neglects the air on triangles and the rotation of dashpots.
struct Linearised {
  std::vector<int> free;                 // coordinates 3 i + axis of the particles that are not pinned
  Eigen::VectorXd root_mass;             // sqrt(kg), for each free coordinate
  Eigen::SparseMatrix<double> k;         // M^-1/2 K M^-1/2, 1/s^2
  Eigen::VectorXd drag;                  // diagonal of M^-1 C, 1/s
  Eigen::SparseMatrix<double> dashpots;  // M^-1/2 C M^-1/2 for the dashpots, 1/s

  int size() const { return static_cast<int>(free.size()); }
  bool has_dashpots() const { return dashpots.nonZeros() > 0; }
  /// The matrix C, with drag and dashpots.
  Eigen::SparseMatrix<double> damping() const;
  /// Converts mass-weighted offsets of the free coordinates to offsets of all particles (3 x n, m), and back. Pins have
  /// zero offset.
  Points offsets(const Eigen::VectorXd& w, int particles) const;
  Eigen::VectorXd weighted(const Points& offsets) const;
};
Linearised linearised(const Model& model, const State& state);

/// One vibration u'' = -omega^2 u - gamma u' (rad/s, 1/s).
struct Vibration {
  double omega, gamma;
};

struct Spectrum {
  Linearised system;
  /// If all particles have the same drag rate and there are no dashpots: the modes of K, from slow to fast. Otherwise,
  /// each eigenvalue z of the first-order Jacobian is listed as the vibration with omega = |z| and gamma = -2 Re z,
  /// which has this eigenvalue.
  std::vector<Vibration> modes;
  Eigen::MatrixXd shapes;   // columns are shapes of the modes if `commuting`, mass-weighted and normalised
  Eigen::VectorXd fastest;  // shape of the fastest mode of K, mass-weighted and normalised
  bool commuting = true;    // true if damping and stiffness have common modes
  bool complete = true;     // false if it has only some modes, see spectrum_of()
  double omega = 0;         // frequency of `fastest`, rad/s
};

/// Dense up to 400 free coordinates (200 if damping and stiffness do not commute). Beyond that, Lanczos and Arnoldi
/// iterations of Spectra give only the slowest and the fastest mode or, without commutation, the four rates of largest
/// |z|, which need not include the least damped one. A rotation x' = w cross x is one vibration of frequency |w|
/// without drag. Modes of negative stiffness, which can occur at the start of a motion, count as omega = 0.
Spectrum spectrum_of(const Scene& scene, const State& state);

struct Equilibrium {
  std::optional<State> rest;
  bool saddle = false;  // true if a saddle was found during the search
};
/// The state of rest of experiments/measures.h, refined by Newton steps to the last digits: no acceleration exceeds
/// 1e-11 of what the particle's springs could cause. A rotation rests at the origin. An equilibrium with negative
/// stiffness in some direction (omega^2 < 0) is a saddle and not accepted as rest, although motions that start in a
/// plane of symmetry end there. Random pushes of at least a hundredth of the shortest spring move the scene away from
/// the saddle, until a stable rest is found. The search ends without a rest after three attempts.
Equilibrium equilibrium_of(const Scene& scene);

}  // namespace crosscheck
