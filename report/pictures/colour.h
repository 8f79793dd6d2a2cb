// Colours: sRGB and linear light, the colour maps of a scale, the palette, and the fixed colours of things.
#pragma once

#include <Eigen/Core>

#include <array>

#include "report/pictures/picture.h"

namespace crosscheck::render {

using Colour = Eigen::Vector3f;  // red, green, blue in 0..1

constexpr unsigned background_hex = 0xF7F7F5;

Colour from_hex(unsigned rrggbb);      // sRGB
Colour to_linear(const Colour& srgb);  // linear light
inline Colour linear(unsigned rrggbb) { return to_linear(from_hex(rrggbb)); }

/// sRGB byte of a linear intensity, clamped to 0..1; a table of 1/16384 makes it cheap and the same everywhere.
class SrgbEncoder {
 public:
  SrgbEncoder();
  unsigned char operator()(float linear_value) const;

 private:
  std::array<unsigned char, 16385> table_;
};

/// Place of a value on the scale, clamped to 0..1; NaN stays NaN and infinite values become NaN.
float scale_position(const Scale& scale, double value);

/// sRGB colour at a place in 0..1: sequential light-to-dark, or blue-white-red if diverging; NaN gives a dark grey.
Colour scale_colour(bool diverging, float position);

/// sRGB of a palette entry (Okabe-Ito, 7 entries); an index outside is grey.
unsigned palette_hex(int index);

constexpr unsigned no_value_hex = 0x55565A;  // drawn where a value is not finite

}  // namespace crosscheck::render
