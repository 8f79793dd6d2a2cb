// A method that refuses some steps, as Bullet's clamped world does.
#pragma once

#include "mysim/errors.h"
#include "reference/method.h"

namespace crosscheck::testing_tools {

/// Leapfrog that does not take longer steps.
inline Method refusing_above(double step) {
  Method method = find_method("leapfrog");
  method.engine = [inner = method.engine, step](const Scene& scene, const crosscheck::Run& run, Observer& observer) {
    if (plan(run).h > step) throw Unsupported("too long");
    return inner(scene, run, observer);
  };
  return method;
}

}  // namespace crosscheck::testing_tools
