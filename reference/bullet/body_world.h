// What all Bullet worlds do alike: a body and its obstacles go in, states come out, and all is taken down in the right
// order.
#pragma once

#include <memory>

#include "reference/bullet/obstacles.h"

namespace crosscheck::bullet {

/// BulletWorld: a soft-body world of Bullet. The derived class makes world_ and scene_body_, calls enter(), and calls
/// tear_down() in its destructor, since its forces and solvers must outlive the world.
template <class BulletWorld>
class BodyWorld : public World {
 public:
  explicit BodyWorld(const Scene& scene, double h) : scene_(supported(scene)), h_(h), obstacles_(scene.model) {}
  const State& state(double t) override { return scene_body_->read_state(t); }

 protected:
  btSoftBody& body() { return scene_body_->body(); }

  void enter() {
    obstacles_.enter(*world_);
    world_->addSoftBody(&body());
    world_->setGravity(btVector3(0, 0, 0));  // of rigid bodies only; the spheres are fixed or led
  }

  void tear_down() {
    world_->removeSoftBody(&body());
    scene_body_.reset();
    obstacles_.leave(*world_);
    world_->getWorldInfo().m_sparsesdf.Reset();
    world_.reset();
  }

  const Scene& scene_;
  double h_;  // s
  Stage stage_;
  Obstacles obstacles_;
  std::unique_ptr<BulletWorld> world_;
  std::unique_ptr<SceneBody> scene_body_;

 private:
  static const Scene& supported(const Scene& scene) {
    require_supported(scene);
    return scene;
  }
};

}  // namespace crosscheck::bullet
