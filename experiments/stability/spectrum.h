// The Jacobian of a scene about a state, and its eigenvalues: what decides the steps that explicit rules can take.
#pragma once

#include <Eigen/SparseCore>

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// w'' = -K w - C w' of the free coordinates, w = sqrt(m) u with u the offset from the state (m). Air on triangles and
/// what turns dashpots are left out.
struct Linearised {
  std::vector<int> free;                 // coordinates 3 i + axis of the particles that are not pinned
  Eigen::VectorXd root_mass;             // of each of them, sqrt(kg)
  Eigen::SparseMatrix<double> k;         // M^-1/2 K M^-1/2, 1/s^2
  Eigen::VectorXd drag;                  // diagonal of M^-1 C, 1/s
  Eigen::SparseMatrix<double> dashpots;  // M^-1/2 C M^-1/2 of the dashpots, 1/s

  int size() const { return static_cast<int>(free.size()); }
  bool has_dashpots() const { return dashpots.nonZeros() > 0; }
  /// C as a whole.
  Eigen::SparseMatrix<double> damping() const;
  /// Offsets of all particles (3 x n, m) from mass-weighted ones, and back; pins have none.
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
  /// Where one drag rate holds for all and there are no dashpots, the modes of K, from slow to fast; elsewhere each
  /// eigenvalue z of the first-order Jacobian as the vibration of |z| and -2 Re z, which has it.
  std::vector<Vibration> modes;
  Eigen::MatrixXd shapes;   // columns, mass-weighted, of length 1; of the modes where `commuting`
  Eigen::VectorXd fastest;  // the fastest shape of K, mass-weighted, of length 1
  bool commuting = true;    // damping and stiffness have the same modes
  bool complete = true;     // false: only some modes, see spectrum_of()
  double omega = 0;         // of `fastest`, rad/s
};

/// Dense up to 400 free coordinates (200 where damping and stiffness do not commute), by Lanczos and Arnoldi iterations
/// of Spectra beyond that: then only the slowest and the fastest mode, or, where they do not commute, the four rates of
/// largest |z|, which say nothing of the least damped one. A rotation x' = w cross x is one vibration of |w|
/// without drag. Modes that the stiffness pushes away from the state, as it may at the start of a motion, count as
/// omega = 0.
Spectrum spectrum_of(const Scene& scene, const State& state);

struct Equilibrium {
  std::optional<State> rest;
  bool saddle = false;  // one was found on the way, and left
};
/// The state of rest of experiments/measures.h, by Newton's steps to the last digits: no particle is accelerated by
/// more than 1e-11 of what its springs could do. A rotation rests at the origin. An equilibrium that the stiffness
/// pushes away from (omega^2 < 0 in some direction: a saddle, where what starts in a plane of symmetry ends up) is no
/// rest: it is left by random pushes of a hundredth of the shortest spring and more, until what is found holds, or for
/// good after three.
Equilibrium equilibrium_of(const Scene& scene);

}  // namespace crosscheck
