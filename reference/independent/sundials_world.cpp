// SUNDIALS' vectors and the right-hand side that is written apart.
#include "reference/independent/sundials_world.h"

#include <fmt/format.h>
#include <sundials/sundials_config.h>

#include <algorithm>
#include <cmath>

#include "mysim/errors.h"
#include "reference/independent/integrators.h"

namespace crosscheck {

void require(int flag, const char* what) {
  if (flag < 0) throw SolverFailure(fmt::format("SUNDIALS: {} returned {}", what, flag));
}

SundialsWorld::SundialsWorld(const Scene& scene, const Run& run)
    : f_(scene), y_(f_.start()), rate_(y_.size()), seen_(scene.start), interval_(run.duration / run.samples) {
  SUNContext context = nullptr;
  require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
  context_.reset(context);
  now_.reset(N_VNew_Serial(static_cast<sunindextype>(y_.size()), context));
  std::copy(y_.begin(), y_.end(), N_VGetArrayPointer(now_.get()));
  asked_.reset(N_VClone(now_.get()));
}

void SundialsWorld::step(double, double t_next) {
  while (t_ < t_next) {
    const double sample = interval_ * std::ceil(t_next / interval_ * (1 - 1e-12));
    const int flag = advance(std::max(sample, t_next), t_);
    if (thrown_) std::rethrow_exception(thrown_);
    require(flag, "the integrator");
  }
}

const State& SundialsWorld::state(double t) {
  N_Vector from = now();
  if (t < t_) {
    require(look_back(t, asked_.get()), "the interpolant");
    from = asked_.get();
  }
  const double* values = N_VGetArrayPointer(from);
  y_.assign(values, values + y_.size());
  f_.write(y_, t, seen_);
  return seen_;
}

int SundialsWorld::rate(realtype t, N_Vector y, N_Vector out, void* self) {
  auto& world = *static_cast<SundialsWorld*>(self);
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

std::optional<std::string> sundials_version() { return SUNDIALS_VERSION; }

}  // namespace crosscheck
