// Chebyshev's polynomials by their own recurrence, T_{n+1}(s) = 2 s T_n(s) - T_{n-1}(s).
#include <complex>

#include "solvers.h"

static double polynomial(int n, double s) {
  double before = 1, now = s;
  if (n == 0) return 1;
  for (int k = 1; k < n; k++) {
    double next = 2 * s * now - before;
    before = now, now = next;
  }
  return now;
}

double left_over(double mu, double rho, int passes) {
  if (rho == 0) return std::pow(mu, passes);
  return polynomial(passes, mu / rho) / polynomial(passes, 1 / rho);
}

double falling(double mass, double stiffness, double h, double rho, int passes, double gravity) {
  double mu = 1 / (1 + mass / (4 * stiffness * h * h));
  return gravity - gravity * left_over(mu, rho, passes);
}

double step_growth(double mu, double inertia, double rho, int passes) {
  double exact = inertia / (1 - mu), q = exact + left_over(mu, rho, passes) * (1 - exact);
  std::complex<double> sum = 1.99 * q, root = std::sqrt(sum * sum - 4 * 0.99 * q);
  return std::fmax(std::abs(sum + root), std::abs(sum - root)) / 2;
}

double diverges_from(const std::vector<double>& eigenvalues, double inertia, int passes) {
  double rho = 0;
  for (double step = 1e-3; step > 1e-8; step /= 10) {
    bool found = false;
    while (!found && rho < 1) {
      for (double mu : eigenvalues) found = found || step_growth(mu, inertia, rho, passes) > 1 + 1e-9;
      if (!found) rho += step;
    }
    if (!found) return 1;
    if (rho > 0) rho -= step;
  }
  return rho;
}
