// The error that remains after a few passes.
#include "solvers.h"

double left_over(double mu, double rho, int passes) {
  (void)mu, (void)rho, (void)passes;  // delete this line when you use them
  return 1;                           // yours
}

double falling(double mass, double stiffness, double h, double rho, int passes, double gravity) {
  (void)mass, (void)stiffness, (void)h, (void)rho, (void)passes, (void)gravity;  // delete this line when you use them
  return 0;                                                                      // yours
}

double step_growth(double mu, double inertia, double rho, int passes) {
  (void)mu, (void)inertia, (void)rho, (void)passes;  // delete this line when you use them
  return 0;                                          // yours
}

double diverges_from(const std::vector<double>& eigenvalues, double inertia, int passes) {
  (void)eigenvalues, (void)inertia, (void)passes;  // delete this line when you use them
  return -1;                                       // yours
}
