// A strip of cloth clamped level at one end, as a scene; where it comes to rest, and how it vibrates.
#pragma once

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"
#include "reference/truth/exact/elastica.h"

namespace crosscheck {

/// A strip of two rows of particles, as wide as a cell is long. What resists bending is its rigidity, or skip-one
/// springs.
struct StripNet {
  int cells;                            // along the strip
  double gamma;                         // w L^3 / B
  double tip_load = 0;                  // P L^2 / B, hung on the last two particles, half a cell before the tip
  std::optional<double> skip_one = {};  // N/m, of skip-one springs in place of the bending term
};

/// The strip as a continuum: 0.2 m long, 0.2 kg/m^2.
ClampedStrip continuum_of(const StripNet& net);
constexpr double strip_density = 0.2;  // kg/m^2
constexpr double strip_length = 0.2;   // m

/// The particles stand in the middle of cells of equal mass, and two columns of pins half a cell before the clamp and
/// behind it, level; its springs give way by a millionth of the length under its own weight and the load.
Scene strip_scene(const StripNet& net);

/// Drop of the tip over the length: half a cell beyond the last particle, in its direction.
double drop_of(const StripNet& net, const Points& x);

/// The strip between two hinges on one level, 0.7 of its length apart.
struct HangingNet {
  int cells;         // even
  double gamma = 0;  // w L^3 / B; 0: without bending
};
HangingStrip continuum_of(const HangingNet& net);
/// Its first and its last column are pinned. The start is along the continuum.
Scene strip_scene(const HangingNet& net);
/// Depth of its middle below the hinges, over the length.
double sag_of(const HangingNet& net, const Points& x);

/// The particles along the elastica, each a cell from the one before.
Points along_elastica(const StripNet& net);

/// Frequencies (Hz) of the strip's vibrations out of its plane, both rows alike, about the flat state; rising.
std::vector<double> frequencies_of(const StripNet& net);

}  // namespace crosscheck
