// Frames and plans with the standard algorithms.
#include <algorithm>
#include <map>

#include "beliefs.h"

Line advance(const Chain& chain, Line line, double frame, Plan plan) {
  const double h = frame / plan.steps;
  for (int todo = plan.steps; todo > 0; --todo) {
    Line next = line;
    std::transform(line.x.begin(), line.x.end(), line.v.begin(), next.x.begin(),
                   [&](double x, double v) { return x + h * v + h * h * chain.gravity; });
    std::vector<double> pulls(line.x.size());
    for (int i = 0; i < plan.iterations; ++i) iterate(chain, h, next.x, pulls);
    std::transform(next.x.begin(), next.x.end(), line.x.begin(), next.v.begin(),
                   [&](double to, double from) { return (to - from) / h; });
    line = next;
  }
  return line;
}

Plan choose(const Film& film, int budget) {
  std::map<double, Plan> by_error;
  for (int steps = 1; steps <= budget; ++steps)
    if (budget % steps == 0) by_error.insert({film.error({steps, budget / steps}), {steps, budget / steps}});
  return by_error.begin()->second;
}
