// Sine and cosine with identical bits on every platform with IEEE doubles; C libraries differ in the last digit.
#pragma once

#include <cmath>
#include <initializer_list>

namespace crosscheck {

/// An angle minus the nearest multiple of pi/2.
struct ReducedAngle {
  double rest, tail;  // rad: at most pi/4 in magnitude, and its rounding error
  unsigned quarter;   // the multiple, modulo 4
};

/// Cody and Waite's reduction: the first two of the three parts of pi/2 have 33 bits. Their products with the multiple
/// are therefore exact if the multiple has at most 20 bits, which holds up to 1.6e6 rad (W. J. Cody and W. Waite,
/// Software Manual for the Elementary Functions, chapter 8).
inline ReducedAngle reduced(double x) {
  constexpr double first = 0x1.921fb544p+0, second = 0x1.0b4611a6p-34, third = 0x1.3198a2e037073p-69;
  constexpr double per_quarter = 0x1.45f306dc9c883p-1;  // 2 / pi
  const double multiple = std::nearbyint(x * per_quarter);
  const double difference = x - multiple * first, rough = difference - multiple * second;
  const double left = (difference - rough) - multiple * second - multiple * third, rest = rough + left;
  return {rest, left - (rest - rough), static_cast<unsigned>(static_cast<long long>(multiple)) & 3u};
}

/// Taylor series of sine up to r^17 and of cosine up to r^16: at pi/4 the next terms are 1e-19 and 2e-18 of the value.
inline double sine_near_zero(const ReducedAngle& angle) {
  const double r = angle.rest, z = r * r;
  double sum = 1 / 355687428096000.0;
  for (const double term :
       {-1 / 1307674368000.0, 1 / 6227020800.0, -1 / 39916800.0, 1 / 362880.0, -1 / 5040.0, 1 / 120.0, -1 / 6.0})
    sum = sum * z + term;
  return r + (r * (z * sum) + angle.tail * (1 - 0.5 * z));
}
inline double cosine_near_zero(const ReducedAngle& angle) {
  const double r = angle.rest, z = r * r;
  double sum = 1 / 20922789888000.0;
  for (const double term : {-1 / 87178291200.0, 1 / 479001600.0, -1 / 3628800.0, 1 / 40320.0, -1 / 720.0, 1 / 24.0})
    sum = sum * z + term;
  return 1 - (0.5 * z - (z * (z * sum) - r * angle.tail));
}

/// sin x and cos x to within one unit in the last place up to 1e6 rad; NaN for non-finite x. Requires arithmetic
/// without fused multiply-add, which all builds of mysim guarantee.
inline double portable_sin(double x) {
  if (!std::isfinite(x)) return x - x;
  const ReducedAngle angle = reduced(x);
  const double value = angle.quarter & 1u ? cosine_near_zero(angle) : sine_near_zero(angle);
  return angle.quarter & 2u ? -value : value;
}
inline double portable_cos(double x) {
  if (!std::isfinite(x)) return x - x;
  const ReducedAngle angle = reduced(x);
  const double value = angle.quarter & 1u ? sine_near_zero(angle) : cosine_near_zero(angle);
  return (angle.quarter + 1) & 2u ? -value : value;
}

}  // namespace crosscheck
