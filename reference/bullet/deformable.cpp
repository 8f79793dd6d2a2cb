// Bullet's deformable world, explicit mode.
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <fmt/format.h>

#include <optional>
#include <set>

#include "mysim/errors.h"
#include "reference/bullet/body_world.h"
#include "reference/bullet/net_force.h"
#include "reference/bullet/worlds.h"

namespace crosscheck::bullet {
namespace {

class DeformableWorld : public BodyWorld<btDeformableMultiBodyDynamicsWorld> {
 public:
  DeformableWorld(const Scene& scene, double h) : BodyWorld(scene, h) {
    if (scene.model.find<Constraints>())
      throw Unsupported("Bullet's deformable world has springs only, no hard distances");
    solver_.setDeformableSolver(&body_solver_);
    world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&stage_.dispatcher, &stage_.broadphase, &solver_,
                                                                  &stage_.configuration, &body_solver_);
    world_->setImplicit(false);
    // sphere error of the distance field at 0.02 m: 1e-4 m; at 0.005 m: 6e-6 m
    world_->getWorldInfo().m_sparsesdf.setDefaultVoxelsz(0.005);
    world_->getWorldInfo().m_sparsesdf.Reset();
    scene_body_ = std::make_unique<SceneBody>(scene, world_->getWorldInfo());
    if (scene.model.find<Spheres>())
      body().m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
    enter();
    add_forces();
  }

  ~DeformableWorld() override { tear_down(); }

  void step(double t, double t_next) override {
    if (net_force_) net_force_->set_time(t);
    const double limit = (body().m_bounds[1] - body().m_bounds[0]).length() / h_;
    world_->stepSimulation(h_, 0);
    scene_body_->place_pins(t_next);
    for (int i = 0; i < body().m_nodes.size() && !speed_limit_; ++i)
      // where the limit acts, a speed is put to it exactly; drag and contact may take a little off
      if (body().m_nodes[i].m_im > 0 && !(body().m_nodes[i].m_v.length() < 0.999 * limit)) speed_limit_ = limit;
  }

  std::optional<Readback> read_back() override {
    Readback r = scene_body_->read_back();
    if (gravity_force_) r.gravity = from_bullet(gravity_force_->m_gravity) * factor();
    // our own force class would only repeat what it was given: then nothing is attested
    if (scene_.model.find<Drag>() && shipped_drag_)
      r.drag = std::vector<double>(scene_.model.particles.size(), body().m_cfg.drag / h_);
    if (scene_.model.find<Springs>()) r.probe = probe();
    read_obstacle(r);
    r.mapped = mapped_;
    return r;
  }

  std::optional<double> speed_limit() const { return speed_limit_; }

 private:
  /// 1 - h gamma: what Bullet's drag leaves of a velocity in one step.
  double factor() const { return 1 - h_ * drag_rate_; }

  /// Bullet's own force where it can model the scene, ours for the rest.
  void add_forces() {
    const Model& model = scene_.model;
    const auto* springs = model.find<Springs>();
    const auto* wind = model.find<Wind>();
    const std::optional<double> rate = uniform_drag_rate(model);
    std::set<double> stiffness;
    if (springs)
      for (const Spring& s : springs->list) stiffness.insert(s.k);
    shipped_springs_ = (!springs || springs->law == SpringLaw::hooke) && stiffness.size() <= 2;
    shipped_drag_ = rate && h_ * *rate < 1;
    NetForce::Parts ours;
    if (shipped_drag_) {
      drag_rate_ = *rate;
      body().m_cfg.drag = h_ * drag_rate_;
      ours.factor = 1 / factor();
      if (drag_rate_ > 0) mapped_["drag"] = fmt::format("body drag factor h gamma = {:.6g}", h_ * drag_rate_);
    } else {
      body().m_cfg.drag = 0;
      ours.drag = model.find<Drag>();
      mapped_["drag"] = "force class of our own: one coefficient per particle";
    }
    if (shipped_springs_ && springs) {
      const double soft = *stiffness.begin() / factor(), hard = *stiffness.rbegin() / factor();
      for (int l = 0; l < body().m_links.size(); ++l)
        body().m_links[l].m_bbending = springs->list[l].k != *stiffness.begin();
      spring_force_ = std::make_unique<btDeformableMassSpringForce>(soft, 0.0, true, hard);
      world_->addForce(&body(), spring_force_.get());
      mapped_["stiffness"] = drag_rate_ > 0 ? "Bullet's own mass-spring force, k / (1 - h gamma)"
                                            : "Bullet's own mass-spring force, k as it is";
    } else if (springs) {
      ours.springs = springs;
      mapped_["stiffness"] = springs->law == SpringLaw::hooke
                                 ? "force class of our own: one stiffness per spring"
                                 : "force class of our own: the scene's law, one stiffness per spring";
    }
    if (wind) {
      ours.wind = wind;
      mapped_["wind"] = "force class of our own: Bullet's deformable world has no wind";
    }
    if (ours.springs || ours.drag || ours.wind) {
      net_force_ = std::make_unique<NetForce>(ours, model.particles, *scene_body_);
      world_->addForce(&body(), net_force_.get());
    }
    if (const auto* gravity = model.find<Gravity>()) {
      gravity_force_ = std::make_unique<btDeformableGravityForce>(to_bullet(gravity->acceleration / factor()));
      world_->addForce(&body(), gravity_force_.get());
      mapped_["gravity"] = drag_rate_ > 0 ? "gravity force, g / (1 - h gamma)" : "gravity force, g as it is";
    }
  }

  /// Spring forces in a body stretched by 1 %, so that every link pulls.
  SpringProbe probe() {
    auto& nodes = body().m_nodes;
    const int n = nodes.size();
    SpringProbe p{Points(3, n), Points::Zero(3, n)};
    std::vector<btVector3> kept(n);
    for (int i = 0; i < n; ++i) {
      auto& node = nodes[scene_body_->node_of(i)];
      kept[i] = node.m_q;
      p.x.col(i) = 1.01 * scene_.start.x.col(i);
      node.m_q = to_bullet(p.x.col(i));
    }
    btAlignedObjectArray<btVector3> force;
    force.resize(n, btVector3(0, 0, 0));
    if (spring_force_) spring_force_->addScaledElasticForce(factor(), force);
    if (!spring_force_ && net_force_) net_force_->addScaledElasticForce(factor(), force);
    for (int i = 0; i < n; ++i) {
      auto& node = nodes[scene_body_->node_of(i)];
      node.m_q = kept[i];
      p.force.col(i) = from_bullet(force[node.index]);
    }
    return p;
  }

  bool shipped_springs_ = false;       // Bullet's own spring force carries the springs
  bool shipped_drag_ = false;          // the body's drag factor carries the drag
  double drag_rate_ = 0;               // 1/s, as carried by the body's drag factor
  std::optional<double> speed_limit_;  // m/s, when Bullet limited a speed to the body's box over the step
  std::map<std::string, std::string> mapped_;
  btDeformableBodySolver body_solver_;
  btDeformableMultiBodyConstraintSolver solver_;
  std::unique_ptr<btDeformableMassSpringForce> spring_force_;
  std::unique_ptr<btDeformableGravityForce> gravity_force_;
  std::unique_ptr<NetForce> net_force_;
};

}  // namespace

Outcome run_deformable_explicit(const Scene& scene, const Run& run, Observer& observer) {
  DeformableWorld world(scene, plan(run).h);
  Outcome out = march(world, run, observer);
  out.evaluations = out.steps;
  if (scene.model.find<Spheres>())
    out.different_law.push_back(
        "contact: Bullet finds it at the proposed position but uses normal and gap of the old one (a tangent plane), "
        "so that "
        "nodes hop by (v h)^2 / 2R on a sphere; friction is Coulomb's in both");
  // a run that failed anyway is a failure; one that looks well under a limit of its own answers another question
  if (const auto limit = world.speed_limit(); limit && out.verdict == Verdict::ok)
    throw Unsupported(fmt::format(
        "Bullet's explicit world limits speeds to the body's box over the step, here to {:.3g} m/s", *limit));
  return out;
}

}  // namespace crosscheck::bullet
