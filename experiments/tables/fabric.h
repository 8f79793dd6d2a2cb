// Rows of experiment `fabric`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A strip clamped level that hangs at rest.
struct CantileverRow {
  std::string load;
  long cells = 0;
  double gamma = 0, tip_load = 0, drop = 0, truth = 0, deviation = 0;

  static constexpr std::string_view table = "fabric-cantilevers";
  static constexpr auto columns = [](auto&& column) {
    column("load", "1", &CantileverRow::load, "what bends the strip"),
        column("cells", "1", &CantileverRow::cells, "cells along the strip"),
        column("gamma", "1", &CantileverRow::gamma, "weight per area x length^3 / rigidity"),
        column("tip load", "1", &CantileverRow::tip_load, "load on the last particles per width x length^2 / rigidity"),
        column("drop", "1", &CantileverRow::drop, "how far the tip hangs below the clamp, over the length"),
        column("drop of the elastica", "1", &CantileverRow::truth, "the same by the two-point problem"),
        column("deviation", "1", &CantileverRow::deviation, "drop over that of the elastica, less 1");
  };
};

/// The same strip's small vibrations without weight.
struct StripVibrationRow {
  long cells = 0, mode = 0;
  double frequency = 0, truth = 0, deviation = 0;

  static constexpr std::string_view table = "fabric-vibrations";
  static constexpr auto columns = [](auto&& column) {
    column("cells", "1", &StripVibrationRow::cells, "cells along the strip"),
        column("mode", "1", &StripVibrationRow::mode, "first, second or third vibration"),
        column("frequency", "Hz", &StripVibrationRow::frequency, "of the linearised scene"),
        column("frequency of the beam", "Hz", &StripVibrationRow::truth, "of a clamped beam"),
        column("deviation", "1", &StripVibrationRow::deviation, "frequency over that of the beam, less 1");
  };
};

/// A strip with the bending term beside one with skip-one springs that droops alike on one grid.
struct SkipOneRow {
  std::string net;
  long cells = 0;
  double skip_one = 0, drop = 0, truth = 0;

  static constexpr std::string_view table = "fabric-skip-one";
  static constexpr auto columns = [](auto&& column) {
    column("net", "1", &SkipOneRow::net, "what resists bending"),
        column("cells", "1", &SkipOneRow::cells, "cells along the strip"),
        column("skip-one stiffness", "N/m", &SkipOneRow::skip_one, "of each skip-one spring; 0: none"),
        column("drop", "1", &SkipOneRow::drop, "how far the tip hangs below the clamp, over the length"),
        column("drop of the elastica", "1", &SkipOneRow::truth, "the same by the two-point problem");
  };
};

/// A strip that hangs between two hinges.
struct HangingStripRow {
  long cells = 0;
  double gamma = 0, sag = 0, truth = 0, deviation = 0;

  static constexpr std::string_view table = "fabric-hanging";
  static constexpr auto columns = [](auto&& column) {
    column("cells", "1", &HangingStripRow::cells, "cells along the strip"),
        column("gamma", "1", &HangingStripRow::gamma, "weight per area x length^3 / rigidity; 0: without bending"),
        column("sag", "1", &HangingStripRow::sag, "how far the middle hangs below the hinges, over the length"),
        column("true sag", "1", &HangingStripRow::truth, "of the catenary; with bending by the two-point problem"),
        column("deviation", "1", &HangingStripRow::deviation, "sag over the true one, less 1");
  };
};

/// The same strip along its length, on one grid: where it should be and, at each particle, where the net is.
struct HangingShapeRow {
  double gamma = 0, x = 0, height = 0;
  std::optional<double> net_x = {}, net_height = {};

  static constexpr std::string_view table = "fabric-hanging-shapes";
  static constexpr auto columns = [](auto&& column) {
    column("gamma", "1", &HangingShapeRow::gamma, "weight per area x length^3 / rigidity; 0: without bending"),
        column("x", "m", &HangingShapeRow::x, "of the true curve, from the middle"),
        column("height", "m", &HangingShapeRow::height, "of the true curve, above the hinges"),
        column("net x", "m", &HangingShapeRow::net_x, "of the particle that belongs there; empty: none does"),
        column("net height", "m", &HangingShapeRow::net_height, "of the particle that belongs there");
  };
};

/// A round cloth over a disc: a state of rest that was found from one start.
struct DrapedDiscRow {
  std::string start;
  long rings = 0, nodes = 0;
  double rigidity = 0, shear = 0, coefficient = 0, energy = 0;

  static constexpr std::string_view table = "fabric-drapes";
  static constexpr auto columns = [](auto&& column) {
    column("start", "1", &DrapedDiscRow::start, "the shape that the search began from"),
        column("rings", "1", &DrapedDiscRow::rings, "rings of free particles between the disc and the rim"),
        column("rigidity", "N m", &DrapedDiscRow::rigidity, "bending rigidity of the cloth"),
        column("shear stiffness", "N/m", &DrapedDiscRow::shear, "C66 of the cloth in its plane, a third of C11"),
        column("nodes", "1", &DrapedDiscRow::nodes, "folds of the cloth at rest"),
        column("drape coefficient", "%", &DrapedDiscRow::coefficient, "(projected area - disc) / (specimen - disc)"),
        column("energy", "J", &DrapedDiscRow::energy, "elastic and gravitational energy above the flat sheet's");
  };
};

/// The particles of the drape of lowest energy, on one net.
struct DrapedParticleRow {
  long ring = 0, spoke = 0;
  double x = 0, y = 0, z = 0;

  static constexpr std::string_view table = "fabric-drape-shape";
  static constexpr auto columns = [](auto&& column) {
    column("ring", "1", &DrapedParticleRow::ring, "from the disc's edge outwards; the first two are pinned"),
        column("spoke", "1", &DrapedParticleRow::spoke, "around the axis"),
        column("x", "m", &DrapedParticleRow::x, "position"), column("y", "m", &DrapedParticleRow::y, "height"),
        column("z", "m", &DrapedParticleRow::z, "position");
  };
};

}  // namespace crosscheck
