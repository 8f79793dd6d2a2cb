// Two functions of the table in quantities.cpp, declared for their tests.
#pragma once

#include "experiments/regress/cases.h"
#include "reference/truth/truth.h"

namespace crosscheck {

struct Observation {
  const Case& test_case;
  const CaseRun& case_run;
  const Scene& scene() const { return test_case.scene; }
  const Trajectory& path() const { return case_run.trajectory; }
};
using Quantities = std::vector<Quantity>;

/// For runs that come to rest: the last time at which the kinetic energy falls below a hundredth of its maximum.
void settle_time(const Observation& seen, Quantities& out);

/// For a particle that starts on a ball: the angle from the top at which it first rises 1 mm above the contact surface,
/// in degrees.
void leaving_angle(const Observation& seen, Quantities& out);

}  // namespace crosscheck
