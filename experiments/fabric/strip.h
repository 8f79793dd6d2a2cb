// A strip of cloth clamped horizontally at one end, as a scene, with its rest and its vibrations.
#pragma once

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"
#include "reference/truth/exact/elastica.h"

namespace crosscheck {

/// Two rows of particles, one cell length apart. Bending is resisted by the bending term or by skip-one springs.
struct StripNet {
  int cells;
  double gamma;         // w L^3 / B
  double tip_load = 0;  // P L^2 / B; the load P acts on the last two particles, half a cell from the tip
  std::optional<double> skip_one = {};  // N/m, stiffness of skip-one springs that replace the bending term
};

ClampedStrip continuum_of(const StripNet& net);
constexpr double strip_density = 0.2;  // kg/m^2
constexpr double strip_length = 0.2;   // m

/// The scene of the strip. Particles are at the middle of cells with equal mass. Two columns of pins are level with the
/// clamp, half a cell before and half a cell after it. The springs extend by a millionth of the length under the weight
/// and the load.
Scene strip_scene(const StripNet& net);

/// Depth of the tip below the clamp divided by the length. Extrapolated by half a cell from the last two particles.
double drop_of(const StripNet& net, const Points& x);

/// The strip between two hinges at the same height, whose distance is 0.7 of its length.
struct HangingNet {
  int cells;         // even
  double gamma = 0;  // w L^3 / B; 0: without bending
};
HangingStrip continuum_of(const HangingNet& net);
/// The scene of the strip between hinges, to which the first and the last column are pinned. The initial shape is the
/// continuum's curve.
Scene strip_scene(const HangingNet& net);
/// Depth of the middle below the hinges, divided by the length.
double sag_of(const HangingNet& net, const Points& x);

/// Positions of the particles along the elastica, one cell apart.
Points along_elastica(const StripNet& net);

/// Frequencies (Hz), ascending, of vibrations normal to the flat strip; only vibrations in which both rows move alike.
std::vector<double> frequencies_of(const StripNet& net);

}  // namespace crosscheck
