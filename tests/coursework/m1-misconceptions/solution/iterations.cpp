// Advances a frame with a given plan, and chooses the plan with the smallest measured error.
#include <cmath>

#include "beliefs.h"

Line advance(const Chain& chain, Line line, double frame, Plan plan) {
  const double h = frame / plan.steps;
  for (int step = 0; step < plan.steps; ++step) {
    const std::vector<double> start = line.x;
    for (std::size_t i = 0; i < start.size(); ++i) line.x[i] += h * (line.v[i] + h * chain.gravity);
    std::vector<double> pulls(start.size(), 0.0);
    for (int k = 0; k < plan.iterations; ++k) iterate(chain, h, line.x, pulls);
    for (std::size_t i = 0; i < start.size(); ++i) line.v[i] = (line.x[i] - start[i]) / h;
  }
  return line;
}

Plan choose(const Film& film, int budget) {
  Plan best{};
  double smallest = HUGE_VAL;
  for (int steps = 1; steps <= budget; ++steps) {
    if (budget % steps != 0) continue;
    const Plan plan{steps, budget / steps};
    const double found = film.error(plan);
    if (found < smallest) best = plan, smallest = found;
  }
  return best;
}
