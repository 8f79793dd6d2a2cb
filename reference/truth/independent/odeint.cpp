// Boost's odeint, behind the run loop of all engines.

#include <fmt/format.h>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/version.hpp>

#include <algorithm>
#include <functional>

#include "mysim/base/errors.h"
#include "mysim/run/engine.h"
#include "reference/truth/independent/integrators.h"
#include "reference/truth/independent/right_hand_side.h"

namespace crosscheck {
namespace {

namespace odeint = boost::numeric::odeint;

class OdeintWorld : public World {
 public:
  OdeintWorld(const Scene& scene, double time_unit) : f_(scene, time_unit), y_(f_.start()), state_(scene.start) {}
  const State& state(double t) override {
    f_.write_state(y_, t, state_);
    return state_;
  }
  Work work() const override { return {f_.evaluations(), f_.degenerate_springs()}; }

 protected:
  RightHandSide f_;
  StateVector y_;
  State state_;
};

class AdaptiveOdeintWorld : public OdeintWorld {
 public:
  explicit AdaptiveOdeintWorld(const Scene& scene) : OdeintWorld(scene, velocity_time_unit(scene)) {}
  Work work() const override { return {f_.evaluations(), f_.degenerate_springs(), accepted_}; }
  bool chooses_steps() const override { return true; }

 protected:
  long accepted_ = 0;
};

class Rk4World : public OdeintWorld {
 public:
  explicit Rk4World(const Scene& scene) : OdeintWorld(scene, 1) {}
  void step(double t, double t_next) override { rule_.do_step(std::ref(f_), y_, t, t_next - t); }

 private:
  odeint::runge_kutta4<StateVector> rule_;
};

/// Throws SolverFailure if a step of h would be lost in the rounding of times up to t_next (s).
void require_progress(double t, double h, double t_next) {
  if (!(h > 1e-14 * t_next)) throw SolverFailure(fmt::format("the step fell below round-off at t = {:.4g} s", t));
}

class Dopri5World : public AdaptiveOdeintWorld {
 public:
  Dopri5World(const Scene& scene, const Run& run)
      : AdaptiveOdeintWorld(scene),
        rule_(odeint::make_dense_output(run.tolerance * scene.size(), run.tolerance,
                                        odeint::runge_kutta_dopri5<StateVector>())) {
    rule_.initialize(y_, 0.0, std::min(run.step, run.duration));
  }
  void step(double, double t_next) override {
    while (rule_.current_time() < t_next) {
      require_progress(rule_.current_time(), rule_.current_time_step(), t_next);
      try {
        rule_.do_step(std::ref(f_));
      } catch (const odeint::step_adjustment_error& e) {
        throw SolverFailure(e.what());
      }
      ++accepted_;
    }
  }
  const State& state(double t) override {
    if (accepted_ > 0) rule_.calc_state(t, y_);
    return OdeintWorld::state(t);
  }

 private:
  odeint::result_of::make_dense_output<odeint::runge_kutta_dopri5<StateVector>>::type rule_;
};

class BulirschStoerWorld : public AdaptiveOdeintWorld {
 public:
  BulirschStoerWorld(const Scene& scene, const Run& run)
      : AdaptiveOdeintWorld(scene),
        rule_(run.tolerance * scene.size(), run.tolerance),
        h_(std::min(run.step, run.duration)),
        ramp_end_(scene.model.particles.move ? scene.model.particles.move->ramp : 0) {}
  void step(double t, double t_next) override {
    // At the end of the ramp the third derivative of a moved pin jumps; a step that ends there keeps its order. If the
    // jump is within a sliver of a sample, the step ends at the sample, which changes positions by less than rounding.
    const double sliver = 1e-12 * t_next;
    if (t + sliver < ramp_end_ && ramp_end_ + sliver < t_next) {
      integrate_to(t, ramp_end_);
      t = ramp_end_;
    }
    integrate_to(t, t_next);
  }

 private:
  void integrate_to(double t, double t_next) {
    while (t < t_next) {
      // a step that would leave a sliver ends at t_next; a step that is cut short does not reduce the next proposal
      const bool last = t + 1.01 * h_ >= t_next;
      double h = last ? t_next - t : h_;
      const double tried = h;
      require_progress(t, h, t_next);
      if (rule_.try_step(std::ref(f_), y_, t, h) == odeint::success) {
        ++accepted_;
        h_ = last ? std::max(h_, h) : h;
        if (last) t = t_next;
      } else {
        h_ = std::min(h, 0.9 * tried);
      }
    }
  }

  odeint::bulirsch_stoer<StateVector> rule_;
  double h_;
  double ramp_end_;  // s
};

}  // namespace

Outcome run_odeint_rk4(const Scene& scene, const Run& run, Observer& observer) {
  Rk4World world(scene);
  return run_loop(world, run, observer);
}

Outcome run_odeint_dopri5(const Scene& scene, const Run& run, Observer& observer) {
  Dopri5World world(scene, run);
  return run_loop(world, run, observer);
}

Outcome run_odeint_bulirsch_stoer(const Scene& scene, const Run& run, Observer& observer) {
  BulirschStoerWorld world(scene, run);
  return run_loop(world, run, observer);
}

std::string odeint_version() { return fmt::format("{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000); }

}  // namespace crosscheck
