// A step by accelerated passes.
#include "solvers.h"

std::vector<double> weights(int passes, double rho) {
  (void)rho;                                                          // delete this line when you use it
  return std::vector<double>(static_cast<std::size_t>(passes), 0.0);  // yours
}

State implicit_step(const Net& net, const State& state, double h, int passes, double rho) {
  (void)net, (void)h, (void)passes, (void)rho;  // delete this line when you use them
  return state;                                 // yours
}
