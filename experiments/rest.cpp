// Dynamic relaxation.
#include "experiments/rest.h"

#include <algorithm>
#include <cmath>

#include "mysim/frequency.h"
#include "mysim/system.h"

namespace crosscheck {
namespace {

bool has_rest(const Model& model) {
  const auto* wind = model.find<Wind>();
  const auto* air = model.find<Aerodynamics>();
  return !model.first_order() && !model.find<Constraints>() && !model.find<Spheres>() && model.find<Springs>() &&
         !(wind && wind->acceleration.gusts) && !(air && air->velocity.gusts) && !model.particles.move &&
         !model.particles.pins.empty();
}

}  // namespace

std::optional<State> rest_of(const Scene& scene) {
  if (!has_rest(scene.model)) return std::nullopt;
  Model model = scene.model;
  std::erase_if(model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  System system(model);
  State s = scene.start;
  s.v.setZero();
  Points a(3, s.x.cols());
  const double omega = fastest_frequency(model, s);
  if (!(omega > 0)) return std::nullopt;
  // 2 / omega is the limit at the start; a spring that stretches across the load only slows
  double h = 0.8 / omega, before = 0, scale = 0;
  constexpr int most_steps = 100000, check = 50;
  // what rounding leaves where the scene starts at rest: the forces cancel to some ulps of what springs over the
  // scene's size could do
  const double rounding = 1e-13 * omega * omega * scene.size();
  for (int i = 0; i < most_steps; ++i) {
    system.acceleration(s, a);
    if (i % check == 0) {
      if (!a.allFinite()) return std::nullopt;
      const double rms = a.norm();
      scale = std::max(scale, rms);
      if (rms <= std::max(rounding, 1e-5 * scale)) {
        s.v.setZero();
        return s;
      }
    }
    s.v += h * a;
    const double kinetic = (s.v.colwise().squaredNorm() * model.particles.mass).value();
    if (kinetic < before) {
      s.v.setZero();
      before = 0;
      continue;
    }
    before = kinetic;
    s.x += h * s.v;
  }
  return std::nullopt;
}

}  // namespace crosscheck
