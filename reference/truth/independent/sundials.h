// SUNDIALS' integrators on the scene's equations, behind the run loop of all engines.
#pragma once

#include <nvector/nvector_serial.h>

#include <exception>
#include <memory>

#include "mysim/run/engine.h"
#include "reference/truth/independent/right_hand_side.h"

namespace crosscheck {

/// Throws SolverFailure with the call's name if SUNDIALS returned an error.
void check_flag(int flag, const char* what);

/// A derived class creates the integrator on `solution()`, with `rate` as its function and `this` as a SundialsWorld*
/// as its user data.
class SundialsWorld : public World {
 public:
  SundialsWorld(const Scene& scene, const Run& run);

  /// The integrator's steps end at samples; between samples its interpolant gives the state.
  void step(double, double t_next) override;
  const State& state(double t) override;

  Work work() const override { return {f_.evaluations(), f_.degenerate_springs(), accepted()}; }
  bool chooses_steps() const override { return true; }

 protected:
  SUNContext context() const { return context_.get(); }
  N_Vector solution() const { return solution_.get(); }
  static int rate(realtype t, N_Vector y, N_Vector out, void* self);

 private:
  /// Takes one step, until `stop` (s) at the latest, and sets t; returns SUNDIALS' flag.
  virtual int one_step(double stop, double& t) = 0;
  virtual long accepted() const = 0;  // steps
  /// Evaluates the interpolant at a time within the last step.
  virtual int interpolate(double t, N_Vector out) = 0;

  struct FreeContext {
    void operator()(SUNContext c) const { SUNContext_Free(&c); }
  };
  struct FreeVector {
    void operator()(N_Vector v) const { N_VDestroy(v); }
  };

  RightHandSide f_;
  StateVector y_, rate_;
  State state_;
  double interval_, t_ = 0;  // s: interval between samples; time reached
  std::exception_ptr thrown_;
  // freed in reverse order
  std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext> context_;
  std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector> solution_, interpolant_;
};

}  // namespace crosscheck
