#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

struct OrderRow {
  TABLE("order");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(double, step, "step", "s", "time step taken");
  COLUMN(OptionalNumber, error, "error", "m", "largest RMS distance from the truth in the window");
  COLUMN(OptionalNumber, distance_to_finest, "distance to own finest", "m",
         "largest RMS distance from the method's own run at its shortest step, in the window");
  COLUMN(std::string, truth, "truth", "1", "origin of the truth");
  COLUMN(Tier, truth_tier, "truth tier", "1", "tier of the truth");
  COLUMN(double, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
};

struct OrderSlopeRow {
  TABLE("order-slopes");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, method, "method", "1", "method that was run");
  COLUMN(std::optional<long>, declared_order, "declared order", "1", "order of the rule; empty if the rule is unknown");
  COLUMN(double, measured_order, "measured order", "1",
         "slope of the error over the step in logarithmic scales, in the range where it is steady");
  COLUMN(double, from_step, "from step", "s", "longest step of the slope");
  COLUMN(double, to_step, "to step", "s", "shortest step of the slope");
};

}  // namespace crosscheck
