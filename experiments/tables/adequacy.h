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
inline constexpr std::pair range_of<ModelKind>{ModelKind::full, ModelKind::cumulative};

/// The kind of a tolerance.
enum class ToleranceKind { of_scene, hundredth_of_motion, tenth_of_motion };
constexpr std::string_view name_of(ToleranceKind kind) {
  return kind == ToleranceKind::of_scene              ? "the scene's own"
         : kind == ToleranceKind::hundredth_of_motion ? "1 % of its motion"
                                                      : "10 % of its motion";
}
template <>
inline constexpr std::pair range_of<ToleranceKind>{ToleranceKind::of_scene, ToleranceKind::tenth_of_motion};

/// A quantity that follows a power of the number of cells.
enum class ScalingQuantity { error, stiffness_for_sag, bend_stiffness_for_droop };
constexpr std::string_view name_of(ScalingQuantity quantity) {
  return quantity == ScalingQuantity::error               ? "error of the motion against cells along a side"
         : quantity == ScalingQuantity::stiffness_for_sag ? "stiffness of all springs for the same sag"
                                                          : "stiffness of bend springs for the same droop";
}
template <>
inline constexpr std::pair range_of<ScalingQuantity>{ScalingQuantity::error, ScalingQuantity::bend_stiffness_for_droop};

/// A model of a scene without some of its ingredients.
struct AdequacyRow {
  TABLE("adequacy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, model, "rung", "1", "name of the model");
  COLUMN(std::string, left_out, "left out", "1", "ingredients that it lacks, with commas between");
  COLUMN(ModelKind, kind, "kind", "1", "whether one ingredient is left out, or this one after those before it");
  COLUMN(OptionalNumber, error, "error", "m",
         "largest RMS distance from the truth of the full scene in the window; empty where the run failed");
  COLUMN(double, tolerance, "tolerance", "m", "tolerance of the scene");
  COLUMN(bool, within, "within", "1", "1 where the error is within the tolerance");
  COLUMN(double, motion, "motion", "m", "largest RMS distance of the particles from their start");
  COLUMN(double, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(std::string, truth, "truth", "1", "how sure the truth is");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(long, evaluations, "evaluations", "1", "evaluations of the forces");
  COLUMN(long, springs, "springs", "1", "springs of the model");
  COLUMN(double, cost, "cost", "spring evaluations", "evaluations times springs");
};

/// The least model of a scene within a tolerance.
struct LeastModelRow {
  TABLE("adequacy-least");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, tolerance, "tolerance", "m", "tolerance that is asked for");
  COLUMN(ToleranceKind, tolerance_is, "tolerance is", "1", "what that tolerance is");
  COLUMN(std::string, least_model, "least model", "1", "name of the model that leaves out most within the tolerance");
  COLUMN(std::string, left_out, "left out", "1", "ingredients that it lacks, with commas between");
  COLUMN(OptionalNumber, error, "error", "m", "its error");
  COLUMN(OptionalNumber, unseen_error_1, "unseen error 1", "m",
         "its distance from the full model from start 1 that it has not seen; of the full model: the least error of "
         "any removal");
  COLUMN(OptionalNumber, unseen_error_2, "unseen error 2", "m",
         "its distance from the full model from start 2 that it has not seen; of the full model: the least error of "
         "any removal");
  COLUMN(OptionalNumber, unseen_error_3, "unseen error 3", "m",
         "its distance from the full model from start 3 that it has not seen; of the full model: the least error of "
         "any removal");
  COLUMN(bool, holds, "holds", "1", "1 where it is the least model from all these starts too");
  COLUMN(double, cost_of_full, "cost of full", "1", "its cost over that of the full model");
};

/// A cloth on one grid.
struct GridRow {
  TABLE("adequacy-resolution");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(long, particles, "particles along a side", "1", "particles along the longer side");
  COLUMN(double, cells, "cells", "1", "cells along that side");
  COLUMN(OptionalNumber, error, "error against the finest", "m",
         "largest RMS distance from the finest grid in the window");
  COLUMN(OptionalNumber, sag, "sag", "m", "how far the lowest point hangs below the highest one at rest");
  COLUMN(OptionalNumber, stiffness_factor, "stiffness factor for the finest's sag", "1",
         "what all stiffnesses are to be multiplied by to sag as the finest grid does");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(long, evaluations, "evaluations", "1", "evaluations of the forces");
  COLUMN(long, springs, "springs", "1", "springs of the model");
  COLUMN(double, cost, "cost", "spring evaluations", "evaluations times springs");
};

/// A clamped line of a cloth on one grid.
struct BendingRow {
  TABLE("adequacy-bending");
  COLUMN(long, particles, "particles along a line", "1", "particles along the line");
  COLUMN(double, cells, "cells", "1", "cells in its free length");
  COLUMN(double, stiffness, "stiffness of bend springs", "N/m", "stiffness at which it droops as on the coarsest grid");
  COLUMN(double, droop, "droop", "m", "how far its free end hangs down");
};

/// A power of the number of cells.
struct ScalingRow {
  TABLE("adequacy-scaling");
  COLUMN(std::string, scene, "scene", "1", "scene; empty of the clamped line");
  COLUMN(ScalingQuantity, quantity, "quantity", "1", "what follows a power of the number of cells");
  COLUMN(double, exponent, "exponent", "1", "that power, by least squares in the logarithms");
  COLUMN(double, standard_error, "standard error", "1", "of the exponent");
  COLUMN(OptionalNumber, derived, "derived", "1", "the exponent that is derived for many cells");
};

}  // namespace crosscheck
