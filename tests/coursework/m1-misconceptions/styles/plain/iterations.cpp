// A function for a step; plans are tried from the largest number of steps down.
#include "beliefs.h"

static void step(const Chain& chain, Line& line, double h, int iterations) {
  std::vector<double> old(line.x), pulls(line.x.size());
  for (std::size_t i = 0; i < old.size(); ++i) {
    line.v[i] += h * chain.gravity;
    line.x[i] += h * line.v[i];
  }
  while (iterations-- > 0) iterate(chain, h, line.x, pulls);
  for (std::size_t i = 0; i < old.size(); ++i) line.v[i] = (line.x[i] - old[i]) / h;
}

Line advance(const Chain& chain, Line line, double frame, Plan plan) {
  for (int i = 0; i < plan.steps; i++) step(chain, line, frame / plan.steps, plan.iterations);
  return line;
}

Plan choose(const Film& film, int budget) {
  Plan best{budget, 1};
  for (int steps = budget - 1; steps >= 1; steps--)
    if (budget % steps == 0 && film.error({steps, budget / steps}) < film.error(best)) best = {steps, budget / steps};
  return best;
}
