// The drift uses either the old or the new velocity: a small change with a large effect after a thousand steps.
#include "beliefs.h"

Swing explicit_step(double omega, Swing now, double h) {
  return {now.x + h * now.v, now.v - h * omega * omega * now.x};
}

Swing semi_implicit_step(double omega, Swing now, double h) {
  now.v -= h * omega * omega * now.x;
  now.x += h * now.v;
  return now;
}

double kept(double omega, Swing now, double h) {
  const double w = omega * now.x;
  return (now.v * now.v + w * w - h * omega * w * now.v) / 2;
}
