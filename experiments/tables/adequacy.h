// The tables of experiment `adequacy`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A model with all its ingredients, without a single one, or without this one and all before it in the ablation.
enum class ModelKind { full, single, cumulative };
constexpr std::string_view name_of(ModelKind kind) {
  return kind == ModelKind::full ? "full" : kind == ModelKind::single ? "single" : "cumulative";
}
template <>
struct EnumRange<ModelKind> {
  static constexpr ModelKind first = ModelKind::full, last = ModelKind::cumulative;
};

/// The kind of a tolerance.
enum class ToleranceKind { of_scene, hundredth_of_motion, tenth_of_motion };
constexpr std::string_view name_of(ToleranceKind kind) {
  return kind == ToleranceKind::of_scene              ? "the scene's own"
         : kind == ToleranceKind::hundredth_of_motion ? "1 % of its motion"
                                                      : "10 % of its motion";
}
template <>
struct EnumRange<ToleranceKind> {
  static constexpr ToleranceKind first = ToleranceKind::of_scene, last = ToleranceKind::tenth_of_motion;
};

/// A quantity that follows a power of the number of cells.
enum class ScalingQuantity { error, stiffness_for_sag, bend_stiffness_for_droop };
constexpr std::string_view name_of(ScalingQuantity quantity) {
  return quantity == ScalingQuantity::error               ? "error of the motion against cells along a side"
         : quantity == ScalingQuantity::stiffness_for_sag ? "stiffness of all springs for the same sag"
                                                          : "stiffness of bend springs for the same droop";
}
template <>
struct EnumRange<ScalingQuantity> {
  static constexpr ScalingQuantity first = ScalingQuantity::error, last = ScalingQuantity::bend_stiffness_for_droop;
};

/// A model of a scene without some of its ingredients.
struct AdequacyRow {
  std::string scene, model, left_out;
  ModelKind kind = ModelKind::full;
  std::optional<double> error = {};
  double tolerance = 0;
  bool within = false;
  double motion = 0, truth_bar = 0;
  std::string truth;
  Verdict verdict = Verdict::ok;
  long evaluations = 0, springs = 0;
  double cost = 0;

  static constexpr std::string_view table = "adequacy";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &AdequacyRow::scene, "scene"), column("rung", "1", &AdequacyRow::model, "name of the model"),
        column("left out", "1", &AdequacyRow::left_out, "ingredients that it lacks, with commas between"),
        column("kind", "1", &AdequacyRow::kind,
               "whether one ingredient is left out, or this one after those before it"),
        column("error", "m", &AdequacyRow::error,
               "largest RMS distance from the truth of the full scene in the window; empty where the run failed"),
        column("tolerance", "m", &AdequacyRow::tolerance, "tolerance of the scene"),
        column("within", "1", &AdequacyRow::within, "1 where the error is within the tolerance"),
        column("motion", "m", &AdequacyRow::motion, "largest RMS distance of the particles from their start"),
        column("truth bar", "m", &AdequacyRow::truth_bar, "error bar of the truth"),
        column("truth", "1", &AdequacyRow::truth, "how sure the truth is"),
        column("verdict", "1", &AdequacyRow::verdict, "how the run ended"),
        column("evaluations", "1", &AdequacyRow::evaluations, "evaluations of the forces"),
        column("springs", "1", &AdequacyRow::springs, "springs of the model"),
        column("cost", "spring evaluations", &AdequacyRow::cost, "evaluations times springs");
  };
};

/// The least model of a scene within a tolerance.
struct LeastModelRow {
  std::string scene;
  double tolerance = 0;
  ToleranceKind tolerance_is = ToleranceKind::of_scene;
  std::string least_model, left_out;
  std::optional<double> error = {}, unseen_error_1 = {}, unseen_error_2 = {}, unseen_error_3 = {};
  bool holds = false;
  double cost_of_full = 0;

  static constexpr std::string_view table = "adequacy-least";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &LeastModelRow::scene, "scene"),
        column("tolerance", "m", &LeastModelRow::tolerance, "tolerance that is asked for"),
        column("tolerance is", "1", &LeastModelRow::tolerance_is, "what that tolerance is"),
        column("least model", "1", &LeastModelRow::least_model,
               "name of the model that leaves out most within the tolerance"),
        column("left out", "1", &LeastModelRow::left_out, "ingredients that it lacks, with commas between"),
        column("error", "m", &LeastModelRow::error, "its error"),
        column("unseen error 1", "m", &LeastModelRow::unseen_error_1,
               "its distance from the full model from start 1 that it has not seen; of the full model: the "
               "least error of any removal"),
        column("unseen error 2", "m", &LeastModelRow::unseen_error_2,
               "its distance from the full model from start 2 that it has not seen; of the full model: the "
               "least error of any removal"),
        column("unseen error 3", "m", &LeastModelRow::unseen_error_3,
               "its distance from the full model from start 3 that it has not seen; of the full model: the "
               "least error of any removal"),
        column("holds", "1", &LeastModelRow::holds, "1 where it is the least model from all these starts too"),
        column("cost of full", "1", &LeastModelRow::cost_of_full, "its cost over that of the full model");
  };
};

/// A cloth on one grid.
struct GridRow {
  std::string scene;
  long particles = 0;
  double cells = 0;
  std::optional<double> error = {}, sag = {}, stiffness_factor = {};
  Verdict verdict = Verdict::ok;
  long evaluations = 0, springs = 0;
  double cost = 0;

  static constexpr std::string_view table = "adequacy-resolution";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &GridRow::scene, "scene"),
        column("particles along a side", "1", &GridRow::particles, "particles along the longer side"),
        column("cells", "1", &GridRow::cells, "cells along that side"),
        column("error against the finest", "m", &GridRow::error,
               "largest RMS distance from the finest grid in the window"),
        column("sag", "m", &GridRow::sag, "how far the lowest point hangs below the highest one at rest"),
        column("stiffness factor for the finest's sag", "1", &GridRow::stiffness_factor,
               "what all stiffnesses are to be multiplied by to sag as the finest grid does"),
        column("verdict", "1", &GridRow::verdict, "how the run ended"),
        column("evaluations", "1", &GridRow::evaluations, "evaluations of the forces"),
        column("springs", "1", &GridRow::springs, "springs of the model"),
        column("cost", "spring evaluations", &GridRow::cost, "evaluations times springs");
  };
};

/// A clamped line of a cloth on one grid.
struct BendingRow {
  long particles = 0;
  double cells = 0, stiffness = 0, droop = 0;

  static constexpr std::string_view table = "adequacy-bending";
  static constexpr auto columns = [](auto&& column) {
    column("particles along a line", "1", &BendingRow::particles, "particles along the line"),
        column("cells", "1", &BendingRow::cells, "cells in its free length"),
        column("stiffness of bend springs", "N/m", &BendingRow::stiffness,
               "stiffness at which it droops as on the coarsest grid"),
        column("droop", "m", &BendingRow::droop, "how far its free end hangs down");
  };
};

/// A power of the number of cells.
struct ScalingRow {
  std::string scene;
  ScalingQuantity quantity = ScalingQuantity::error;
  double exponent = 0, standard_error = 0;
  std::optional<double> derived = {};

  static constexpr std::string_view table = "adequacy-scaling";
  static constexpr auto columns = [](auto&& column) {
    column("scene", "1", &ScalingRow::scene, "scene; empty of the clamped line"),
        column("quantity", "1", &ScalingRow::quantity, "what follows a power of the number of cells"),
        column("exponent", "1", &ScalingRow::exponent, "that power, by least squares in the logarithms"),
        column("standard error", "1", &ScalingRow::standard_error, "of the exponent"),
        column("derived", "1", &ScalingRow::derived, "the exponent that is derived for many cells");
  };
};

}  // namespace crosscheck
