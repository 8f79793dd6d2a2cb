// The tables of experiment `order`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A method at one step.
struct OrderRow {
  std::string scene, method;
  double step = 0;
  std::optional<double> error = {}, distance_to_finest = {};
  std::string truth;
  Tier truth_tier = Tier::exact;
  double truth_bar = 0;
  long evaluations = 0;
  Verdict verdict = Verdict::ok;

  static constexpr std::string_view table = "order";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &OrderRow::scene, "scene"), column("method", "1", &OrderRow::method, "method that was run"),
        column("step", "s", &OrderRow::step, "time step taken"),
        column("error", "m", &OrderRow::error, "largest RMS distance from the truth in the window"),
        column("distance to own finest", "m", &OrderRow::distance_to_finest,
               "the same from the method's own run at its shortest step"),
        column("truth", "1", &OrderRow::truth, "how the truth was found"),
        column("truth tier", "1", &OrderRow::truth_tier, "how sure the truth is"),
        column("truth bar", "m", &OrderRow::truth_bar, "error bar of the truth"),
        column("evaluations", "1", &OrderRow::evaluations, "evaluations of the forces"),
        column("verdict", "1", &OrderRow::verdict, "how the run ended");
  };
};

/// The slope of the error where it is a power of the step.
struct OrderSlopeRow {
  std::string scene, method;
  std::optional<long> declared_order;
  double measured_order = 0, from_step = 0, to_step = 0;

  static constexpr std::string_view table = "order-slopes";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &OrderSlopeRow::scene, "scene"),
        column("method", "1", &OrderSlopeRow::method, "method that was run"),
        column("declared order", "1", &OrderSlopeRow::declared_order,
               "order of the rule; empty where the rule is unknown"),
        column("measured order", "1", &OrderSlopeRow::measured_order,
               "slope of the error over the step, both in logarithms, where it is steady"),
        column("from step", "s", &OrderSlopeRow::from_step, "longest step of the slope"),
        column("to step", "s", &OrderSlopeRow::to_step, "shortest step of the slope");
  };
};

}  // namespace crosscheck
