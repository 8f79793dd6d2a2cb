// Who carries which force in the deformable world.
#include "reference/bullet/deformable_forces.h"

#include <fmt/format.h>

#include <set>

#include "mysim/errors.h"
#include "reference/bullet/probe_state.h"

namespace crosscheck::bullet {
namespace {

std::set<double> stiffnesses(const Springs& springs) {
  std::set<double> all;
  for (const Spring& s : springs.list) all.insert(s.k);
  return all;
}

/// The one coefficient of dashpots that lie along all springs, in their order: what Bullet's own force can carry.
std::optional<double> one_dashpot_each(const Springs* springs, const Dashpots* dashpots) {
  if (!springs || !dashpots || springs->list.size() != dashpots->list.size()) return std::nullopt;
  for (size_t i = 0; i < springs->list.size(); ++i)
    if (springs->list[i].a != dashpots->list[i].a || springs->list[i].b != dashpots->list[i].b ||
        dashpots->list[i].c != dashpots->list[0].c)
      return std::nullopt;
  return dashpots->list[0].c;
}

}  // namespace

DeformableForces::DeformableForces(const Scene& scene, double h, bool implicit, bool shipped, SceneBody& body,
                                   btDeformableMultiBodyDynamicsWorld& world)
    : scene_(scene), h_(h), implicit_(implicit), scene_body_(body) {
  NetForce::Parts asked, ours;
  const Gravity* gravity = nullptr;
  const Overloaded take{
      [&](const Gravity& t) { gravity = &t; },
      [&](const Springs& t) { asked.springs = &t; },
      [&](const Dashpots& t) { asked.dashpots = &t; },
      [&](const Drag& t) { asked.drag = &t; },
      [&](const Wind& t) {
        ours.wind = &t;
        mapped_["wind"] = "force class of our own: Bullet's deformable world has no wind";
      },
      [&](const Aerodynamics& t) {
        ours.air = &t;
        mapped_["wind on triangles"] = "force class of our own: Bullet's deformable world has no wind";
      },
      [](const Spheres&) {},                            // no forces: obstacles.h
      [](const OneOf<Rotation, Constraints> auto&) {},  // refused before a world is built
  };
  for (const Term& term : scene.model.terms) std::visit(take, term);
  ours.implicit = implicit;
  carry_drag(asked.drag, ours);
  carry_springs(asked.springs, asked.dashpots, ours, shipped);
  if (spring_force_) world.addForce(&body.body(), spring_force_.get());
  if (ours.any()) {
    net_force_ = std::make_unique<NetForce>(ours, scene, body);
    world.addForce(&body.body(), net_force_.get());
  }
  if (gravity) {
    gravity_force_ = std::make_unique<btDeformableGravityForce>(to_bullet(gravity->acceleration / factor_));
    world.addForce(&body.body(), gravity_force_.get());
    mapped_["gravity"] = factor_ != 1 ? "gravity force, g / (1 - h gamma)" : "gravity force, g as it is";
  }
}

void DeformableForces::carry_drag(const Drag* drag, NetForce::Parts& ours) {
  if (!drag) return;
  const std::optional<double> rate = uniform_drag_rate(scene_.model);
  auto& factor = scene_body_.body().m_cfg.drag;
  factor = 0;
  if (implicit_) {
    ours.drag = drag;
    mapped_["drag"] = "force class of our own, implicit: the implicit world ignores the body's drag factor";
  } else if (rate && h_ * *rate < 1) {
    factor = static_cast<btScalar>(h_ * *rate);
    factor_ = 1 - factor;
    ours.factor = 1 / factor_;
    mapped_["drag"] = fmt::format("body drag factor h gamma = {:.6g}", double(factor));
  } else {
    ours.drag = drag;
    mapped_["drag"] = "force class of our own: one coefficient per particle";
  }
}

void DeformableForces::carry_springs(const Springs* springs, const Dashpots* dashpots, NetForce::Parts& ours,
                                     bool shipped) {
  const bool can = springs && springs->law == SpringLaw::hooke && stiffnesses(*springs).size() <= 2;
  if (shipped && springs && !can)
    throw Unsupported("Bullet's own mass-spring force has Hooke's law and two stiffnesses at most");
  const std::optional<double> dashpot =
      scene_.model.particles.move ? std::nullopt : one_dashpot_each(springs, dashpots);
  if (can && (shipped || !implicit_)) {
    const std::set<double> all = stiffnesses(*springs);
    auto& links = scene_body_.body().m_links;
    for (size_t l = 0; l < springs->list.size(); ++l)
      links[static_cast<int>(l)].m_bbending = springs->list[l].k != *all.begin();
    spring_force_ = std::make_unique<btDeformableMassSpringForce>(static_cast<btScalar>(*all.begin() / factor_),
                                                                  static_cast<btScalar>(dashpot.value_or(0)), true,
                                                                  *all.rbegin() / factor_);
    mapped_["stiffness"] = factor_ != 1 ? "Bullet's own mass-spring force, k / (1 - h gamma)"
                                        : "Bullet's own mass-spring force, k as it is";
    if (dashpot) mapped_["dashpots"] = "Bullet's own mass-spring force, solved implicitly";
  } else if (springs) {
    ours.springs = springs;
    mapped_["stiffness"] = implicit_ ? "force class of our own: second derivatives without their negative part"
                           : springs->law == SpringLaw::hooke
                               ? "force class of our own: one stiffness per spring"
                               : "force class of our own: the scene's law, one stiffness per spring";
  }
  if (dashpots && !(spring_force_ && dashpot)) {
    ours.dashpots = dashpots;
    mapped_["dashpots"] = "force class of our own, solved implicitly";
  }
}

void DeformableForces::set_time(double t) {
  t_ = t;
  if (net_force_) net_force_->set_time(t);
}

void DeformableForces::read_back(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world, Readback& r) const {
  Vec3 gravity = Vec3::Zero();
  NetForce* own = nullptr;
  for (int i = 0; i < in_world.size(); ++i) {
    if (in_world[i]->getForceType() == BT_GRAVITY_FORCE)
      gravity += from_bullet(static_cast<btDeformableGravityForce*>(in_world[i])->m_gravity) * factor_;
    if (in_world[i]->getForceType() == NetForce::type) own = static_cast<NetForce*>(in_world[i]);
  }
  r.gravity = gravity;
  if (const auto rates = drag_rates(own)) r.drag = *rates;
  r.probe = probe(in_world);
  r.mapped.insert(mapped_.begin(), mapped_.end());
}

std::optional<std::vector<double>> DeformableForces::drag_rates(NetForce* own) const {
  const Particles& particles = scene_.model.particles;
  auto& nodes = scene_body_.body().m_nodes;
  const int n = nodes.size();
  // the implicit world ignores the body's drag factor
  std::vector<double> rates(n, implicit_ ? 0 : scene_body_.body().m_cfg.drag / h_);
  if (!own) return rates;
  btDeformableLagrangianForce::TVStack still, moving, common;
  for (auto* stack : {&still, &moving}) stack->resize(n, btVector3(0, 0, 0));
  common.resize(n, btVector3(1, 0, 0));
  if (implicit_) {
    own->addScaledDampingForceDifferential(1, common, moving);
  } else {
    // what a common velocity changes of our own forces is their drag, unless air that looks at velocities is there too
    if (own->parts().air) return own->parts().drag ? std::nullopt : std::optional(rates);
    ProbeState placed(scene_, scene_body_, t_);
    placed.stop();
    own->addScaledExplicitForce(1, still);
    for (int i = 0; i < n; ++i) nodes[i].m_v = common[i];
    own->addScaledExplicitForce(1, moving);
  }
  for (int i = 0; i < n; ++i) {
    const int index = nodes[scene_body_.node_of(i)].index;
    rates[i] += factor_ * (still[index].x() - moving[index].x()) / particles.mass[i];
  }
  return rates;
}

ForceProbe DeformableForces::probe(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world) const {
  const Particles& particles = scene_.model.particles;
  const auto by = static_cast<btScalar>(factor_);
  ProbeState placed(scene_, scene_body_, t_);
  using Stack = btDeformableLagrangianForce::TVStack;
  Stack springs, dashpots, all;
  for (Stack* stack : {&springs, &dashpots, &all}) stack->resize(particles.size(), btVector3(0, 0, 0));
  for (int i = 0; i < in_world.size(); ++i) {
    if (in_world[i]->getForceType() == BT_MASSSPRING_FORCE)
      static_cast<btDeformableMassSpringForce*>(in_world[i])->addScaledElasticForce(by, springs);
    if (in_world[i]->getForceType() == NetForce::type)
      static_cast<NetForce*>(in_world[i])->addScaledElasticForce(by, springs);
    in_world[i]->addScaledDampingForce(1, dashpots);
  }
  placed.stop();
  for (int i = 0; i < in_world.size(); ++i)
    if (in_world[i]->getForceType() != BT_GRAVITY_FORCE) in_world[i]->addScaledExplicitForce(by, all);
  for (int i = 0; i < all.size(); ++i) all[i] -= springs[i];
  return placed.probe(springs, dashpots, all);
}

}  // namespace crosscheck::bullet
