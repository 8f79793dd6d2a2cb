// SUNDIALS CVODE: Adams' formulas of varying order, their equations solved by Newton's method with GMRES on difference
// quotients. The best that was found for it on a sheet of 32 x 32 particles and 1 s: 2.6 s of CPU time for an error of
// 5e-6 m; Adams' formulas iterated to a fixed point take 4.5 s for 1e-5 m, backward differentiation with GMRES 4.3 s
// for 3e-5 m.
#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <limits>

#include "mysim/errors.h"
#include "mysim/march_adaptively.h"
#include "reference/independent/integrators.h"
#include "reference/independent/sundials_world.h"

namespace crosscheck {
namespace {

class CvodeWorld : public SundialsWorld {
 public:
  CvodeWorld(const Scene& scene, const Run& run)
      : SundialsWorld(scene, run),
        solver_(SUNLinSol_SPGMR(now(), SUN_PREC_NONE, 0, context())),  // 0: as many directions as by default
        memory_(CVodeCreate(CV_ADAMS, context())) {
    if (!memory_ || !solver_) throw SolverFailure("SUNDIALS: no memory");
    require(CVodeInit(memory_.get(), rate, 0, now()), "CVodeInit");
    require(CVodeSetUserData(memory_.get(), static_cast<SundialsWorld*>(this)), "CVodeSetUserData");
    // what fails is reported by what is thrown, not by lines on stderr
    require(CVodeSetErrFile(memory_.get(), nullptr), "CVodeSetErrFile");
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), nullptr), "CVodeSetLinearSolver");
    require(CVodeSStolerances(memory_.get(), run.tolerance, run.tolerance * scene.size()), "CVodeSStolerances");
    require(CVodeSetMaxNumSteps(memory_.get(), std::numeric_limits<long>::max()), "CVodeSetMaxNumSteps");
    // where a motion's third derivative jumps, more than the default of 7 attempts in a row may fail
    require(CVodeSetMaxErrTestFails(memory_.get(), 100), "CVodeSetMaxErrTestFails");
    require(CVodeSetInitStep(memory_.get(), std::min(run.step, run.duration) / 10), "CVodeSetInitStep");
  }

  long accepted() const override {
    long steps = 0;
    require(CVodeGetNumSteps(memory_.get(), &steps), "CVodeGetNumSteps");
    return steps;
  }

 private:
  int advance(double stop, double& t) override {
    require(CVodeSetStopTime(memory_.get(), stop), "CVodeSetStopTime");
    return CVode(memory_.get(), stop, now(), &t, CV_ONE_STEP);
  }
  int look_back(double t, N_Vector out) override { return CVodeGetDky(memory_.get(), t, 0, out); }

  struct FreeSolver {
    void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
  };
  struct FreeMemory {
    void operator()(void* m) const { CVodeFree(&m); }
  };
  // freed in the opposite order
  std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeSolver> solver_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

Outcome run_cvode(const Scene& scene, const Run& run, Observer& observer) {
  CvodeWorld world(scene, run);
  return march_adaptively(world, run, observer);
}

}  // namespace crosscheck
