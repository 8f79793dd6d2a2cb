// The right-hand side f(X, t): all that a stepper sees of a scene. It counts its evaluations.
#pragma once

#include "mysim/model.h"

namespace crosscheck {

class System {
 public:
  explicit System(const Model& model);

  /// rate = dX/dt at the stage: x' = v and v' = F / m, or x' = f(x, t) in a first-order scene. Pins are first put where
  /// they are at stage.t (that is why the stage is not const); their v' is zero.
  void derivative(State& stage, State& rate);
  /// a = F / m with every force, the drag at stage.v included (3 x n, m/s^2; zero at pins). Moves pins like derivative.
  void acceleration(State& stage, Points& a);
  /// a = F / m without the drag, for steppers that treat drag by themselves with drag_rate().
  void undragged_acceleration(State& stage, Points& a);
  /// c_i / m_i of each particle (n, 1/s); zero without drag.
  const Eigen::ArrayXd& drag_rate() const { return drag_rate_; }

  const Model& model() const { return model_; }
  long evaluations() const { return evaluations_; }
  long coincident() const { return coincident_; }  // springs met at zero length, summed over all evaluations

 private:
  void accelerate(State& stage, Points& a, bool with_drag);

  const Model& model_;
  Forces forces_;
  Eigen::ArrayXd drag_rate_;
  long evaluations_ = 0, coincident_ = 0;
};

}  // namespace crosscheck
