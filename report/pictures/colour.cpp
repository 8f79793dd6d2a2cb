#include "report/pictures/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace crosscheck::render {

Colour from_hex(unsigned rrggbb) {
  return Colour(float(rrggbb >> 16 & 255), float(rrggbb >> 8 & 255), float(rrggbb & 255)) / 255.f;
}

Colour to_linear(const Colour& srgb) {
  return srgb.unaryExpr([](float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); });
}

std::vector<unsigned char> srgb_table() {
  std::vector<unsigned char> table(16385);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float x = float(i) / 16384, srgb = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    table[i] = static_cast<unsigned char>(std::lround(255 * srgb));
  }
  return table;
}

float scale_position(const Scale& scale, double value) {
  return scale.high > 0 ? static_cast<float>(std::clamp(value / scale.high, 0.0, 1.0)) : 0;
}

Colour scale_colour(float position) {
  // decreasing lightness, so that the scale is readable in grey
  constexpr std::array<unsigned, 7> stops = {0xF3F0E8, 0xF6D9A6, 0xF3B466, 0xE8853B, 0xCF5246, 0xA02C5D, 0x5F1A5C};
  const float place = std::clamp(position, 0.f, 1.f) * float(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const float s = place - float(i);
  return (1 - s) * from_hex(stops[i]) + s * from_hex(stops[i + 1]);
}

unsigned palette_hex(int index) {
  constexpr std::array<unsigned, 7> okabe_ito = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x333333};
  return index >= 0 && index < int(okabe_ito.size()) ? okabe_ito[std::size_t(index)] : 0x9A9A98;
}

}  // namespace crosscheck::render
