// The textbook formula, number by number.
#include "beliefs.h"

Swing rk4_step(double omega, Swing now, double h) {
  double w = omega * omega;
  double kx1 = now.v, kv1 = -w * now.x;
  double kx2 = now.v + h / 2 * kv1, kv2 = -w * (now.x + h / 2 * kx1);
  double kx3 = now.v + h / 2 * kv2, kv3 = -w * (now.x + h / 2 * kx2);
  double kx4 = now.v + h * kv3, kv4 = -w * (now.x + h * kx3);
  now.x += (kx1 + 2 * kx2 + 2 * kx3 + kx4) * h / 6;
  now.v += (kv1 + 2 * kv2 + 2 * kv3 + kv4) * h / 6;
  return now;
}

// energy after one step, relative to the energy at the start
double rk4_energy_factor(double angle) {
  Swing after = rk4_step(1, {1, 0}, angle);
  return after.x * after.x + after.v * after.v;
}

double rk4_largest_step(double omega) {
  double low = 2, high = 4;
  for (int i = 0; i < 60; i++) (rk4_energy_factor((low + high) / 2) > 1 ? high : low) = (low + high) / 2;
  return low / omega;
}
