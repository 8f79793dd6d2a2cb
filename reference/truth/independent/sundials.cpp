// SUNDIALS' ARKODE and CVODE on the independent right-hand side.
#include "reference/truth/independent/sundials.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <sundials/sundials_config.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mysim/base/errors.h"
#include "mysim/run/engine.h"
#include "reference/truth/independent/integrators.h"

namespace crosscheck {

void check_flag(int flag, const char* what) {
  if (flag < 0) throw SolverFailure(fmt::format("SUNDIALS: {} returned {}", what, flag));
}

SundialsWorld::SundialsWorld(const Scene& scene, const Run& run)
    : f_(scene, velocity_time_unit(scene)),
      y_(f_.start()),
      rate_(y_.size()),
      state_(scene.start),
      interval_(run.duration / run.samples) {
  SUNContext context = nullptr;
  check_flag(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  context_.reset(context);
  solution_.reset(N_VNew_Serial(static_cast<sunindextype>(y_.size()), context));
  std::copy(y_.begin(), y_.end(), N_VGetArrayPointer(solution_.get()));
  interpolant_.reset(N_VClone(solution_.get()));
}

void SundialsWorld::step(double, double t_next) {
  while (t_ < t_next) {
    const double sample = interval_ * std::ceil(t_next / interval_ * (1 - 1e-12));
    const int flag = one_step(std::max(sample, t_next), t_);
    if (thrown_) std::rethrow_exception(thrown_);
    check_flag(flag, "the integrator");
  }
}

const State& SundialsWorld::state(double t) {
  N_Vector from = solution();
  if (t < t_) {
    check_flag(interpolate(t, interpolant_.get()), "the interpolant");
    from = interpolant_.get();
  }
  const double* values = N_VGetArrayPointer(from);
  y_.assign(values, values + y_.size());
  f_.write_state(y_, t, state_);
  return state_;
}

int SundialsWorld::rate(realtype t, N_Vector y, N_Vector out, void* self) {
  auto& world = *static_cast<SundialsWorld*>(self);
  const double* values = N_VGetArrayPointer(y);
  std::copy(values, values + world.y_.size(), world.y_.begin());
  try {
    world.f_(world.y_, world.rate_, t);
  } catch (...) {
    world.thrown_ = std::current_exception();  // C code lies between here and the handler
    return -1;
  }
  std::copy(world.rate_.begin(), world.rate_.end(), N_VGetArrayPointer(out));
  return 0;
}

std::optional<std::string> sundials_version() { return SUNDIALS_VERSION; }

namespace {

class ArkodeWorld : public SundialsWorld {
 public:
  ArkodeWorld(ARKODE_ERKTableID rule, const Scene& scene, const Run& run)
      : SundialsWorld(scene, run), memory_(ERKStepCreate(rate, 0, solution(), context())) {
    if (!memory_) throw SolverFailure("SUNDIALS: no memory");
    check_flag(ERKStepSetUserData(memory_.get(), static_cast<SundialsWorld*>(this)), "ERKStepSetUserData");
    // errors become exceptions, not lines on stderr
    check_flag(ERKStepSetErrFile(memory_.get(), nullptr), "ERKStepSetErrFile");
    check_flag(ERKStepSetTableNum(memory_.get(), rule), "ERKStepSetTableNum");
    check_flag(ERKStepSStolerances(memory_.get(), run.tolerance, run.tolerance * scene.size()), "ERKStepSStolerances");
    check_flag(ERKStepSetMaxNumSteps(memory_.get(), std::numeric_limits<long>::max()), "ERKStepSetMaxNumSteps");
    // more than the default of 7 attempts may fail at a jump of a motion's third derivative
    check_flag(ERKStepSetMaxErrTestFails(memory_.get(), 100), "ERKStepSetMaxErrTestFails");
    check_flag(ERKStepSetInitStep(memory_.get(), std::min(run.step, run.duration) / 10), "ERKStepSetInitStep");
  }

 private:
  long accepted() const override {
    long steps = 0;
    check_flag(ERKStepGetNumSteps(memory_.get(), &steps), "ERKStepGetNumSteps");
    return steps;
  }
  int one_step(double stop, double& t) override {
    check_flag(ERKStepSetStopTime(memory_.get(), stop), "ERKStepSetStopTime");
    return ERKStepEvolve(memory_.get(), stop, solution(), &t, ARK_ONE_STEP);
  }
  int interpolate(double t, N_Vector out) override { return ERKStepGetDky(memory_.get(), t, 0, out); }

  struct FreeMemory {
    void operator()(void* m) const { ERKStepFree(&m); }
  };
  std::unique_ptr<void, FreeMemory> memory_;
};

Outcome run_table(ARKODE_ERKTableID rule, const Scene& scene, const Run& run, Observer& observer) {
  ArkodeWorld world(rule, scene, run);
  return run_loop(world, run, observer);
}

}  // namespace

Outcome run_arkode(const Scene& scene, const Run& run, Observer& observer) {
  return run_table(ARKODE_FEHLBERG_13_7_8, scene, run, observer);
}

Outcome run_arkode_order4(const Scene& scene, const Run& run, Observer& observer) {
  return run_table(ARKODE_ZONNEVELD_5_3_4, scene, run, observer);
}

// SUNDIALS CVODE: Adams' formulas of varying order, solved by Newton's method with GMRES on difference quotients. On a
// cloth of 32 x 32 particles over 1 s, this is the best combination found for CVODE: it needs 2.6 s of CPU time for an
// error of 5e-6 m. Adams' formulas with fixed-point iteration take 4.5 s for 1e-5 m, backward differentiation with
// GMRES 4.3 s for 3e-5 m.

namespace {

class CvodeWorld : public SundialsWorld {
 public:
  CvodeWorld(const Scene& scene, const Run& run)
      : SundialsWorld(scene, run),
        solver_(SUNLinSol_SPGMR(solution(), SUN_PREC_NONE, 0, context())),  // 0: default number of directions
        memory_(CVodeCreate(CV_ADAMS, context())) {
    if (!memory_ || !solver_) throw SolverFailure("SUNDIALS: no memory");
    check_flag(CVodeInit(memory_.get(), rate, 0, solution()), "CVodeInit");
    check_flag(CVodeSetUserData(memory_.get(), static_cast<SundialsWorld*>(this)), "CVodeSetUserData");
    check_flag(CVodeSetErrFile(memory_.get(), nullptr), "CVodeSetErrFile");
    check_flag(CVodeSetLinearSolver(memory_.get(), solver_.get(), nullptr), "CVodeSetLinearSolver");
    check_flag(CVodeSStolerances(memory_.get(), run.tolerance, run.tolerance * scene.size()), "CVodeSStolerances");
    check_flag(CVodeSetMaxNumSteps(memory_.get(), std::numeric_limits<long>::max()), "CVodeSetMaxNumSteps");
    check_flag(CVodeSetMaxErrTestFails(memory_.get(), 100), "CVodeSetMaxErrTestFails");
    check_flag(CVodeSetInitStep(memory_.get(), std::min(run.step, run.duration) / 10), "CVodeSetInitStep");
  }

 private:
  long accepted() const override {
    long steps = 0;
    check_flag(CVodeGetNumSteps(memory_.get(), &steps), "CVodeGetNumSteps");
    return steps;
  }
  int one_step(double stop, double& t) override {
    check_flag(CVodeSetStopTime(memory_.get(), stop), "CVodeSetStopTime");
    return CVode(memory_.get(), stop, solution(), &t, CV_ONE_STEP);
  }
  int interpolate(double t, N_Vector out) override { return CVodeGetDky(memory_.get(), t, 0, out); }

  struct FreeSolver {
    void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
  };
  struct FreeMemory {
    void operator()(void* m) const { CVodeFree(&m); }
  };
  // freed in reverse order
  std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver> solver_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

Outcome run_cvode(const Scene& scene, const Run& run, Observer& observer) {
  CvodeWorld world(scene, run);
  return run_loop(world, run, observer);
}

}  // namespace crosscheck
