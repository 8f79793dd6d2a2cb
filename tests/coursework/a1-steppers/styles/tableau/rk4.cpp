// Any explicit Runge-Kutta rule from its Butcher tableau; this one is the classic rule of order 4.
#include "steppers.h"

namespace {
struct Tableau {
  std::vector<double> c;               // times of the stages
  std::vector<std::vector<double>> a;  // a[i][j]: weight of slope j in stage i
  std::vector<double> b;               // weights of the slopes in the step
};

State step(const Tableau& rule, const Derivative& f, double t, const State& x, double h) {
  std::vector<State> slopes;
  for (std::size_t stage = 0; stage < rule.c.size(); ++stage) {
    State at = x;
    for (std::size_t j = 0; j < stage; ++j)
      for (std::size_t i = 0; i < x.size(); ++i) at[i] += h * rule.a[stage][j] * slopes[j][i];
    slopes.push_back(f(t + rule.c[stage] * h, at));
  }
  State next = x;
  for (std::size_t j = 0; j < slopes.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) next[i] += h * rule.b[j] * slopes[j][i];
  return next;
}
}  // namespace

State rk4_step(const Derivative& f, double t, const State& x, double h) {
  static const Tableau classic{
      {0, 0.5, 0.5, 1}, {{}, {0.5}, {0, 0.5}, {0, 0, 1}}, {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0}};
  return step(classic, f, t, x, h);
}
