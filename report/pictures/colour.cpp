// Colours: sRGB transfer, colour maps by linear interpolation between stops in sRGB, Okabe-Ito palette.
#include "report/pictures/colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace crosscheck::render {
namespace {

// lightness falls all the way, so that the map also reads in grey
constexpr std::array<unsigned, 7> sequential = {0xF3F0E8, 0xF6D9A6, 0xF3B466, 0xE8853B, 0xCF5246, 0xA02C5D, 0x5F1A5C};
constexpr std::array<unsigned, 7> two_sided = {0x1F4E9C, 0x5B93CB, 0xB5D3E8, 0xF3F0E8, 0xF4C39F, 0xD96B4C, 0x9C1B2F};
constexpr std::array<unsigned, 7> okabe_ito = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x333333};

float encode(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

}  // namespace

Colour from_hex(unsigned rrggbb) {
  return Colour(float(rrggbb >> 16 & 255), float(rrggbb >> 8 & 255), float(rrggbb & 255)) / 255.f;
}

Colour to_linear(const Colour& srgb) {
  return srgb.unaryExpr([](float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); });
}

SrgbEncoder::SrgbEncoder() {
  for (std::size_t i = 0; i < table_.size(); ++i) {
    table_[i] = static_cast<unsigned char>(std::lround(255 * encode(float(i) / 16384)));
  }
}

unsigned char SrgbEncoder::operator()(float linear_value) const {
  if (!(linear_value > 0)) return 0;  // also NaN
  return table_[static_cast<std::size_t>(std::min(linear_value, 1.f) * 16384 + 0.5f)];
}

float scale_position(const Scale& scale, double value) {
  if (!std::isfinite(value)) return std::numeric_limits<float>::quiet_NaN();
  const double span = scale.high - scale.low;
  if (!(span > 0)) return 0;
  return static_cast<float>(std::clamp((value - scale.low) / span, 0.0, 1.0));
}

Colour scale_colour(bool diverging, float position) {
  if (std::isnan(position)) return from_hex(no_value_hex);
  const std::span<const unsigned> stops = diverging ? two_sided : sequential;
  const float place = std::clamp(position, 0.f, 1.f) * float(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const float s = place - float(i);
  return (1 - s) * from_hex(stops[i]) + s * from_hex(stops[i + 1]);
}

unsigned palette_hex(int index) {
  return index >= 0 && index < int(okabe_ito.size()) ? okabe_ito[std::size_t(index)] : 0x9A9A98;
}

}  // namespace crosscheck::render
