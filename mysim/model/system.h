// The right-hand side f(X, t): all that a stepper sees of a scene; and the highest natural frequency of it.
#pragma once

#include <optional>

#include "mysim/model/model.h"
#include "mysim/simd/spring_graph/spring_kernel.h"

namespace crosscheck {

// The right-hand side f(X, t): all that a stepper sees of a scene. It counts its evaluations.

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

  /// a = F / m of the forces that depend on position and time alone: springs, bending, gravity, uniform wind.
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
  long degenerate_springs() const {
    return degenerate_springs_;
  }  // springs met at zero length, summed over all evaluations
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

// Rates of a model: its fastest vibration, which decides what step an explicit rule can take, and its drag.

/// Largest omega (rad/s) of M v'' = -K v with the stiffness K of the state, pins held; 0 without springs and bending.
/// Power iteration from a seeded start, to 1e-4 or 500 products: from below.
double highest_frequency(const Model& model, const State& state);

/// The same with every spring stretched far: then it pulls across its line as it does along it, and no state is faster.
double highest_frequency_bound(const Model& model, const State& state);

/// The one drag rate gamma = c / m of all free particles (1/s), 0 without drag, or nothing when they differ.
std::optional<double> uniform_drag_rate(const Model& model);

}  // namespace crosscheck
