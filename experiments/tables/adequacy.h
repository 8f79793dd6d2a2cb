#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A model is complete, lacks a single ingredient, or lacks an ingredient together with all those removed before it.
enum class ModelKind { full, single, cumulative };
constexpr std::string_view name_of(ModelKind kind) {
  return kind == ModelKind::full ? "full" : kind == ModelKind::single ? "single" : "cumulative";
}
template <>
inline constexpr std::pair range_of<ModelKind>{ModelKind::full, ModelKind::cumulative};

enum class ToleranceKind { of_scene, hundredth_of_motion, tenth_of_motion };
constexpr std::string_view name_of(ToleranceKind kind) {
  return kind == ToleranceKind::of_scene              ? "the scene's own"
         : kind == ToleranceKind::hundredth_of_motion ? "1 % of its motion"
                                                      : "10 % of its motion";
}
template <>
inline constexpr std::pair range_of<ToleranceKind>{ToleranceKind::of_scene, ToleranceKind::tenth_of_motion};

/// Quantities that scale with a power of the number of cells.
enum class ScalingQuantity { error, stiffness_for_sag, bend_stiffness_for_droop };
constexpr std::string_view name_of(ScalingQuantity quantity) {
  return quantity == ScalingQuantity::error               ? "error of the motion against cells along a side"
         : quantity == ScalingQuantity::stiffness_for_sag ? "stiffness of all springs for the same sag"
                                                          : "stiffness of bend springs for the same droop";
}
template <>
inline constexpr std::pair range_of<ScalingQuantity>{ScalingQuantity::error, ScalingQuantity::bend_stiffness_for_droop};

struct AdequacyRow {
  TABLE("adequacy");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(std::string, model, "rung", "1", "name of the model");
  COLUMN(std::string, left_out, "left out", "1", "ingredients that are left out, separated by commas");
  COLUMN(ModelKind, kind, "kind", "1", "whether this ingredient alone is left out, or together with those before it");
  COLUMN(OptionalNumber, error, "error", "m",
         "largest RMS distance from the truth of the full scene in the window; empty if the run failed");
  COLUMN(double, tolerance, "tolerance", "m", "tolerance of the scene");
  COLUMN(bool, within, "within", "1", "1 if the error is within the tolerance");
  COLUMN(double, motion, "motion", "m", "largest RMS distance of the particles from their start");
  COLUMN(double, truth_bar, "truth bar", "m", "error bar of the truth");
  COLUMN(std::string, truth, "truth", "1", "tier of the truth");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations");
  COLUMN(long, springs, "springs", "1", "springs of the model");
  COLUMN(double, cost, "cost", "spring evaluations", "force evaluations times springs");
};

struct LeastModelRow {
  TABLE("adequacy-least");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(double, tolerance, "tolerance", "m", "requested tolerance");
  COLUMN(ToleranceKind, tolerance_is, "tolerance is", "1", "origin of that tolerance");
  COLUMN(std::string, least_model, "least model", "1", "model that leaves out the most within the tolerance");
  COLUMN(std::string, left_out, "left out", "1", "ingredients that are left out, separated by commas");
  COLUMN(OptionalNumber, error, "error", "m", "error of that model");
  COLUMN(OptionalNumber, unseen_error_1, "unseen error 1", "m",
         "distance of that model from the full model from unseen start 1; for the full model, the smallest error of "
         "any removal");
  COLUMN(OptionalNumber, unseen_error_2, "unseen error 2", "m",
         "distance of that model from the full model from unseen start 2; for the full model, the smallest error of "
         "any removal");
  COLUMN(OptionalNumber, unseen_error_3, "unseen error 3", "m",
         "distance of that model from the full model from unseen start 3; for the full model, the smallest error of "
         "any removal");
  COLUMN(bool, holds, "holds", "1", "1 if it is the smallest model from all these starts too");
  COLUMN(double, cost_of_full, "cost of full", "1", "cost of that model over that of the full model");
};

struct GridRow {
  TABLE("adequacy-resolution");
  COLUMN(std::string, scene, "scene", "1", "scene");
  COLUMN(long, particles, "particles along a side", "1", "particles along the longer side");
  COLUMN(double, cells, "cells", "1", "cells along that side");
  COLUMN(OptionalNumber, error, "error against the finest", "m",
         "largest RMS distance from the finest grid in the window");
  COLUMN(OptionalNumber, sag, "sag", "m", "height of the highest point above the lowest at rest");
  COLUMN(OptionalNumber, stiffness_factor, "stiffness factor for the finest's sag", "1",
         "factor of all stiffnesses that gives the sag of the finest grid");
  COLUMN(Verdict, verdict, "verdict", "1", "how the run ended");
  COLUMN(long, evaluations, "evaluations", "1", "force evaluations");
  COLUMN(long, springs, "springs", "1", "springs of the model");
  COLUMN(double, cost, "cost", "spring evaluations", "force evaluations times springs");
};

/// A clamped line of cloth on one grid.
struct BendingRow {
  TABLE("adequacy-bending");
  COLUMN(long, particles, "particles along a line", "1", "particles along the line");
  COLUMN(double, cells, "cells", "1", "cells in the free length of the line");
  COLUMN(double, stiffness, "stiffness of bend springs", "N/m", "stiffness that gives the droop of the coarsest grid");
  COLUMN(double, droop, "droop", "m", "depth of the free end below the clamp");
};

struct ScalingRow {
  TABLE("adequacy-scaling");
  COLUMN(std::string, scene, "scene", "1", "scene; empty for the clamped line");
  COLUMN(ScalingQuantity, quantity, "quantity", "1", "quantity that scales with a power of the number of cells");
  COLUMN(double, exponent, "exponent", "1", "exponent of that power, by least squares in the logarithms");
  COLUMN(double, standard_error, "standard error", "1", "standard error of the exponent");
  COLUMN(OptionalNumber, derived, "derived", "1", "exponent derived for the limit of many cells");
};

}  // namespace crosscheck
