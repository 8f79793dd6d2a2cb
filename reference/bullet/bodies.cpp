// One body per piece of the network, in one deformable world.
#include "reference/bullet/bodies.h"

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>

#include <algorithm>

#include "mysim/base/errors.h"
#include "mysim/model/pieces.h"
#include "reference/bullet/soft_body.h"

namespace crosscheck::bullet {
namespace {

const Scene& with_springs_and_gravity_alone(const Scene& scene) {
  require_supported(scene);
  const auto known = [](const Term& term) {
    return std::holds_alternative<Springs>(term) || std::holds_alternative<Gravity>(term);
  };
  if (!std::ranges::all_of(scene.model.terms, known) || scene.model.particles.move)
    throw Unsupported("+bodies supports only springs, gravity and pins at rest");
  const auto* springs = scene.model.find<Springs>();
  if (springs && springs->law != SpringLaw::hooke) throw Unsupported("Bullet's mass-spring force has only Hooke's law");
  return scene;
}

class BodiesWorld : public World {
 public:
  BodiesWorld(const Scene& scene, double h)
      : scene_(with_springs_and_gravity_alone(scene)), h_(h), state_(scene.start) {
    solver_.setDeformableSolver(&body_solver_);
    world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&collision_.dispatcher, &collision_.broadphase,
                                                                  &solver_, &collision_.configuration, &body_solver_);
    const std::vector<int> piece = pieces_of(scene.model);
    try {
      for (int p = 0; p <= std::ranges::max(piece); ++p) add_body(piece, p);
    } catch (...) {
      remove_all();  // without this, the world would be destroyed after its solvers
      throw;
    }
  }
  ~BodiesWorld() override { remove_all(); }

  void step(double, double) override { world_->stepSimulation(static_cast<btScalar>(h_), 0); }

  const State& state(double t) override {
    state_.t = t;
    for (const Body& body : bodies_)
      for (size_t node = 0; node < body.particles.size(); ++node) {
        state_.x.col(body.particles[node]) = from_bullet(body.bt->m_nodes[static_cast<int>(node)].m_x);
        state_.v.col(body.particles[node]) = from_bullet(body.bt->m_nodes[static_cast<int>(node)].m_v);
      }
    return state_;
  }

 private:
  struct Body {
    std::vector<int> particles;  // scene particles by node, pins last
    std::unique_ptr<btSoftBody> bt;
    std::unique_ptr<btDeformableMassSpringForce> springs;
    std::unique_ptr<btDeformableGravityForce> gravity;
  };

  void add_body(const std::vector<int>& piece, int p) {
    const Particles& particles = scene_.model.particles;
    Body& body = bodies_.emplace_back();
    std::vector<int> node_of(particles.size(), -1);
    for (int pinned = 0; pinned < 2; ++pinned)
      for (int i = 0; i < particles.size(); ++i)
        if (piece[i] == p && particles.pinned[i] == pinned) {
          node_of[i] = static_cast<int>(body.particles.size());
          body.particles.push_back(i);
        }
    std::vector<btVector3> x;
    std::vector<btScalar> mass;
    for (const int i : body.particles) {
      x.push_back(to_bullet(scene_.start.x.col(i)));
      mass.push_back(particles.pinned[i] ? 0 : static_cast<btScalar>(particles.mass[i]));
    }
    body.bt = std::make_unique<btSoftBody>(&world_->getWorldInfo(), static_cast<int>(x.size()), x.data(), mass.data());

    std::vector<const Spring*> own;
    if (const auto* springs = scene_.model.find<Springs>())
      for (const Spring& s : springs->list)
        if (piece[s.a] == p) own.push_back(&s);
    for (const Spring* s : own) {
      if (s->k != own[0]->k) throw Unsupported("Bullet's mass-spring force has only one stiffness per body");
      body.bt->appendLink(node_of[s->a], node_of[s->b], body.bt->m_materials[0]);
    }
    body.bt->updateConstants();
    for (size_t l = 0; l < own.size(); ++l)
      body.bt->m_links[static_cast<int>(l)].m_rl = static_cast<btScalar>(own[l]->rest);
    body.bt->m_bUpdateRtCst = false;  // otherwise the first step overwrites the rest lengths
    for (const int i : body.particles) {
      auto& node = body.bt->m_nodes[node_of[i]];
      node.m_v = node.m_vn = particles.pinned[i] ? btVector3(0, 0, 0) : to_bullet(scene_.start.v.col(i));
    }
    body.bt->getCollisionShape()->setMargin(10);  // m; so large that Bullet limits no speed (soft_body.cpp)
    body.bt->updateBounds();
    body.bt->setActivationState(DISABLE_DEACTIVATION);
    world_->addSoftBody(body.bt.get());
    if (!own.empty()) {
      const auto k = static_cast<btScalar>(own[0]->k);
      body.springs = std::make_unique<btDeformableMassSpringForce>(k, btScalar(0), true, k);
      world_->addForce(body.bt.get(), body.springs.get());
    }
    if (const auto* gravity = scene_.model.find<Gravity>()) {
      body.gravity = std::make_unique<btDeformableGravityForce>(to_bullet(gravity->acceleration));
      world_->addForce(body.bt.get(), body.gravity.get());
    }
  }

  void remove_all() {
    for (Body& body : bodies_) {
      if (body.bt) world_->removeSoftBody(body.bt.get());
      body.bt.reset();
    }
    world_->getWorldInfo().m_sparsesdf.Reset();
    world_.reset();
  }

  const Scene& scene_;
  double h_;  // s
  State state_;
  CollisionPipeline collision_;
  btDeformableBodySolver body_solver_;
  btDeformableMultiBodyConstraintSolver solver_;
  std::vector<Body> bodies_;
  std::unique_ptr<btDeformableMultiBodyDynamicsWorld> world_;
};

}  // namespace

Outcome run_bodies(const Scene& scene, const Run& run, Observer& observer) {
  BodiesWorld world(scene, time_grid(run).h);
  Outcome out = run_loop(world, run, observer);
  out.evaluations = out.steps;
  return out;
}

}  // namespace crosscheck::bullet
