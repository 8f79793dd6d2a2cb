// Rows of experiment `fabric`.
#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

/// A strip clamped level that hangs at rest.
struct CantileverRow {
  TABLE("fabric-cantilevers");
  COLUMN(std::string, load, "load", "1", "what bends the strip");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(double, gamma, "gamma", "1", "weight per area x length^3 / rigidity");
  COLUMN(double, tip_load, "tip load", "1", "load on the last particles per width x length^2 / rigidity");
  COLUMN(double, drop, "drop", "1", "how far the tip hangs below the clamp, over the length");
  COLUMN(double, truth, "drop of the elastica", "1", "the same by the two-point problem");
  COLUMN(double, deviation, "deviation", "1", "drop over that of the elastica, less 1");
};

/// The same strip's small vibrations without weight.
struct StripVibrationRow {
  TABLE("fabric-vibrations");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(long, mode, "mode", "1", "first, second or third vibration");
  COLUMN(double, frequency, "frequency", "Hz", "of the linearised scene");
  COLUMN(double, truth, "frequency of the beam", "Hz", "of a clamped beam");
  COLUMN(double, deviation, "deviation", "1", "frequency over that of the beam, less 1");
};

/// A strip with the bending term beside one with skip-one springs that droops alike on one grid.
struct SkipOneRow {
  TABLE("fabric-skip-one");
  COLUMN(std::string, net, "net", "1", "what resists bending");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(double, skip_one, "skip-one stiffness", "N/m", "of each skip-one spring; 0: none");
  COLUMN(double, drop, "drop", "1", "how far the tip hangs below the clamp, over the length");
  COLUMN(double, truth, "drop of the elastica", "1", "the same by the two-point problem");
};

/// A strip that hangs between two hinges.
struct HangingStripRow {
  TABLE("fabric-hanging");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(double, gamma, "gamma", "1", "weight per area x length^3 / rigidity; 0: without bending");
  COLUMN(double, sag, "sag", "1", "how far the middle hangs below the hinges, over the length");
  COLUMN(double, truth, "true sag", "1", "of the catenary; with bending by the two-point problem");
  COLUMN(double, deviation, "deviation", "1", "sag over the true one, less 1");
};

/// The same strip along its length, on one grid: where it should be and, at each particle, where the net is.
struct HangingShapeRow {
  TABLE("fabric-hanging-shapes");
  COLUMN(double, gamma, "gamma", "1", "weight per area x length^3 / rigidity; 0: without bending");
  COLUMN(double, x, "x", "m", "of the true curve, from the middle");
  COLUMN(double, height, "height", "m", "of the true curve, above the hinges");
  COLUMN(OptionalNumber, net_x, "net x", "m", "of the particle that belongs there; empty: none does");
  COLUMN(OptionalNumber, net_height, "net height", "m", "of the particle that belongs there");
};

/// A round cloth over a disc: a state of rest that was found from one start.
struct DrapedDiscRow {
  TABLE("fabric-drapes");
  COLUMN(std::string, start, "start", "1", "the shape that the search began from");
  COLUMN(long, rings, "rings", "1", "rings of free particles between the disc and the rim");
  COLUMN(double, rigidity, "rigidity", "N m", "bending rigidity of the cloth");
  COLUMN(double, shear, "shear stiffness", "N/m", "C66 of the cloth in its plane, a third of C11");
  COLUMN(long, nodes, "nodes", "1", "folds of the cloth at rest");
  COLUMN(double, coefficient, "drape coefficient", "%", "(projected area - disc) / (specimen - disc)");
  COLUMN(double, energy, "energy", "J", "elastic and gravitational energy above the flat sheet's");
};

/// The particles of the drape of lowest energy, on one net.
struct DrapedParticleRow {
  TABLE("fabric-drape-shape");
  COLUMN(long, ring, "ring", "1", "from the disc's edge outwards; the first two are pinned");
  COLUMN(long, spoke, "spoke", "1", "around the axis");
  COLUMN(double, x, "x", "m", "position");
  COLUMN(double, y, "y", "m", "height");
  COLUMN(double, z, "z", "m", "position");
};

}  // namespace crosscheck
