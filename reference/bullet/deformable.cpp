// Bullet's deformable world.
#include "reference/bullet/deformable.h"

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <fmt/format.h>

#include "mysim/errors.h"
#include "reference/bullet/body_world.h"
#include "reference/bullet/deformable_forces.h"

namespace crosscheck::bullet {
namespace {

/// Bullet keeps the tolerances of its linear solvers to itself.
class BodySolver : public btDeformableBodySolver {
 public:
  void set_tolerance(double squared) {
    m_cg.m_tolerance = static_cast<btScalar>(squared);
    // the default of 300 may stop a large cloth before the tolerance is reached: conjugate gradients on 3 n unknowns
    m_cg.m_maxIterations = 10000;
  }
};

class DeformableWorld : public BodyWorld<btDeformableMultiBodyDynamicsWorld> {
 public:
  DeformableWorld(const Scene& scene, double h, const DeformableSettings& settings)
      : BodyWorld(scene, h), implicit_(settings.implicit) {
    if (scene.model.find<Constraints>())
      throw Unsupported("Bullet's deformable world has springs only, no hard distances");
    solver_.setDeformableSolver(&body_solver_);
    world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&stage_.dispatcher, &stage_.broadphase, &solver_,
                                                                  &stage_.configuration, &body_solver_);
    world_->setImplicit(implicit_);
    world_->setUseProjection(implicit_ && settings.projected);
    if (settings.tight) body_solver_.set_tolerance(1e-28);
    world_->getWorldInfo().m_sparsesdf.setDefaultVoxelsz(static_cast<btScalar>(settings.voxel));
    world_->getWorldInfo().m_sparsesdf.Reset();
    scene_body_ = std::make_unique<SceneBody>(scene, world_->getWorldInfo(), settings.defaults);
    if (scene.model.find<Spheres>())
      body().m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
    enter();
    try {
      forces_ = std::make_unique<DeformableForces>(scene, h, implicit_, settings.shipped, *scene_body_, *world_);
    } catch (...) {
      tear_down();  // a constructor that throws runs no destructor: the world must go before its solvers
      throw;
    }
  }

  ~DeformableWorld() override { tear_down(); }

  void step(double t, double t_next) override {
    forces_->set_time(implicit_ ? t_next : t);
    if (implicit_) scene_body_->place_pins(t_next);
    obstacles_.place(t_next);
    const double limit = (body().m_bounds[1] - body().m_bounds[0]).length() / h_;
    world_->stepSimulation(static_cast<btScalar>(h_), 0);
    scene_body_->place_pins(t_next);
    for (int i = 0; i < body().m_nodes.size() && !speed_limit_; ++i)
      // where the limit acts, a speed is put to it exactly; drag and contact may take a little off
      if (body().m_nodes[i].m_im > 0 && !(body().m_nodes[i].m_v.length() < 0.999 * limit)) speed_limit_ = limit;
  }

  std::optional<Readback> read_back() override {
    Readback r = scene_body_->read_back();
    obstacles_.read_back(*world_, body(), r);
    r.later = places_later();
    forces_->read_back(*body_solver_.getLagrangianForceArray(), r);
    return r;
  }

  std::optional<double> speed_limit() const { return speed_limit_; }

 private:
  bool implicit_;
  std::optional<double> speed_limit_;  // m/s, when Bullet limited a speed to the body's box over the step
  BodySolver body_solver_;
  btDeformableMultiBodyConstraintSolver solver_;
  std::unique_ptr<DeformableForces> forces_;
};

}  // namespace

Outcome run_deformable(const Scene& scene, const Run& run, Observer& observer, const DeformableSettings& settings) {
  DeformableWorld world(scene, plan(run).h, settings);
  Outcome out = march(world, run, observer);
  out.evaluations = out.steps;
  if (scene.model.find<Spheres>())
    out.different_law.push_back(
        "contact: Bullet finds it at the proposed position but uses normal and gap of the old one (a tangent plane), "
        "so that nodes hop by (v h)^2 / 2R on a sphere; and whatever the step, normals are gradients of a grid of "
        "distances, off by up to a / 2R = " +
        off_normal(scene, settings.voxel) + "; friction is Coulomb's in both");
  if (scene.model.find<Dashpots>() && !settings.implicit)
    out.different_law.push_back("dashpots: Bullet solves them implicitly, at the end of the explicit step");
  if (const auto limit = world.speed_limit(); limit && out.verdict == Verdict::ok) {
    // a run that failed anyway is a failure; one that looks well under a limit of its own answers another question
    if (!settings.defaults.margin)
      throw Unsupported(fmt::format(
          "Bullet's deformable world limits speeds to the body's box over the step, here to {:.3g} m/s", *limit));
    out.different_law.push_back(
        fmt::format("speeds: limited to the body's box over the step, here to {:.3g} m/s", *limit));
  }
  return out;
}

}  // namespace crosscheck::bullet
