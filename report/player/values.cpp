// Computes colour values and what is plotted.
#include "report/player/values.h"

#include <algorithm>

#include "mysim/energy.h"
#include "report/strain.h"

namespace crosscheck {
namespace {

void find_top(ColourValues& values, const std::vector<Shown>& all) {
  for (size_t m = 0; m < all.size(); ++m)
    for (const double v : values.of[m])
      if (all[m].ok()) values.top = std::max(values.top, v);
  if (values.top > 0) values.top = round_up(values.top);
}

}  // namespace

ColourValues stretch_values(const Scene& scene, const std::vector<Shown>& all) {
  ColourValues values;
  for (const Shown& s : all) {
    auto& own = values.of.emplace_back();
    for (const Points& x : s.x)
      for (const double strain : stretch_of(scene, x)) own.push_back(strain);
  }
  find_top(values, all);
  return values;
}

ColourValues distance_values(const std::vector<Shown>& all, const Shown& truth, double until, double bar) {
  ColourValues values;
  for (const Shown& s : all) {
    auto& own = values.of.emplace_back();
    for (size_t f = 0; &s != &truth && f < std::min(s.x.size(), truth.x.size()); ++f) {
      if (s.t[f] > until * (1 + 1e-9)) break;
      for (Eigen::Index i = 0; i < s.x[f].cols(); ++i) own.push_back(1e3 * (s.x[f].col(i) - truth.x[f].col(i)).norm());
    }
  }
  find_top(values, all);
  if (values.top < 1e3 * bar) values.top = 0;
  return values;
}

std::vector<std::optional<double>> plotted_values(const Scene& scene, const Shown& s, const Shown* truth) {
  std::vector<std::optional<double>> list(s.x.size());
  for (size_t f = 0; f < s.x.size(); ++f) {
    if (!scene.model.first_order()) {
      if (s.v[f].cols() == s.x[f].cols()) list[f] = energy_of(scene.model, {s.t[f], s.x[f], s.v[f]}).total();
    } else if (truth && f < truth->x.size()) {
      list[f] = 1e3 * rms_distance(s.x[f], truth->x[f]);
    }
  }
  return list;
}

}  // namespace crosscheck
