// The right-hand side f(X, t): all that a stepper sees of a scene. It counts its evaluations.
#pragma once

#include <optional>

#include "mysim/model.h"
#include "mysim/spring_kernel.h"

namespace crosscheck {

/// Adds -dF/dx of every term that depends on position alone, at the state's positions.
void add_stiffness(const Model& model, const State& state, Curvature curvature, Tangent& tangent);

class System {
 public:
  explicit System(const Model& model);

  /// rate = dX/dt at the stage: x' = v and v' = F / m, or x' = f(x, t) in a first-order scene. Pins are first put where
  /// they are at stage.t (that is why the stage is not const); their v' is zero.
  void derivative(State& stage, State& rate);
  /// a = F / m with every force, the drag at stage.v included (3 x n, m/s^2; zero at pins). Moves pins like derivative.
  void acceleration(State& stage, Points& a);

  /// a = F / m of the forces that depend on position and time alone: springs, gravity, uniform wind.
  void position_acceleration(State& stage, Points& a);
  /// Adds F / m of the forces that depend on velocity too, drag left out: dashpots, air on triangles.
  void add_velocity_acceleration(const State& stage, Points& a);
  bool has_velocity_forces() const { return has_velocity_forces_; }
  /// a = F / m of what position-based methods do not treat as constraints: gravity, wind, air on triangles.
  void external_acceleration(const State& stage, Points& a);
  /// c_i / m_i of each particle (n, 1/s), of the drag; zero without drag.
  const Eigen::ArrayXd& drag_rate() const { return drag_rate_; }

  const Model& model() const { return model_; }
  long evaluations() const { return evaluations_; }
  /// Counts work that costs about as much as an evaluation: products with the tangent, passes over the constraints.
  void count(long evaluations) { evaluations_ += evaluations; }
  long coincident() const { return coincident_; }  // springs met at zero length, summed over all evaluations
  void count_coincident(long springs) { coincident_ += springs; }

 private:
  template <class Wanted>
  void sum_forces(const State& stage, Wanted wanted);
  void set_acceleration(Points& a) const;

  const Model& model_;
  Forces forces_;
  Eigen::ArrayXd drag_rate_;
  std::optional<SpringKernel> spring_kernel_;
  bool has_velocity_forces_ = false;
  long evaluations_ = 0, coincident_ = 0;
};

}  // namespace crosscheck
