// Colours: sRGB and linear light, the colour map of a scale, the palette, and the background.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

using Colour = Eigen::Vector3f;  // red, green, blue in 0..1

constexpr unsigned background_hex = 0xF7F7F5;

Colour from_hex(unsigned rrggbb);      // sRGB
Colour to_linear(const Colour& srgb);  // linear light
inline Colour linear(unsigned rrggbb) { return to_linear(from_hex(rrggbb)); }

/// sRGB bytes of the linear intensities i / 16384: fast to look up, and the same on every machine.
std::vector<unsigned char> srgb_table();

/// Position of a value on the scale, clamped to 0..1.
float scale_position(const Scale& scale, double value);

/// sRGB colour at a position in 0..1, from light to dark.
Colour scale_colour(float position);

/// sRGB of a palette entry (Okabe-Ito, 7 entries); grey for an index out of range.
unsigned palette_hex(int index);

}  // namespace crosscheck::render
