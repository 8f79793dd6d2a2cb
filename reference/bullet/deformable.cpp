#include "reference/bullet/deformable.h"

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mysim/base/errors.h"
#include "reference/bullet/parameters.h"
#include "reference/bullet/soft_body.h"

namespace crosscheck::bullet {

SceneForce::SceneForce(const CarriedTerms& carried, const Scene& scene, const SoftBody& body)
    : carried_(carried), scene_(scene), soft_body_(body) {
  if (carried.air) state_ = scene.start, aerodynamic_forces_.f = Points::Zero(3, scene.model.particles.size());
}

const btSoftBody::Node& SceneForce::node(int particle) const {
  return m_softBodies[0]->m_nodes[soft_body_.node_of(particle)];
}

btVector3 SceneForce::velocity(int particle) const {
  const Particles& particles = scene_.model.particles;
  if (particles.pinned[particle] && particles.move) return to_bullet(velocity_at(*particles.move, t_));
  return node(particle).m_v;
}

btVector3 SceneForce::dashpot_axis(int a, int b) const {
  // implicit world: the positions that the springs use; explicit world: those that Bullet's own dashpots use
  return carried_.implicit ? node(a).m_q - node(b).m_q : node(a).m_x - node(b).m_x;
}

void SceneForce::addScaledElasticForce(btScalar scale, TVStack& force) {
  if (!carried_.springs) return;
  for (const Spring& s : carried_.springs->list) {
    const auto &a = node(s.a), &b = node(s.b);
    const btVector3 d = a.m_q - b.m_q;
    const btScalar length = d.length();
    if (length == 0) continue;
    const btVector3 f = d * static_cast<btScalar>(-scale * carried_.factor *
                                                  tension_of(s, carried_.springs->law, length).force / length);
    force[a.index] += f;
    force[b.index] -= f;
  }
}

void SceneForce::add_bending_force(btScalar scale, TVStack& force) {
  if (!carried_.bending) return;
  for (const Bending::Stencil& s : carried_.bending->list) {
    btVector3 c(0, 0, 0);
    for (int i = 0; i < s.size; ++i) c += node(s.particle[i]).m_q * static_cast<btScalar>(s.weight[i]);
    c *= static_cast<btScalar>(-scale * carried_.factor * s.k);
    for (int i = 0; i < s.size; ++i) force[node(s.particle[i]).index] += c * static_cast<btScalar>(s.weight[i]);
  }
}

void SceneForce::addScaledElasticForceDifferential(btScalar scale, const TVStack& dx, TVStack& df) {
  if (carried_.bending)
    for (const Bending::Stencil& s : carried_.bending->list) {
      btVector3 c(0, 0, 0);
      for (int i = 0; i < s.size; ++i) c += dx[node(s.particle[i]).index] * static_cast<btScalar>(s.weight[i]);
      c *= static_cast<btScalar>(-scale * carried_.factor * s.k);
      for (int i = 0; i < s.size; ++i) df[node(s.particle[i]).index] += c * static_cast<btScalar>(s.weight[i]);
    }
  if (!carried_.springs) return;
  for (const Spring& s : carried_.springs->list) {
    const auto &a = node(s.a), &b = node(s.b);
    btVector3 n = a.m_q - b.m_q;
    const btScalar length = n.length();
    if (length == 0) continue;
    n /= length;
    const Tension tension = tension_of(s, carried_.springs->law, length);
    const double along = std::max(tension.slope, 0.0), across = std::max(tension.force / length, 0.0);
    const btVector3 moved = dx[a.index] - dx[b.index];
    const btVector3 f =
        n * static_cast<btScalar>((along - across) * n.dot(moved)) + moved * static_cast<btScalar>(across);
    df[a.index] -= f * static_cast<btScalar>(scale * carried_.factor);
    df[b.index] += f * static_cast<btScalar>(scale * carried_.factor);
  }
}

void SceneForce::add_particle_forces(btScalar scale, TVStack& force) {
  const Particles& particles = scene_.model.particles;
  const auto by = static_cast<btScalar>(scale * carried_.factor);
  const btVector3 wind = carried_.wind ? to_bullet(carried_.wind->acceleration.at(t_)) : btVector3(0, 0, 0);
  for (int i = 0; i < particles.size(); ++i) {
    if (carried_.wind) force[node(i).index] += wind * (by * static_cast<btScalar>(particles.mass[i]));
    if (carried_.drag) force[node(i).index] -= node(i).m_v * (by * static_cast<btScalar>(carried_.drag->c[i]));
  }
  if (!carried_.air) return;
  state_.t = t_;
  for (int i = 0; i < particles.size(); ++i) {
    state_.x.col(i) = from_bullet(node(i).m_q);
    state_.v.col(i) = from_bullet(velocity(i));
  }
  aerodynamic_forces_.clear();
  add_force(*carried_.air, particles, state_, aerodynamic_forces_);
  for (int i = 0; i < particles.size(); ++i) force[node(i).index] += to_bullet(aerodynamic_forces_.f.col(i)) * by;
}

void SceneForce::addScaledExplicitForce(btScalar scale, TVStack& force) {
  addScaledElasticForce(scale, force);
  add_bending_force(scale, force);
  add_particle_forces(scale, force);
}

void SceneForce::addScaledForces(btScalar scale, TVStack& force) {
  addScaledExplicitForce(scale, force);
  addScaledDampingForce(scale, force);
}

void SceneForce::addScaledDampingForce(btScalar scale, TVStack& force) {
  if (!carried_.dashpots) return;
  for (const auto& [a, b, c] : carried_.dashpots->list) {
    const btVector3 d = dashpot_axis(a, b);
    if (d.length2() == 0) continue;
    const btVector3 f = d * static_cast<btScalar>(-scale * c * (velocity(a) - velocity(b)).dot(d) / d.length2());
    force[node(a).index] += f;
    force[node(b).index] -= f;
  }
}

void SceneForce::addScaledDampingForceDifferential(btScalar scale, const TVStack& dv, TVStack& df) {
  if (carried_.dashpots)
    for (const auto& [a, b, c] : carried_.dashpots->list) {
      const btVector3 d = dashpot_axis(a, b);
      if (d.length2() == 0) continue;
      const btVector3 change = dv[node(a).index] - dv[node(b).index];
      const btVector3 f = d * static_cast<btScalar>(scale * c * change.dot(d) / d.length2());
      df[node(a).index] -= f;
      df[node(b).index] += f;
    }
  if (carried_.drag && carried_.implicit)
    for (int i = 0; i < scene_.model.particles.size(); ++i)
      df[node(i).index] -= dv[node(i).index] * static_cast<btScalar>(scale * carried_.factor * carried_.drag->c[i]);
}

void SceneForce::buildDampingForceDifferentialDiagonal(btScalar scale, TVStack& diagonal) {
  if (!carried_.dashpots) return;
  for (const auto& [a, b, c] : carried_.dashpots->list) {
    const btVector3 d = dashpot_axis(a, b);
    if (d.length2() == 0) continue;
    const btVector3 own = d * d * static_cast<btScalar>(scale * c / d.length2());
    if (node(a).m_im > 0) diagonal[node(a).index] -= own;
    if (node(b).m_im > 0) diagonal[node(b).index] -= own;
  }
}

namespace {

std::set<double> stiffnesses(const Springs& springs) {
  std::set<double> all;
  for (const Spring& s : springs.list) all.insert(s.k);
  return all;
}

/// The coefficient of the dashpots if all are equal and there is one dashpot along each spring, in the springs' order,
/// as Bullet's own force requires; otherwise nullopt.
std::optional<double> one_dashpot_each(const Springs* springs, const Dashpots* dashpots) {
  if (!springs || !dashpots || springs->list.size() != dashpots->list.size()) return std::nullopt;
  for (size_t i = 0; i < springs->list.size(); ++i)
    if (springs->list[i].a != dashpots->list[i].a || springs->list[i].b != dashpots->list[i].b ||
        dashpots->list[i].c != dashpots->list[0].c)
      return std::nullopt;
  return dashpots->list[0].c;
}

}  // namespace

DeformableForces::DeformableForces(const Scene& scene, double h, bool implicit, bool shipped, SoftBody& body,
                                   btDeformableMultiBodyDynamicsWorld& world)
    : scene_(scene), h_(h), implicit_(implicit), soft_body_(body) {
  SceneForce::CarriedTerms in_scene, ours;
  const Gravity* gravity = nullptr;
  const Overloaded take{
      [&](const Gravity& t) { gravity = &t; },
      [&](const Springs& t) { in_scene.springs = &t; },
      [&](const Bending& t) {
        ours.bending = &t;
        mapped_["bending"] = "force class of our own: Bullet's deformable world has none for sheets of particles";
      },
      [&](const Dashpots& t) { in_scene.dashpots = &t; },
      [&](const Drag& t) { in_scene.drag = &t; },
      [&](const Wind& t) {
        ours.wind = &t;
        mapped_["wind"] = "force class of our own: Bullet's deformable world has no wind";
      },
      [&](const Aerodynamics& t) {
        ours.air = &t;
        mapped_["wind on triangles"] = "force class of our own: Bullet's deformable world has no wind";
      },
      [](const OneOf<Spheres, Planes> auto&) {},        // not forces (see soft_body.h)
      [](const OneOf<Rotation, Constraints> auto&) {},  // refused before a world is built
  };
  for (const Term& term : scene.model.terms) std::visit(take, term);
  ours.implicit = implicit;
  carry_drag(in_scene.drag, ours);
  carry_springs(in_scene.springs, in_scene.dashpots, ours, shipped);
  if (spring_force_) world.addForce(&body.body(), spring_force_.get());
  if (ours.any()) {
    scene_force_ = std::make_unique<SceneForce>(ours, scene, body);
    world.addForce(&body.body(), scene_force_.get());
  }
  if (gravity) {
    gravity_force_ = std::make_unique<btDeformableGravityForce>(
        to_bullet(gravity->acceleration / factor_ / body.body().m_gravityFactor));
    world.addForce(&body.body(), gravity_force_.get());
    mapped_["gravity"] = factor_ != 1 ? "gravity force, g / (1 - h gamma)" : "gravity force, g unchanged";
  }
}

void DeformableForces::carry_drag(const Drag* drag, SceneForce::CarriedTerms& ours) {
  if (!drag) return;
  const std::optional<double> rate = uniform_drag_rate(scene_.model);
  auto& factor = soft_body_.body().m_cfg.drag;
  factor = 0;
  if (implicit_) {
    ours.drag = drag;
    mapped_["drag"] = "force class of our own, implicit: the implicit world ignores the body's drag factor";
  } else if (rate && h_ * *rate < 1) {
    factor = static_cast<btScalar>(drag_factor(*rate, h_));
    factor_ = 1 - factor;
    ours.factor = before_drag(1, factor);
    mapped_["drag"] = fmt::format("body drag factor h gamma = {:.6g}", double(factor));
  } else {
    ours.drag = drag;
    mapped_["drag"] = "force class of our own: one coefficient per particle";
  }
}

void DeformableForces::carry_springs(const Springs* springs, const Dashpots* dashpots, SceneForce::CarriedTerms& ours,
                                     bool shipped) {
  const bool can = springs && springs->law == SpringLaw::hooke && stiffnesses(*springs).size() <= 2;
  if (shipped && springs && !can)
    throw Unsupported("Bullet's own mass-spring force supports only Hooke's law and at most two stiffnesses");
  const std::optional<double> dashpot =
      scene_.model.particles.move ? std::nullopt : one_dashpot_each(springs, dashpots);
  if (can && (shipped || !implicit_)) {
    const double factor = soft_body_.body().m_cfg.drag;
    const std::set<double> all = stiffnesses(*springs);
    auto& links = soft_body_.body().m_links;
    for (size_t l = 0; l < springs->list.size(); ++l)
      links[static_cast<int>(l)].m_bbending = springs->list[l].k != *all.begin();
    spring_force_ = std::make_unique<btDeformableMassSpringForce>(
        static_cast<btScalar>(before_drag(*all.begin(), factor)), static_cast<btScalar>(dashpot.value_or(0)), true,
        before_drag(*all.rbegin(), factor));
    mapped_["stiffness"] = factor_ != 1 ? "Bullet's own mass-spring force, k / (1 - h gamma)"
                                        : "Bullet's own mass-spring force, k unchanged";
    if (dashpot) mapped_["dashpots"] = "Bullet's own mass-spring force, solved implicitly";
  } else if (springs) {
    ours.springs = springs;
    mapped_["stiffness"] = implicit_ ? "force class of our own: second derivatives made positive semidefinite"
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
  if (scene_force_) scene_force_->set_time(t);
}

void DeformableForces::read_back(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world, Readback& r) const {
  Vec3 gravity = Vec3::Zero();
  SceneForce* own = nullptr;
  for (int i = 0; i < in_world.size(); ++i) {
    if (in_world[i]->getForceType() == BT_GRAVITY_FORCE)
      gravity += from_bullet(static_cast<btDeformableGravityForce*>(in_world[i])->m_gravity) * factor_ *
                 double(soft_body_.body().m_gravityFactor);
    if (in_world[i]->getForceType() == SceneForce::type) own = static_cast<SceneForce*>(in_world[i]);
  }
  r.gravity = gravity;
  if (const auto rates = drag_rates(own)) r.drag = *rates;
  r.probe = probe(in_world);
  r.mapped.insert(mapped_.begin(), mapped_.end());
}

std::optional<std::vector<double>> DeformableForces::drag_rates(SceneForce* own) const {
  const Particles& particles = scene_.model.particles;
  auto& nodes = soft_body_.body().m_nodes;
  const int n = nodes.size();
  // the implicit world ignores the body's drag factor
  std::vector<double> rates(n, implicit_ ? 0 : soft_body_.body().m_cfg.drag / h_);
  if (!own) return rates;
  btDeformableLagrangianForce::TVStack still, moving, common;
  for (auto* stack : {&still, &moving}) stack->resize(n, btVector3(0, 0, 0));
  common.resize(n, btVector3(1, 0, 0));
  if (implicit_) {
    own->addScaledDampingForceDifferential(1, common, moving);
  } else {
    // without aerodynamic force, drag is the only one of Crosscheck's forces that a common velocity changes
    if (own->carried().air) return own->carried().drag ? std::nullopt : std::optional(rates);
    ProbeState placed(scene_, soft_body_, t_);
    placed.stop();
    own->addScaledExplicitForce(1, still);
    for (int i = 0; i < n; ++i) nodes[i].m_v = common[i];
    own->addScaledExplicitForce(1, moving);
  }
  for (int i = 0; i < n; ++i) {
    const int index = nodes[soft_body_.node_of(i)].index;
    rates[i] += factor_ * (still[index].x() - moving[index].x()) / particles.mass[i];
  }
  return rates;
}

ForceProbe DeformableForces::probe(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world) const {
  const Particles& particles = scene_.model.particles;
  const auto by = static_cast<btScalar>(factor_);
  ProbeState placed(scene_, soft_body_, t_);
  using Stack = btDeformableLagrangianForce::TVStack;
  Stack springs, bending, elastic, dashpots, all;  // elastic: springs and bending, in the world's order
  for (Stack* stack : {&springs, &bending, &elastic, &dashpots, &all})
    stack->resize(particles.size(), btVector3(0, 0, 0));
  for (int i = 0; i < in_world.size(); ++i) {
    if (in_world[i]->getForceType() == BT_MASSSPRING_FORCE)
      for (Stack* stack : {&springs, &elastic})
        static_cast<btDeformableMassSpringForce*>(in_world[i])->addScaledElasticForce(by, *stack);
    if (in_world[i]->getForceType() == SceneForce::type) {
      auto* own = static_cast<SceneForce*>(in_world[i]);
      for (Stack* stack : {&springs, &elastic}) own->addScaledElasticForce(by, *stack);
      for (Stack* stack : {&bending, &elastic}) own->add_bending_force(by, *stack);
    }
    in_world[i]->addScaledDampingForce(1, dashpots);
  }
  placed.stop();
  for (int i = 0; i < in_world.size(); ++i)
    if (in_world[i]->getForceType() != BT_GRAVITY_FORCE) in_world[i]->addScaledExplicitForce(by, all);
  for (int i = 0; i < all.size(); ++i) all[i] -= elastic[i];
  return placed.probe(springs, bending, dashpots, all);
}

namespace {

/// Gives access to the tolerance of Bullet's linear solver, which is protected.
class BodySolver : public btDeformableBodySolver {
 public:
  void set_tolerance(double squared) {
    m_cg.m_tolerance = static_cast<btScalar>(squared);
    // conjugate gradients with 3 n unknowns: the default of 300 may be reached before the tolerance on a large cloth
    m_cg.m_maxIterations = 10000;
  }
};

class DeformableWorld : public SoftBodyWorld<btDeformableMultiBodyDynamicsWorld> {
 public:
  DeformableWorld(const Scene& scene, double h, const DeformableSettings& settings)
      : SoftBodyWorld(scene, h, settings.defaults), implicit_(settings.implicit) {
    if (scene.model.find<Constraints>())
      throw Unsupported("Bullet's deformable world has springs only, no hard distances");
    solver_.setDeformableSolver(&body_solver_);
    world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&collision_.dispatcher, &collision_.broadphase,
                                                                  &solver_, &collision_.configuration, &body_solver_);
    world_->setImplicit(implicit_);
    world_->setUseProjection(implicit_ && settings.projected);
    if (settings.tight) body_solver_.set_tolerance(1e-28);
    world_->getWorldInfo().m_sparsesdf.setDefaultVoxelsz(static_cast<btScalar>(settings.voxel));
    world_->getWorldInfo().m_sparsesdf.Reset();
    soft_body_ = std::make_unique<SoftBody>(scene, world_->getWorldInfo(), settings.defaults);
    if (has_contact(scene.model))
      body().m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
    add_to_world();
    try {
      forces_ = std::make_unique<DeformableForces>(scene, h, implicit_, settings.shipped, *soft_body_, *world_);
    } catch (...) {
      remove_all();  // without this, the world would be destroyed after its solvers
      throw;
    }
  }

  ~DeformableWorld() override { remove_all(); }

  void step(double t, double t_next) override {
    forces_->set_time(implicit_ ? t_next : t);
    if (implicit_) soft_body_->place_pins(t_next);
    obstacles_.place(t_next);
    const double limit = (body().m_bounds[1] - body().m_bounds[0]).length() / h_;
    world_->stepSimulation(static_cast<btScalar>(h_), 0);
    soft_body_->place_pins(t_next);
    for (int i = 0; i < body().m_nodes.size() && !speed_limit_; ++i)
      // Bullet reduces a higher speed to exactly the limit; drag and contact may then reduce it slightly further
      if (body().m_nodes[i].m_im > 0 && !(body().m_nodes[i].m_v.length() < 0.999 * limit)) speed_limit_ = limit;
  }

  std::optional<Readback> read_back() override {
    Readback r = soft_body_->read_back();
    obstacles_.read_back(*world_, body(), r);
    r.later = prescribed_places();
    forces_->read_back(*body_solver_.getLagrangianForceArray(), r);
    return r;
  }

  std::optional<double> speed_limit() const { return speed_limit_; }

 private:
  bool implicit_;
  std::optional<double> speed_limit_;  // m/s, set once Bullet has limited a speed
  BodySolver body_solver_;
  btDeformableMultiBodyConstraintSolver solver_;
  std::unique_ptr<DeformableForces> forces_;
};

}  // namespace

Outcome run_deformable(const Scene& scene, const Run& run, Observer& observer, const DeformableSettings& settings) {
  DeformableWorld world(scene, time_grid(run).h, settings);
  Outcome out = run_loop(world, run, observer);
  out.evaluations = out.steps;
  if (scene.model.find<Spheres>())
    out.different_law.push_back(
        "contact: Bullet detects it at the proposed position but uses normal and gap of the old one (a tangent plane), "
        "so nodes hop by (v h)^2 / 2R on a sphere; at any step, normals are gradients of a grid of distances, which "
        "are off by up to a / 2R = " +
        normal_error_text(scene, settings.voxel) + "; friction is Coulomb's in both");
  if (scene.model.find<Planes>())
    out.different_law.push_back(
        "contact with planes: a node that lands gets the velocity that takes it to the plane by the end of the step, "
        "and loses it in the next one; it lags behind a moving plane by up to the plane's displacement in a step");
  if (scene.model.find<Dashpots>() && !settings.implicit)
    out.different_law.push_back("dashpots: Bullet solves them implicitly, at the end of the explicit step");
  if (const auto limit = world.speed_limit(); limit && out.verdict == Verdict::ok) {
    // a failed run keeps its verdict; a successful run in which a speed was limited has solved a different problem
    if (!settings.defaults.margin)
      throw Unsupported(fmt::format(
          "Bullet's deformable world limits speeds to the body's box over the step, here to {:.3g} m/s", *limit));
    out.different_law.push_back(
        fmt::format("speeds: limited to the body's box over the step, here to {:.3g} m/s", *limit));
  }
  return out;
}

}  // namespace crosscheck::bullet
