#include "beliefs.h"

Swing explicit_step(double w, Swing s, double h) {
  const double kick = -w * w * s.x * h, drift = s.v * h;
  s.v += kick;
  s.x += drift;
  return s;
}

Swing semi_implicit_step(double w, Swing s, double h) {
  return {s.x + h * (s.v - h * w * w * s.x), s.v - h * w * w * s.x};
}

double kept(double w, Swing s, double h) {
  const Swing after = semi_implicit_step(w, s, h);
  return 0.5 * s.v * after.v + 0.5 * w * w * s.x * s.x;
}
