// On a spring, four slopes give the Taylor polynomial of exp up to the fourth power. Its modulus is below 1 up to h
// omega = sqrt(8).
#include <cmath>

#include "beliefs.h"

Swing rk4_step(double omega, Swing now, double h) {
  const auto slope = [&](Swing k, double ahead) {
    return Swing{now.v + ahead * k.v, -omega * omega * (now.x + ahead * k.x)};
  };
  const Swing k1 = slope(now, 0);
  const Swing k2 = slope(k1, h / 2);
  const Swing k3 = slope(k2, h / 2);
  const Swing k4 = slope(k3, h);
  return {now.x + h / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x), now.v + h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v)};
}

double rk4_energy_factor(double angle) {
  const double square = angle * angle, cube = square * square * square;
  return 1 - cube / 72 + cube * square / 576;
}

double rk4_largest_step(double omega) { return std::sqrt(8.0) / omega; }
