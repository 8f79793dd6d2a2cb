#include "experiments/check/compare.h"

#include <fmt/format.h>

#include <cmath>

#include "reference/which_rule.h"

namespace crosscheck {

RelationResult farthest(std::string what, const Trajectory& a, const Trajectory& b, const std::vector<double>& bound,
                        double lengths) {
  if (!(bound.at(1) <= 0.01 * lengths))
    throw CannotBeAsked(fmt::format("rounding alone may grow to {:.2g} m before the first sample", bound[1]));
  RelationResult worst{std::move(what), "m", 0, bound[1]};
  std::optional<double> since;
  for (int i = 0; i < a.frames() && bound[i] <= 0.01 * lengths; ++i) {
    const double apart = largest_column(a.x[i] - b.x[i]);
    const RelationResult here{worst.what, "m", apart, bound[i]};
    if (!here.holds() && !since) since = a.t[i];
    if (here.ratio() > worst.ratio()) worst = here;
  }
  worst.since = since;
  return worst;
}

Trajectory with_positions(Trajectory path, const std::function<Points(const Points&)>& change) {
  for (Points& x : path.x) x = change(x);
  return path;
}

std::vector<double> distances(const Trajectory& a, const Trajectory& b) {
  std::vector<double> apart(a.frames());
  double most = 0;
  for (int i = 0; i < a.frames(); ++i) apart[i] = most = std::max(most, largest_column(a.x[i] - b.x[i]));
  return apart;
}

std::vector<double> sum_of(std::vector<double> a, const std::vector<double>& b) {
  for (size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

bool chooses_steps(const Method& method) {
  return method.adaptive || (method.identify && method.identify().kind == FoundRule::own_steps);
}

int order_of(const Method& method) {
  const Stepper* rule = stepper_of(method);
  return rule ? rule->order : 1;
}

Outside outside_of(const Scene& scene) {
  Outside o;
  const Particles& p = scene.model.particles;
  o.pins = !p.pins.empty();
  o.changing = p.move.has_value();
  for (const Term& term : scene.model.terms)
    std::visit(Overloaded{[&](const Rotation&) { o.field = true; }, [&](const Gravity&) { o.gravity = true; },
                          [](const Springs&) {}, [&](const Bending&) { o.bending = true; },
                          [&](const Dashpots&) { o.dashpots = true; },
                          [&](const Constraints&) { o.constraints = true; }, [&](const Drag&) { o.drag = true; },
                          [&](const Wind& w) { o.wind = true, o.changing |= w.acceleration.gusts.has_value(); },
                          [&](const Aerodynamics& a) { o.air = true, o.changing |= a.velocity.gusts.has_value(); },
                          [&](const OneOf<Spheres, Planes> auto& s) { o.contact = true, o.changing |= s.moving(); }},
               term);
  return o;
}

bool springs_at_rest(const Scene& scene) {
  if (const auto* bending = scene.model.find<Bending>())
    for (const Bending::Stencil& s : bending->list)
      if (bent(s, scene.start.x).norm() > 1e-12 * scene.size()) return false;
  const auto* springs = scene.model.find<Springs>();
  if (!springs) return true;
  for (const Spring& s : springs->list)
    if (std::abs((scene.start.x.col(s.a) - scene.start.x.col(s.b)).norm() - s.rest) > 1e-12 * scene.size())
      return false;
  return true;
}

std::vector<Spring> hanging_chain_of(const Scene& scene) {
  const Outside o = outside_of(scene);
  const auto* springs = scene.model.find<Springs>();
  const int n = scene.model.particles.size();
  if (!springs || !o.gravity || !(o.drag || o.dashpots) || o.wind || o.air || o.contact || o.constraints || o.field ||
      o.bending || o.changing || scene.model.particles.pins != std::vector<int>{0} ||
      static_cast<int>(springs->list.size()) != n - 1)
    return {};
  std::vector<Spring> chain(n - 1, Spring{-1, -1, 0, 0, Family::single});
  for (const Spring& s : springs->list) {
    if (std::abs(s.a - s.b) != 1) return {};
    chain[std::min(s.a, s.b)] = s;
  }
  for (const Spring& s : chain)
    if (s.a < 0) return {};
  return chain;
}

}  // namespace crosscheck
