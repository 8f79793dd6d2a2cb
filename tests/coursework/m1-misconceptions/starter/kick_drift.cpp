// Kick and drift, in two orders.
#include "beliefs.h"

Swing explicit_step(double omega, Swing now, double h) {
  (void)omega, (void)h;  // delete this line when you use them
  return now;            // yours
}

Swing semi_implicit_step(double omega, Swing now, double h) {
  (void)omega, (void)h;  // delete this line when you use them
  return now;            // yours
}

double kept(double omega, Swing now, double h) {
  (void)omega, (void)now, (void)h;  // delete this line when you use them
  return 0;                         // yours
}
