// The gradient of the implicit equation, and one pass over it.
#include "solvers.h"

std::vector<Vec3> gradient(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h) {
  (void)net, (void)ahead, (void)h;     // delete this line when you use them
  return std::vector<Vec3>(x.size());  // yours
}

std::vector<Vec3> jacobi_pass(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h) {
  (void)net, (void)ahead, (void)h;  // delete this line when you use them
  return x;                         // yours
}
