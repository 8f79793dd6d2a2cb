// Strain of springs, at their ends.
#include "report/strain.h"

#include <algorithm>
#include <cmath>

namespace crosscheck {

double extension(const Points& x, int a, int b, double rest) {
  return rest > 0 ? std::max(0.0, (x.col(a) - x.col(b)).norm() / rest - 1) * 100 : 0;
}

std::vector<double> stretch_of(const Scene& scene, const Points& x, std::vector<double>* per_spring) {
  std::vector<double> sum(x.cols(), 0), count(x.cols(), 0);
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) {
      const double strain = extension(x, s.a, s.b, s.rest);
      if (per_spring) per_spring->push_back(strain);
      if (s.family == Family::shear || s.family == Family::bend) continue;
      for (int end : {s.a, s.b}) sum[end] += strain, count[end] += 1;
    }
  if (const auto* constraints = scene.model.find<Constraints>())
    for (const auto& [a, b, length] : constraints->list)
      for (int end : {a, b}) {
        sum[end] += extension(x, a, b, length);
        count[end] += 1;
      }
  for (size_t i = 0; i < sum.size(); ++i) sum[i] /= std::max(1.0, count[i]);
  return sum;
}

double round_up(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double step : {1.0, 2.0, 5.0, 10.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return value;
}

}  // namespace crosscheck
