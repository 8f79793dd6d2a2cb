// Who carries which force in the deformable world.
#include "reference/bullet/deformable_forces.h"

#include <fmt/format.h>

#include <set>

#include "mysim/errors.h"

namespace crosscheck::bullet {
namespace {

std::set<double> stiffnesses(const Springs& springs) {
  std::set<double> all;
  for (const Spring& s : springs.list) all.insert(s.k);
  return all;
}

/// The one coefficient of dashpots that lie along all springs, in their order: what Bullet's own force can carry.
std::optional<double> one_dashpot_each(const Model& model) {
  const auto* springs = model.find<Springs>();
  const auto* dashpots = model.find<Dashpots>();
  if (!springs || !dashpots || springs->list.size() != dashpots->list.size() || model.particles.move)
    return std::nullopt;
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
  const Model& model = scene.model;
  NetForce::Parts ours;
  ours.implicit = implicit;
  carry_drag(ours);
  carry_springs(ours, shipped);
  if ((ours.wind = model.find<Wind>()))
    mapped_["wind"] = "force class of our own: Bullet's deformable world has no wind";
  if ((ours.air = model.find<Aerodynamics>()))
    mapped_["wind on triangles"] = "force class of our own: Bullet's deformable world has no wind";
  if (spring_force_) world.addForce(&body.body(), spring_force_.get());
  if (ours.any()) {
    net_force_ = std::make_unique<NetForce>(ours, scene, body);
    world.addForce(&body.body(), net_force_.get());
  }
  if (const auto* gravity = model.find<Gravity>()) {
    gravity_force_ = std::make_unique<btDeformableGravityForce>(to_bullet(gravity->acceleration / factor_));
    world.addForce(&body.body(), gravity_force_.get());
    mapped_["gravity"] = factor_ != 1 ? "gravity force, g / (1 - h gamma)" : "gravity force, g as it is";
  }
}

void DeformableForces::carry_drag(NetForce::Parts& ours) {
  const auto* drag = scene_.model.find<Drag>();
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

void DeformableForces::carry_springs(NetForce::Parts& ours, bool shipped) {
  const auto* springs = scene_.model.find<Springs>();
  const auto* dashpots = scene_.model.find<Dashpots>();
  const bool can = springs && springs->law == SpringLaw::hooke && stiffnesses(*springs).size() <= 2;
  if (shipped && springs && !can)
    throw Unsupported("Bullet's own mass-spring force has Hooke's law and two stiffnesses at most");
  const std::optional<double> dashpot = one_dashpot_each(scene_.model);
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
  const int n = scene_.model.particles.size();
  std::vector<double> rates(n, scene_body_.body().m_cfg.drag / h_);
  bool told = implicit_ ? own != nullptr : true;
  if (own && scene_.model.find<Aerodynamics>()) told = told && factor_ != 1;  // the air looks at velocities too
  if (own && told && !scene_.model.find<Aerodynamics>()) {
    // what a common velocity changes of our own forces: their drag
    auto& nodes = scene_body_.body().m_nodes;
    btAlignedObjectArray<btVector3> kept, still, moving;
    for (int i = 0; i < nodes.size(); ++i) kept.push_back(nodes[i].m_v), nodes[i].m_v = btVector3(0, 0, 0);
    still.resize(n, btVector3(0, 0, 0));
    moving.resize(n, btVector3(0, 0, 0));
    own->addScaledExplicitForce(1, still);
    for (int i = 0; i < nodes.size(); ++i) nodes[i].m_v = btVector3(1, 0, 0);
    own->addScaledExplicitForce(1, moving);
    for (int i = 0; i < nodes.size(); ++i) nodes[i].m_v = kept[i];
    for (int i = 0; i < n; ++i) {
      const auto& node = nodes[scene_body_.node_of(i)];
      rates[i] += factor_ * (still[node.index].x() - moving[node.index].x()) / scene_.model.particles.mass[i];
    }
  }
  if (told) r.drag = rates;
  if (scene_.model.find<Springs>() || scene_.model.find<Dashpots>()) r.probe = probe(in_world);
  r.mapped.insert(mapped_.begin(), mapped_.end());
}

SpringProbe DeformableForces::probe(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world) const {
  const Particles& particles = scene_.model.particles;
  auto& nodes = scene_body_.body().m_nodes;
  const int n = nodes.size();
  SpringProbe p{1.1 * scene_.start.x, Points::Zero(3, n), Points(3, n), Points::Zero(3, n)};
  // some velocity that is no rigid motion: the coordinates, turned by one place
  p.v << p.x.row(1), p.x.row(2), p.x.row(0);
  std::vector<btSoftBody::Node> kept(n);
  for (int i = 0; i < n; ++i) {
    if (particles.pinned[i]) p.v.col(i) = particles.move ? velocity_at(*particles.move, t_) : Vec3::Zero();
    auto& node = nodes[scene_body_.node_of(i)];
    kept[i] = node;
    node.m_q = node.m_x = to_bullet(p.x.col(i));
    node.m_v = particles.pinned[i] ? btVector3(0, 0, 0) : to_bullet(p.v.col(i));
  }
  btAlignedObjectArray<btVector3> elastic, damping;
  elastic.resize(n, btVector3(0, 0, 0));
  damping.resize(n, btVector3(0, 0, 0));
  for (int i = 0; i < in_world.size(); ++i) {
    if (in_world[i]->getForceType() == BT_MASSSPRING_FORCE)
      static_cast<btDeformableMassSpringForce*>(in_world[i])
          ->addScaledElasticForce(static_cast<btScalar>(factor_), elastic);
    if (in_world[i]->getForceType() == NetForce::type)
      static_cast<NetForce*>(in_world[i])->addScaledElasticForce(static_cast<btScalar>(factor_), elastic);
    in_world[i]->addScaledDampingForce(1, damping);
  }
  for (int i = 0; i < n; ++i) {
    auto& node = nodes[scene_body_.node_of(i)];
    p.force.col(i) = from_bullet(elastic[node.index]);
    p.damping.col(i) = from_bullet(damping[node.index]);
    node.m_x = kept[i].m_x, node.m_q = kept[i].m_q, node.m_v = kept[i].m_v;
  }
  return p;
}

}  // namespace crosscheck::bullet
