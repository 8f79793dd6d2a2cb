#pragma once

#include "experiments/tables/typed.h"

namespace crosscheck {

struct CantileverRow {
  TABLE("fabric-cantilevers");
  COLUMN(std::string, load, "load", "1", "load that bends the strip");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(double, gamma, "gamma", "1", "weight per area x length^3 / rigidity");
  COLUMN(double, tip_load, "tip load", "1", "load on the last particles per width x length^2 / rigidity");
  COLUMN(double, drop, "drop", "1", "depth of the tip below the clamp, over the length");
  COLUMN(double, truth, "drop of the elastica", "1", "that drop from the boundary-value problem of the elastica");
  COLUMN(double, deviation, "deviation", "1", "drop over that of the elastica, less 1");
};

/// Small vibrations of the strip without weight.
struct StripVibrationRow {
  TABLE("fabric-vibrations");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(long, mode, "mode", "1", "number of the mode: first, second or third");
  COLUMN(double, frequency, "frequency", "Hz", "frequency of the linearised scene");
  COLUMN(double, truth, "frequency of the beam", "Hz", "frequency of a clamped beam");
  COLUMN(double, deviation, "deviation", "1", "frequency over that of the beam, less 1");
};

/// A strip with the bending term, or one whose skip-one springs give the same droop on one of the grids.
struct SkipOneRow {
  TABLE("fabric-skip-one");
  COLUMN(std::string, net, "net", "1", "model of the bending resistance");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(double, skip_one, "skip-one stiffness", "N/m", "stiffness of each skip-one spring; 0: none");
  COLUMN(double, drop, "drop", "1", "depth of the tip below the clamp, over the length");
  COLUMN(double, truth, "drop of the elastica", "1", "that drop from the boundary-value problem of the elastica");
};

struct HangingStripRow {
  TABLE("fabric-hanging");
  COLUMN(long, cells, "cells", "1", "cells along the strip");
  COLUMN(double, gamma, "gamma", "1", "weight per area x length^3 / rigidity; 0: without bending");
  COLUMN(double, sag, "sag", "1", "depth of the middle below the hinges, over the length");
  COLUMN(double, truth, "true sag", "1", "sag of the catenary; with bending, from the boundary-value problem");
  COLUMN(double, deviation, "deviation", "1", "sag over the true sag, less 1");
};

/// The shape of the hanging strip on one grid: the true curve, and the particles of the net.
struct HangingShapeRow {
  TABLE("fabric-hanging-shapes");
  COLUMN(double, gamma, "gamma", "1", "weight per area x length^3 / rigidity; 0: without bending");
  COLUMN(double, x, "x", "m", "position on the true curve, from the middle");
  COLUMN(double, height, "height", "m", "height of the true curve above the hinges");
  COLUMN(OptionalNumber, net_x, "net x", "m", "position of the particle at that place; empty if there is none");
  COLUMN(OptionalNumber, net_height, "net height", "m", "height of the particle at that place");
};

/// A state of rest of a round cloth over a disc, found from one start.
struct DrapedDiscRow {
  TABLE("fabric-drapes");
  COLUMN(std::string, start, "start", "1", "initial shape of the search");
  COLUMN(long, rings, "rings", "1", "rings of free particles between the disc and the rim");
  COLUMN(double, rigidity, "rigidity", "N m", "bending rigidity of the cloth");
  COLUMN(double, shear, "shear stiffness", "N/m", "C66 of the cloth in its plane, a third of C11");
  COLUMN(long, nodes, "nodes", "1", "folds of the cloth at rest");
  COLUMN(double, coefficient, "drape coefficient", "%", "(projected area - disc) / (specimen - disc)");
  COLUMN(double, energy, "energy", "J", "elastic and gravitational energy above that of the flat sheet");
};

/// The shape of the drape with the lowest energy on one grid.
struct DrapedParticleRow {
  TABLE("fabric-drape-shape");
  COLUMN(long, ring, "ring", "1", "number of the ring, from the edge of the disc outwards; the first two are pinned");
  COLUMN(long, spoke, "spoke", "1", "number of the spoke, around the axis");
  COLUMN(double, x, "x", "m", "horizontal position");
  COLUMN(double, y, "y", "m", "height");
  COLUMN(double, z, "z", "m", "horizontal position");
};

}  // namespace crosscheck
