// What both Bullet worlds do alike: a body and an obstacle go in, states come out, and all is taken down in the right
// order.
#pragma once

#include <memory>

#include "reference/bullet/scene_body.h"

namespace crosscheck::bullet {

/// BulletWorld: a soft-body world of Bullet. The derived class makes world_ and scene_body_, calls enter(), and calls
/// tear_down() in its destructor, since its forces and solvers must outlive the world.
template <class BulletWorld>
class BodyWorld : public World {
 public:
  explicit BodyWorld(const Scene& scene, double h) : scene_(scene), h_(h) { require_supported(scene); }
  const State& state(double t) override { return scene_body_->read_state(t); }

 protected:
  btSoftBody& body() { return scene_body_->body(); }

  void enter() {
    make_obstacle(scene_, stage_);
    if (stage_.ball) world_->addRigidBody(stage_.ball.get());
    world_->addSoftBody(&body());
    world_->setGravity(btVector3(0, 0, 0));  // of rigid bodies only; the sphere is fixed
  }

  /// What stands in the world: shapes, places and friction of its rigid bodies, and the soft body's margin.
  void read_obstacle(Readback& r) {
    r.margin = body().getCollisionShape()->getMargin();
    r.spheres.emplace();
    const btCollisionObjectArray& objects = world_->getCollisionObjectArray();
    for (int i = 0; i < objects.size(); ++i)
      if (const auto* ball = dynamic_cast<const btSphereShape*>(objects[i]->getCollisionShape()))
        r.spheres->push_back({from_bullet(objects[i]->getWorldTransform().getOrigin()), ball->getRadius() + *r.margin,
                              objects[i]->getFriction() * body().m_cfg.kDF, objects[i]->getRestitution()});
  }

  void tear_down() {
    world_->removeSoftBody(&body());
    scene_body_.reset();
    if (stage_.ball) world_->removeRigidBody(stage_.ball.get());
    world_->getWorldInfo().m_sparsesdf.Reset();
    world_.reset();
  }

  const Scene& scene_;
  double h_;  // s
  Stage stage_;
  std::unique_ptr<BulletWorld> world_;
  std::unique_ptr<SceneBody> scene_body_;
};

}  // namespace crosscheck::bullet
