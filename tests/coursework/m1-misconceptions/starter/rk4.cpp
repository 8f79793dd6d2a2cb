// The energy of the classic Runge-Kutta rule.
#include "beliefs.h"

Swing rk4_step(double omega, Swing now, double h) {
  (void)omega, (void)h;  // delete this line when you use them
  return now;            // yours
}

double rk4_energy_factor(double angle) {
  (void)angle;  // delete this line when you use it
  return 0;     // yours
}

double rk4_largest_step(double omega) {
  (void)omega;  // delete this line when you use it
  return 0;     // yours
}
