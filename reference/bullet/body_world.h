// What all Bullet worlds do alike: a body and its obstacles go in, states come out, and all is taken down in the right
// order.
#pragma once

#include <memory>
#include <optional>

#include "reference/bullet/obstacles.h"
#include "reference/bullet/probe_state.h"

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

  /// What a prescribed motion leads, at a time at which no round frequency has brought it back.
  Readback::Places places_later() {
    const double t = 0.382 * scene_.duration;
    std::optional<ProbeState> kept;  // puts the nodes back at the end
    if (scene_.model.particles.move) kept.emplace(scene_, *scene_body_, t);
    scene_body_->place_pins(t);
    const std::vector<int>& pins = scene_.model.particles.pins;
    Readback::Places places{t, Points(3, pins.size()), obstacles_.centres_at(t)};
    for (size_t p = 0; p < pins.size(); ++p) {
      const auto& node = body().m_nodes[scene_body_->node_of(pins[p])];
      places.pins.col(static_cast<int>(p)) = from_bullet(node.m_x);
    }
    return places;
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
