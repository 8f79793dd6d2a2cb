// Spheres in a Bullet world.
#include "reference/bullet/obstacles.h"

#include <fmt/format.h>

#include <limits>

namespace crosscheck::bullet {
namespace {

btTransform at(const Vec3& place) {
  btTransform transform;
  transform.setIdentity();
  transform.setOrigin(to_bullet(place));
  return transform;
}

}  // namespace

Obstacles::Obstacles(const Model& model) : spheres_(model.find<Spheres>()) {
  if (!spheres_) return;
  for (const Sphere& s : spheres_->list) {
    Ball ball{std::make_unique<btSphereShape>(static_cast<btScalar>(s.radius)), nullptr};
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, ball.shape.get());
    info.m_startWorldTransform = at(s.centre_at(0));
    info.m_friction = static_cast<btScalar>(s.friction);  // multiplied by the body's kDF, which is set to 1
    info.m_restitution = 0;
    ball.body = std::make_unique<btRigidBody>(info);
    if (s.motion) {
      ball.body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
      ball.body->setActivationState(DISABLE_DEACTIVATION);
    }
    balls_.push_back(std::move(ball));
  }
}

void Obstacles::enter(btDiscreteDynamicsWorld& world) {
  for (const Ball& ball : balls_) {
    world.addRigidBody(ball.body.get());
    built_.push_back(from_bullet(ball.body->getWorldTransform().getOrigin()));
  }
}

void Obstacles::leave(btDiscreteDynamicsWorld& world) {
  for (const Ball& ball : balls_) world.removeRigidBody(ball.body.get());
}

void Obstacles::place(double t) {
  for (size_t i = 0; i < balls_.size(); ++i)
    if (spheres_->list[i].motion) balls_[i].body->setWorldTransform(at(spheres_->list[i].centre_at(t)));
}

std::vector<Vec3> Obstacles::centres_at(double t) {
  std::vector<btTransform> now;
  for (const Ball& ball : balls_) now.push_back(ball.body->getWorldTransform());
  place(t);
  std::vector<Vec3> centres;
  for (size_t i = 0; i < balls_.size(); ++i) {
    centres.push_back(from_bullet(balls_[i].body->getWorldTransform().getOrigin()));
    balls_[i].body->setWorldTransform(now[i]);
  }
  return centres;
}

void Obstacles::read_back(const btDiscreteDynamicsWorld& world, const btSoftBody& body, Readback& readback) const {
  readback.margin = body.getCollisionShape()->getMargin();
  readback.spheres.emplace();
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i)
    if (const auto* ball = dynamic_cast<const btSphereShape*>(objects[i]->getCollisionShape())) {
      const size_t known = readback.spheres->size();  // one that nobody built here counts where it stands
      readback.spheres->push_back(
          {known < built_.size() ? built_[known] : from_bullet(objects[i]->getWorldTransform().getOrigin()),
           ball->getRadius() + *readback.margin, objects[i]->getFriction() * body.m_cfg.kDF,
           objects[i]->getRestitution()});
    }
}

std::string off_normal(const Scene& scene, double voxel) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Sphere& s : scene.model.find<Spheres>()->list) radius = std::min(radius, s.contact_radius());
  return fmt::format("{:.2g} mrad on voxels of a = {:.3g} mm", 1e3 * voxel / 2 / radius, 1e3 * voxel);
}

}  // namespace crosscheck::bullet
