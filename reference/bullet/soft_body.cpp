#include "reference/bullet/soft_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mysim/base/errors.h"
#include "mysim/base/random.h"
#include "mysim/model/pieces.h"

namespace crosscheck::bullet {

Points small_offsets(const Bending& bending, const Points& x) {
  double shortest = INFINITY;
  for (const Bending::Stencil& s : bending.list)
    shortest = std::min(shortest, (x.col(s.particle[0]) - x.col(s.particle[1])).norm());
  std::mt19937_64 engine(1);
  Points offsets(3, x.cols());
  // three components of at most 1/90 form a vector shorter than 1/50
  for (double& part : offsets.reshaped()) part = shortest / 90 * (2 * uniform(engine) - 1);
  return offsets;
}

static std::vector<double> margins_of(const Model& model) {
  std::vector<double> margins;
  if (const auto* spheres = model.find<Spheres>())
    for (const Sphere& s : spheres->list) margins.push_back(s.margin);
  if (const auto* planes = model.find<Planes>())
    for (const Plane& p : planes->list) margins.push_back(p.margin);
  return margins;
}

void require_supported(const Scene& scene, bool may_hang) {
  const Model& model = scene.model;
  if (model.first_order()) throw Unsupported("Bullet has no first-order systems: its bodies have mass and velocity");
  if (!has_contact(model)) return;
  for (const Surface& s : surfaces_of(model))
    if (s.restitution > 0) throw Unsupported("Bullet's soft bodies have no restitution against an obstacle");
  const std::vector<double> margins = margins_of(model);
  if (std::ranges::any_of(margins, [&](double margin) { return margin != margins[0]; }))
    throw Unsupported("Bullet's soft bodies have a single margin, but the scene's surfaces have several");
  if (!may_hang && std::ranges::max(pieces_of(model)) > 0)
    throw Unsupported("Bullet's contact search hangs on a body whose springs do not join all particles");
}

SoftBody::SoftBody(const Scene& scene, btSoftBodyWorldInfo& info, const BulletDefaults& defaults)
    : scene_(scene), defaults_(defaults), state_(scene.start) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const std::vector<double> margins = margins_of(model);
  const int n = particles.size();

  node_of_.resize(n);
  for (int pinned = 0; pinned < 2; ++pinned)
    for (int i = 0; i < n; ++i)
      if (particles.pinned[i] == pinned) {
        node_of_[i] = static_cast<int>(particle_of_.size());
        particle_of_.push_back(i);
      }
  std::vector<btVector3> x(n);
  std::vector<btScalar> mass(n);
  for (int node = 0; node < n; ++node) {
    const int i = particle_of_[node];
    x[node] = to_bullet(scene.start.x.col(i));
    mass[node] = particles.pinned[i] ? 0 : static_cast<btScalar>(particles.mass[i]);
  }
  bt_body_ = std::make_unique<btSoftBody>(&info, n, x.data(), mass.data());

  const auto* springs = model.find<Springs>();
  if (springs)
    for (const Spring& s : springs->list) bt_body_->appendLink(node_of_[s.a], node_of_[s.b], bt_body_->m_materials[0]);
  const auto* constraints = model.find<Constraints>();
  if (constraints)
    for (const auto& [a, b, length] : constraints->list)
      bt_body_->appendLink(node_of_[a], node_of_[b], bt_body_->m_materials[0]);
  bt_body_->updateConstants();
  restore_lengths();
  if (!margins.empty()) bt_body_->initializeFaceTree();
  bt_body_->m_bUpdateRtCst = defaults.rest;

  for (int node = 0; node < n; ++node) {
    const int i = particle_of_[node];
    const btVector3 v = particles.pinned[i] ? btVector3(0, 0, 0) : to_bullet(scene.start.v.col(i));
    bt_body_->m_nodes[node].m_v = bt_body_->m_nodes[node].m_vn = v;
  }
  // without contact the margin only limits speeds, so it is made large
  if (!defaults.margin)
    bt_body_->getCollisionShape()->setMargin(static_cast<btScalar>(margins.empty() ? 10.0 : margins[0]));
  bt_body_->updateBounds();  // with the constructor's margin, bounds would limit speeds in the first step
  bt_body_->m_cfg.kDF = 1;
  bt_body_->setGravityFactor(static_cast<btScalar>(defaults.gravity_factor));
  if (defaults.kLST) {
    bt_body_->m_materials[0]->m_kLST = static_cast<btScalar>(*defaults.kLST);
    bt_body_->updateLinkConstants();
    restore_lengths();
  }
  if (!defaults.sleep) bt_body_->setActivationState(DISABLE_DEACTIVATION);
  built_ = read_state(0);
  // the implicit world starts from m_vn, the explicit one from m_v: a velocity is reported only if both agree
  for (int node = 0; node < n; ++node)
    if (!(bt_body_->m_nodes[node].m_v == bt_body_->m_nodes[node].m_vn))
      built_.v.col(particle_of_[node]).setConstant(std::numeric_limits<double>::quiet_NaN());
}

void SoftBody::restore_lengths() {
  int l = 0;
  auto set = [&](double length) {
    bt_body_->m_links[l].m_rl = static_cast<btScalar>(length);
    bt_body_->m_links[l].m_c1 = bt_body_->m_links[l].m_rl * bt_body_->m_links[l].m_rl;
    ++l;
  };
  if (const auto* springs = scene_.model.find<Springs>())
    for (const Spring& s : springs->list) set(s.rest);
  if (const auto* constraints = scene_.model.find<Constraints>())
    for (const auto& c : constraints->list) set(c.length);
  bt_body_->m_bUpdateRtCst = defaults_.rest;
}

void SoftBody::place_pins(double t) {
  const Particles& particles = scene_.model.particles;
  if (!particles.move) return;
  const Vec3 shift = displacement_at(*particles.move, t);
  for (size_t p = 0; p < particles.pins.size(); ++p) {
    auto& node = bt_body_->m_nodes[node_of_[particles.pins[p]]];
    node.m_x = node.m_q = to_bullet(particles.pin_home.col(static_cast<int>(p)) + shift);
    node.m_v = node.m_vn = btVector3(0, 0, 0);
  }
}

const State& SoftBody::read_state(double t) {
  state_.t = t;
  for (int node = 0; node < bt_body_->m_nodes.size(); ++node) {
    state_.x.col(particle_of_[node]) = from_bullet(bt_body_->m_nodes[node].m_x);
    state_.v.col(particle_of_[node]) = from_bullet(bt_body_->m_nodes[node].m_v);
  }
  // Bullet stores no velocity of prescribed pins; the scene's is exact
  const Particles& particles = scene_.model.particles;
  const Vec3 velocity = particles.move ? velocity_at(*particles.move, t) : Vec3::Zero();
  for (int pin : particles.pins) state_.v.col(pin) = velocity;
  return state_;
}

Readback SoftBody::read_back() const {
  Readback r;
  const int n = bt_body_->m_nodes.size();
  r.mass.resize(n);
  r.pinned.resize(n);
  for (int i = 0; i < n; ++i) {
    const double inverse = bt_body_->m_nodes[node_of_[i]].m_im;
    r.pinned[i] = inverse == 0;
    r.mass[i] = inverse == 0 ? 0 : 1 / inverse;
  }
  const btSoftBody::Node* first = n ? &bt_body_->m_nodes[0] : nullptr;
  for (int l = 0; l < bt_body_->m_links.size(); ++l) {
    const auto& link = bt_body_->m_links[l];
    r.links.push_back({particle_of_[link.m_n[0] - first], particle_of_[link.m_n[1] - first], link.m_rl, std::nullopt});
  }
  r.start = built_;
  r.precision = sizeof(btScalar) == sizeof(double) ? "double" : "single";
  r.may_sleep = bt_body_->getActivationState() != DISABLE_DEACTIVATION;
  return r;
}

namespace {

/// Half the edge (m) of a plane's cube (soft_body.h). The factor of two allows for springs and wind.
double half_edge(const Scene& scene, const Plane& plane) {
  const auto* gravity = scene.model.find<Gravity>();
  const double t = scene.duration, g = gravity ? gravity->acceleration.norm() : 0;
  const double speed = largest_column(scene.start.v) + (plane.velocity ? plane.velocity->norm() : 0);
  return 2 * (scene.size() + t * (speed + g * t / 2));
}

}  // namespace

Obstacles::Obstacles(const Scene& scene) {
  if (const auto* spheres = scene.model.find<Spheres>())
    for (const Sphere& s : spheres->list)
      add(s, std::make_unique<btSphereShape>(static_cast<btScalar>(s.radius)), Vec3::Zero());
  const auto* planes = scene.model.find<Planes>();
  if (!planes) return;
  const Vec3 middle = (scene.start.x.rowwise().minCoeff() + scene.start.x.rowwise().maxCoeff()) / 2;
  for (const Plane& p : planes->list) {
    const auto half = static_cast<btScalar>(half_edge(scene, p));
    auto cube = std::make_unique<btBoxShape>(btVector3(half, half, half));
    cube->setMargin(0);  // the distance field ignores the margin
    const Vec3 d = middle - p.point, aside = d - d.dot(p.normal) * p.normal;
    add(p, std::move(cube), aside - (p.margin + half) * p.normal);
    btTransform place = obstacles_.back().body->getWorldTransform();
    const Vec3 axis = Vec3::UnitY().cross(p.normal);
    place.setRotation(axis.isZero(1e-12) ? btQuaternion(btVector3(1, 0, 0), p.normal.y() < 0 ? SIMD_PI : 0)
                                         : btQuaternion(to_bullet(axis.normalized()),
                                                        btScalar(std::atan2(axis.norm(), p.normal.y()))));
    obstacles_.back().body->setWorldTransform(place);
    // The deformable world detects contact at this transform, which Bullet does not update for static bodies.
    obstacles_.back().body->setInterpolationWorldTransform(place);
  }
}

void Obstacles::add(const Surface& surface, std::unique_ptr<btConvexShape> shape, const Vec3& middle) {
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape.get());
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(to_bullet(surface.origin_at(0) + middle));
  info.m_friction = static_cast<btScalar>(surface.friction);  // Bullet multiplies it by the body's kDF, which is 1
  info.m_restitution = 0;
  auto body = std::make_unique<btRigidBody>(info);
  if (surface.moving()) {
    body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body->setActivationState(DISABLE_DEACTIVATION);
  }
  obstacles_.push_back({std::move(shape), std::move(body), surface, middle});
}

void Obstacles::add_to_world(btDiscreteDynamicsWorld& world) {
  for (const Obstacle& o : obstacles_) {
    world.addRigidBody(o.body.get());
    built_.push_back(o.body->getWorldTransform());
  }
}

void Obstacles::remove_from_world(btDiscreteDynamicsWorld& world) {
  for (const Obstacle& o : obstacles_) world.removeRigidBody(o.body.get());
}

void Obstacles::place(double t) {
  for (const Obstacle& o : obstacles_)
    if (o.surface.moving()) o.body->getWorldTransform().setOrigin(to_bullet(o.surface.origin_at(t) + o.middle));
}

namespace {

/// The plane at which particles with this margin touch the upper face of a box in Bullet.
Readback::Face face_of(const btBoxShape& box, const btTransform& place, double margin) {
  const Vec3 normal = from_bullet(place.getBasis().getColumn(1));
  return {from_bullet(place.getOrigin()) + (box.getHalfExtentsWithMargin().y() + margin) * normal, normal, {}, {}};
}

}  // namespace

void Obstacles::read_places(double t, double margin, Readback::Places& places) {
  std::vector<btTransform> now;
  for (const Obstacle& o : obstacles_) now.push_back(o.body->getWorldTransform());
  place(t);
  for (size_t i = 0; i < obstacles_.size(); ++i) {
    const btTransform& there = obstacles_[i].body->getWorldTransform();
    if (const auto* box = dynamic_cast<const btBoxShape*>(obstacles_[i].shape.get()))
      places.points.push_back(face_of(*box, there, margin).point);
    else
      places.centres.push_back(from_bullet(there.getOrigin()));
    obstacles_[i].body->setWorldTransform(now[i]);
  }
}

void Obstacles::read_back(const btDiscreteDynamicsWorld& world, const btSoftBody& body, Readback& readback) const {
  readback.margin = body.getCollisionShape()->getMargin();
  readback.spheres.emplace(), readback.planes.emplace();
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  size_t known = 0;  // spheres and boxes so far; those beyond built_ were not built here
  for (int i = 0; i < objects.size(); ++i) {
    const auto* ball = dynamic_cast<const btSphereShape*>(objects[i]->getCollisionShape());
    const auto* box = dynamic_cast<const btBoxShape*>(objects[i]->getCollisionShape());
    if (!ball && !box) continue;
    const btTransform& place = known < built_.size() ? built_[known] : objects[i]->getWorldTransform();
    ++known;
    const double friction = objects[i]->getFriction() * body.m_cfg.kDF, restitution = objects[i]->getRestitution();
    if (ball) {
      readback.spheres->push_back(
          {from_bullet(place.getOrigin()), ball->getRadius() + *readback.margin, friction, restitution});
    } else {
      readback.planes->push_back(face_of(*box, place, *readback.margin));
      readback.mapped["planes"] =
          fmt::format("faces of cubes, {:.3g} m to each side; distances on the grid of voxels are exact to rounding",
                      double(box->getHalfExtentsWithMargin().y()));
      readback.planes->back().friction = friction, readback.planes->back().restitution = restitution;
    }
  }
}

std::string normal_error_text(const Scene& scene, double voxel) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Sphere& s : scene.model.find<Spheres>()->list) radius = std::min(radius, s.contact_radius());
  return fmt::format("{:.2g} mrad on voxels of a = {:.3g} mm", 1e3 * voxel / 2 / radius, 1e3 * voxel);
}

}  // namespace crosscheck::bullet
