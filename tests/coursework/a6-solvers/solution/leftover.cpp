// An error undergoes the same passes as the positions, but is a single number.
#include <cmath>

#include "solvers.h"

double left_over(double mu, double rho, int passes) {
  double now = 1, last = 1;
  for (const double weight : weights(passes, rho)) {
    const double next = last + weight * (mu * now - last);
    last = now;
    now = next;
  }
  return now;
}

// only inertia contributes to the gradient, so that mu is the ratio of 4 k to the whole slope
double falling(double mass, double stiffness, double h, double rho, int passes, double gravity) {
  const double inertia = mass / (h * h), mu = 4 * stiffness / (inertia + 4 * stiffness);
  return (1 - left_over(mu, rho, passes)) * gravity;
}

// near rest, let x be the deviation and c = velocity_kept: without forces, the next deviation would be (1 + c) x - c
// x_before. The exact step multiplies this by m/h^2 / (m/h^2 + lambda), a step of several passes by q. The growth z per
// step therefore solves z^2 - (1 + c) q z + c q = 0
double step_growth(double mu, double inertia, double rho, int passes) {
  const double exact = inertia / (1 - mu), q = exact + left_over(mu, rho, passes) * (1 - exact);
  const double half = (1 + velocity_kept) * q / 2, root = half * half - velocity_kept * q;
  return root > 0 ? std::abs(half) + std::sqrt(root) : std::sqrt(velocity_kept * q);
}

double diverges_from(const std::vector<double>& eigenvalues, double inertia, int passes) {
  const auto grows = [&](double rho) {
    for (const double mu : eigenvalues)
      if (step_growth(mu, inertia, rho, passes) > 1 + 1e-9) return true;
    return false;
  };
  double stable = 0, grown = 0;
  for (int k = 1; k <= 2000 && !grows(grown); ++k) {
    stable = grown;
    grown = k / 2000.0;
  }
  if (grown == 1) return 1;
  while (grown - stable > 1e-9) {
    const double middle = (stable + grown) / 2;
    (grows(middle) ? grown : stable) = middle;
  }
  return stable;
}
