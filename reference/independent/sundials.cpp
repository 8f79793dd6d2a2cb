// SUNDIALS ARKODE behind the run loop that all engines share.
#include <arkode/arkode_erkstep.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>

#include "mysim/errors.h"
#include "mysim/march_adaptively.h"
#include "reference/independent/integrators.h"
#include "reference/independent/right_hand_side.h"

namespace crosscheck {
namespace {

void require(int flag, const char* what) {
  if (flag < 0) throw SolverFailure(fmt::format("SUNDIALS: {} returned {}", what, flag));
}

class ArkodeWorld : public World {
 public:
  ArkodeWorld(const Scene& scene, const Run& run)
      : f_(scene), y_(f_.start()), rate_(y_.size()), seen_(scene.start), interval_(run.duration / run.samples) {
    SUNContext context = nullptr;
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    context_.reset(context);
    // what fails is reported by what is thrown, not by lines on stderr
    now_.reset(N_VNew_Serial(static_cast<sunindextype>(y_.size()), context));
    std::copy(y_.begin(), y_.end(), N_VGetArrayPointer(now_.get()));
    asked_.reset(N_VClone(now_.get()));
    memory_.reset(ERKStepCreate(rate, 0, now_.get(), context));
    if (!memory_) throw SolverFailure("SUNDIALS: no memory");
    require(ERKStepSetUserData(memory_.get(), this), "ERKStepSetUserData");
    require(ERKStepSetErrFile(memory_.get(), nullptr), "ERKStepSetErrFile");
    require(ERKStepSetTableNum(memory_.get(), ARKODE_FEHLBERG_13_7_8), "ERKStepSetTableNum");
    require(ERKStepSStolerances(memory_.get(), run.tolerance, run.tolerance * scene.size()), "ERKStepSStolerances");
    require(ERKStepSetMaxNumSteps(memory_.get(), std::numeric_limits<long>::max()), "ERKStepSetMaxNumSteps");
    // where a motion's third derivative jumps, more than the default of 7 attempts in a row may fail
    require(ERKStepSetMaxErrTestFails(memory_.get(), 100), "ERKStepSetMaxErrTestFails");
    require(ERKStepSetInitStep(memory_.get(), std::min(run.step, run.duration) / 10), "ERKStepSetInitStep");
  }

  /// One step after the other, ending at samples; between samples the interpolant answers.
  void step(double, double t_next) override {
    while (t_ < t_next) {
      const double sample = interval_ * std::ceil(t_next / interval_ * (1 - 1e-12));
      require(ERKStepSetStopTime(memory_.get(), std::max(sample, t_next)), "ERKStepSetStopTime");
      const int flag = ERKStepEvolve(memory_.get(), std::max(sample, t_next), now_.get(), &t_, ARK_ONE_STEP);
      if (thrown_) std::rethrow_exception(thrown_);
      require(flag, "ERKStepEvolve");
    }
  }

  const State& state(double t) override {
    N_Vector from = now_.get();
    if (t < t_) {
      require(ERKStepGetDky(memory_.get(), t, 0, asked_.get()), "ERKStepGetDky");
      from = asked_.get();
    }
    const double* values = N_VGetArrayPointer(from);
    y_.assign(values, values + y_.size());
    f_.write(y_, t, seen_);
    return seen_;
  }

  const RightHandSide& right_hand_side() const { return f_; }
  long accepted() const {
    long steps = 0;
    require(ERKStepGetNumSteps(memory_.get(), &steps), "ERKStepGetNumSteps");
    return steps;
  }

 private:
  static int rate(realtype t, N_Vector y, N_Vector out, void* self) {
    auto& world = *static_cast<ArkodeWorld*>(self);
    const double* values = N_VGetArrayPointer(y);
    std::copy(values, values + world.y_.size(), world.y_.begin());
    try {
      world.f_(world.y_, world.rate_, t);
    } catch (...) {
      world.thrown_ = std::current_exception();  // C code lies between here and who can handle it
      return -1;
    }
    std::copy(world.rate_.begin(), world.rate_.end(), N_VGetArrayPointer(out));
    return 0;
  }

  struct FreeContext {
    void operator()(SUNContext c) const { SUNContext_Free(&c); }
  };
  struct FreeVector {
    void operator()(N_Vector v) const { N_VDestroy(v); }
  };
  struct FreeMemory {
    void operator()(void* m) const { ERKStepFree(&m); }
  };

  RightHandSide f_;
  Flat y_, rate_;
  State seen_;
  double interval_, t_ = 0;  // s, between samples; reached
  std::exception_ptr thrown_;
  // freed in the opposite order
  std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext> context_;
  std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector> now_, asked_;
  std::unique_ptr<void, FreeMemory> memory_;
};

}  // namespace

Outcome run_arkode(const Scene& scene, const Run& run, Observer& observer) {
  ArkodeWorld world(scene, run);
  return march_adaptively(world, run, observer);
}

std::optional<std::string> sundials_version() { return SUNDIALS_VERSION; }

}  // namespace crosscheck
