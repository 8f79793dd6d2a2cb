// A strip of cloth clamped horizontally at one end, as a scene, with its rest and its vibrations.
#pragma once

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"
#include "reference/truth/exact/elastica.h"

namespace crosscheck {

/// Two rows of particles, as wide as a cell is long. Bending is resisted by the bending term or by skip-one springs.
struct StripNet {
  int cells;                            // along the strip
  double gamma;                         // w L^3 / B
  double tip_load = 0;                  // P L^2 / B, on the last two particles, half a cell from the tip
  std::optional<double> skip_one = {};  // N/m, of skip-one springs in place of the bending term
};

/// The strip as a continuum: 0.2 m long, 0.2 kg/m^2.
ClampedStrip continuum_of(const StripNet& net);
constexpr double strip_density = 0.2;  // kg/m^2
constexpr double strip_length = 0.2;   // m

/// Particles are in the middle of cells of equal mass. Two columns of pins are level with the clamp, half a cell before
/// and after it. The springs extend by a millionth of the length under the weight and the load.
Scene strip_scene(const StripNet& net);

/// Depth of the tip below the clamp over the length. Extrapolated by half a cell from the last two particles.
double drop_of(const StripNet& net, const Points& x);

/// The strip between two hinges at the same height, 0.7 of its length apart.
struct HangingNet {
  int cells;         // even
  double gamma = 0;  // w L^3 / B; 0: without bending
};
HangingStrip continuum_of(const HangingNet& net);
/// The first and the last column are pinned. The initial shape is the continuum's curve.
Scene strip_scene(const HangingNet& net);
/// Depth of the middle below the hinges, over the length.
double sag_of(const HangingNet& net, const Points& x);

/// Particles along the elastica, one cell apart.
Points along_elastica(const StripNet& net);

/// Frequencies (Hz) of vibrations normal to the flat strip with both rows alike, ascending.
std::vector<double> frequencies_of(const StripNet& net);

}  // namespace crosscheck
