// SUNDIALS ARKODE: explicit Runge-Kutta rules under error control.
#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <limits>

#include "mysim/errors.h"
#include "mysim/march_adaptively.h"
#include "reference/independent/integrators.h"
#include "reference/independent/sundials_world.h"

namespace crosscheck {
namespace {

class ArkodeWorld : public SundialsWorld {
 public:
  ArkodeWorld(ARKODE_ERKTableID rule, const Scene& scene, const Run& run)
      : SundialsWorld(scene, run), memory_(ERKStepCreate(rate, 0, now(), context())) {
    if (!memory_) throw SolverFailure("SUNDIALS: no memory");
    require(ERKStepSetUserData(memory_.get(), static_cast<SundialsWorld*>(this)), "ERKStepSetUserData");
    // what fails is reported by what is thrown, not by lines on stderr
    require(ERKStepSetErrFile(memory_.get(), nullptr), "ERKStepSetErrFile");
    require(ERKStepSetTableNum(memory_.get(), rule), "ERKStepSetTableNum");
    require(ERKStepSStolerances(memory_.get(), run.tolerance, run.tolerance * scene.size()), "ERKStepSStolerances");
    require(ERKStepSetMaxNumSteps(memory_.get(), std::numeric_limits<long>::max()), "ERKStepSetMaxNumSteps");
    // where a motion's third derivative jumps, more than the default of 7 attempts in a row may fail
    require(ERKStepSetMaxErrTestFails(memory_.get(), 100), "ERKStepSetMaxErrTestFails");
    require(ERKStepSetInitStep(memory_.get(), std::min(run.step, run.duration) / 10), "ERKStepSetInitStep");
  }

  long accepted() const override {
    long steps = 0;
    require(ERKStepGetNumSteps(memory_.get(), &steps), "ERKStepGetNumSteps");
    return steps;
  }

 private:
  int advance(double stop, double& t) override {
    require(ERKStepSetStopTime(memory_.get(), stop), "ERKStepSetStopTime");
    return ERKStepEvolve(memory_.get(), stop, now(), &t, ARK_ONE_STEP);
  }
  int look_back(double t, N_Vector out) override { return ERKStepGetDky(memory_.get(), t, 0, out); }

  struct FreeMemory {
    void operator()(void* m) const { ERKStepFree(&m); }
  };
  std::unique_ptr<void, FreeMemory> memory_;
};

Outcome run_table(ARKODE_ERKTableID rule, const Scene& scene, const Run& run, Observer& observer) {
  ArkodeWorld world(rule, scene, run);
  return march_adaptively(world, run, observer);
}

}  // namespace

Outcome run_arkode(const Scene& scene, const Run& run, Observer& observer) {
  return run_table(ARKODE_FEHLBERG_13_7_8, scene, run, observer);
}

Outcome run_arkode_order4(const Scene& scene, const Run& run, Observer& observer) {
  return run_table(ARKODE_ZONNEVELD_5_3_4, scene, run, observer);
}

}  // namespace crosscheck
