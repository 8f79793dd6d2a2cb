// The right-hand side f(X, t), through which steppers see the physics of a scene, and the highest natural frequency.
#pragma once

#include <optional>

#include "mysim/model/model.h"
#include "mysim/simd/spring_graph/spring_kernel.h"

namespace crosscheck {

/// Adds -dF/dx of every term that depends only on position.
void add_stiffness(const Model& model, const State& state, Curvature curvature, Tangent& tangent);

class System {
 public:
  explicit System(const Model& model);

  /// Computes rate = dX/dt at the stage: x' = v and v' = F / m, or x' = f(x, t) in a first-order scene. Moves the pins
  /// to their positions at stage.t first; their v' is zero.
  void derivative(State& stage, State& rate);
  /// Computes a = F / m (3 x n, m/s^2; zero at pins) of all forces, including the drag at stage.v. Moves pins like
  /// derivative().
  void acceleration(State& stage, Points& a);

  /// Computes a = F / m of the forces that depend only on position and time: springs, bending, gravity, uniform wind.
  void position_acceleration(State& stage, Points& a);
  /// Adds F / m of the forces that depend on velocity, except drag: dashpots, air on triangles.
  void add_velocity_acceleration(const State& stage, Points& a);
  bool has_velocity_forces() const { return has_velocity_forces_; }
  /// Computes a = F / m of the forces that position-based methods do not treat as constraints: gravity, wind, air.
  void external_acceleration(const State& stage, Points& a);
  /// c_i / m_i of each particle (n, 1/s); zero without drag.
  const Eigen::ArrayXd& drag_rate() const { return drag_rate_; }

  const Model& model() const { return model_; }
  long evaluations() const { return evaluations_; }
  /// Counts work equivalent to evaluations: products with the tangent, passes over the constraints.
  void count(long evaluations) { evaluations_ += evaluations; }
  long degenerate_springs() const { return degenerate_springs_; }  // springs at zero length, summed over evaluations
  void count_degenerate_springs(long springs) { degenerate_springs_ += springs; }

 private:
  template <class Wanted>
  void sum_forces(const State& stage, Wanted wanted);
  void set_acceleration(Points& a) const;

  const Model& model_;
  Forces forces_;
  Eigen::ArrayXd drag_rate_;
  std::optional<SpringKernel> spring_kernel_;
  bool has_velocity_forces_ = false;
  long evaluations_ = 0, degenerate_springs_ = 0;
};

/// Largest omega (rad/s) of M v'' = -K v with the stiffness K at the state and fixed pins; 0 without springs and
/// bending. Computed by power iteration from a seeded start, which approaches omega from below and stops if a product
/// changes omega^2 by less than 1e-5 of its value, or after 500 products.
double highest_frequency(const Model& model, const State& state);

/// Upper bound of highest_frequency() over all states. Assumes that springs are as stiff across their direction as
/// along it, which is the limit of large stretch.
double highest_frequency_bound(const Model& model, const State& state);

/// The common drag rate gamma = c / m of all free particles (1/s), 0 without drag; nothing if the rates differ.
std::optional<double> uniform_drag_rate(const Model& model);

}  // namespace crosscheck
