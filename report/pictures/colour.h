#pragma once

#include <Eigen/Core>

#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

using Colour = Eigen::Vector3f;  // channels 0..1

constexpr unsigned background_hex = 0xF7F7F5;

Colour from_hex(unsigned rrggbb);  // sRGB
Colour to_linear(const Colour& srgb);
inline Colour linear(unsigned rrggbb) { return to_linear(from_hex(rrggbb)); }

/// sRGB bytes of the linear intensities i / 16384: a fast look-up with the same result on every machine.
std::vector<unsigned char> srgb_table();

/// Position of a value on the scale, clamped to 0..1.
float scale_position(const Scale& scale, double value);

/// sRGB colour at a position 0..1, from light to dark.
Colour scale_colour(float position);

/// sRGB of Okabe-Ito's 7 colours; grey for other indices.
unsigned palette_hex(int index);

}  // namespace crosscheck::render
