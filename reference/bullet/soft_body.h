// A scene as one soft body of Bullet with its obstacles, for all Bullet worlds.
#pragma once

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <optional>
#include <vector>

#include "mysim/model/system.h"
#include "mysim/run/engine.h"

namespace crosscheck::bullet {

// Pitfalls of Bullet (all measured), besides those in BulletDefaults. Pinned nodes must come last: the implicit world
// shifts its contact prediction by one node per preceding pin. The explicit world limits speeds to the diagonal of the
// body's box divided by the step.

/// Converts vectors between mysim and Bullet, in Bullet's precision.
inline btVector3 to_bullet(const Vec3& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }
inline Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The objects of every world, destroyed in the right order.
struct CollisionPipeline {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
};

/// Throws Unsupported if Bullet would hang (on a spring graph in several pieces near a surface; not checked if
/// `may_hang`) or does not support the scene (of first order, or with restitution). Call it before building a world.
void require_supported(const Scene& scene, bool may_hang = false);

/// Options that demonstrate the effect of a harmful default of Bullet, or of ignoring Bullet's advice.
struct BulletDefaults {
  bool rest = false;    // the first step overwrites rest lengths by current lengths
  bool margin = false;  // keeps the margin of 0.25 m
  bool sleep = false;   // bodies slower than 0.04 m/s for 2 s fall asleep
  // accepts a network of several pieces near a sphere, although Bullet's node tree builder hangs on it
  bool pieces = false;
  double gravity_factor = 1;   // the body's gravity factor, by which the world's gravity is divided
  std::optional<double> kLST;  // value for all links, whatever the scene's stiffness
};

class SoftBody {
 public:
  /// Creates nodes, links with rest lengths, initial velocities and margin, but no forces. The scene must be supported.
  SoftBody(const Scene& scene, btSoftBodyWorldInfo& info, const BulletDefaults& defaults);

  btSoftBody& body() { return *bt_body_; }
  int node_of(int particle) const { return node_of_[particle]; }

  /// Writes rest lengths and their squares to the links, springs first, then hard distances. Bullet overwrites them.
  void restore_lengths();
  /// Writes positions and velocities of the pins at time t (s) to the nodes. Bullet's forces read m_q.
  void place_pins(double t);
  /// Current state in the scene's numbering.
  const State& read_state(double t);
  /// Masses, pins, initial state, and links with rest lengths, springs first. The world adds the other quantities.
  Readback read_back() const;

 private:
  const Scene& scene_;
  BulletDefaults defaults_;
  std::vector<int> node_of_, particle_of_;
  std::unique_ptr<btSoftBody> bt_body_;
  State state_, built_;  // current; as built
};

/// Random offsets (m), each at most a fiftieth of the shortest distance between a stencil's first two particles.
Points small_offsets(const Bending& bending, const Points& x);

/// Puts a body into a known state, to probe its world's forces; the destructor restores the previous state. The nodes
/// are at 1.1 times the initial positions, so that all springs pull. With bending, each node is also displaced by up to
/// a fiftieth of the shortest distance in a stencil, so that no stencil is flat. The velocities are x + P x (as m/s),
/// where P permutes the coordinates cyclically. This is not a rigid motion: every distance |d| grows, by at least |d| /
/// 2 per second.
class ProbeState {
 public:
  ProbeState(const Scene& scene, SoftBody& body, double t) : body_(body) {
    const Particles& particles = scene.model.particles;
    const int n = particles.size();
    probe_.t = t;
    probe_.x = 1.1 * scene.start.x;
    if (const auto* bending = scene.model.find<Bending>()) probe_.x += small_offsets(*bending, scene.start.x);
    probe_.v.resize(3, n);
    probe_.v << probe_.x.row(1), probe_.x.row(2), probe_.x.row(0);
    probe_.v += probe_.x;
    for (int i = 0; i < n; ++i) {
      auto& node = body.body().m_nodes[body.node_of(i)];
      saved_.push_back({node.m_x, node.m_q, node.m_v, node.m_f});
      if (particles.pinned[i]) probe_.v.col(i) = particles.move ? velocity_at(*particles.move, t) : Vec3::Zero();
      node.m_q = node.m_x = to_bullet(probe_.x.col(i));
      node.m_v = particles.pinned[i] ? btVector3(0, 0, 0) : to_bullet(probe_.v.col(i));
      node.m_f = btVector3(0, 0, 0);
    }
  }
  ~ProbeState() {
    for (size_t i = 0; i < saved_.size(); ++i) {
      auto& node = body_.body().m_nodes[body_.node_of(static_cast<int>(i))];
      node.m_x = saved_[i].x, node.m_q = saved_[i].q, node.m_v = saved_[i].v, node.m_f = saved_[i].f;
    }
  }
  ProbeState(const ProbeState&) = delete;
  ProbeState& operator=(const ProbeState&) = delete;

  /// Sets all velocities to zero.
  void stop() {
    for (int i = 0; i < body_.body().m_nodes.size(); ++i) body_.body().m_nodes[i].m_v = btVector3(0, 0, 0);
  }

  /// Converts forces by node to the scene's numbering.
  template <class Stack>
  ForceProbe probe(const Stack& springs, const Stack& bending, const Stack& dashpots, const Stack& wind) const {
    ForceProbe p = probe_;
    p.springs = by_particle(springs), p.bending = by_particle(bending), p.dashpots = by_particle(dashpots),
    p.wind = by_particle(wind);
    return p;
  }

 private:
  struct SavedNode {
    btVector3 x, q, v, f;
  };
  template <class Stack>
  Points by_particle(const Stack& by_node) const {
    Points points(3, by_node.size());
    for (int i = 0; i < by_node.size(); ++i) points.col(i) = from_bullet(by_node[body_.node_of(i)]);
    return points;
  }

  SoftBody& body_;
  ForceProbe probe_;
  std::vector<SavedNode> saved_;  // by particle
};

// The scene's spheres and planes as Bullet's rigid bodies, fixed or kinematic.
//
// A plane is the upper face of a cube below the middle of the particles. Half the cube's edge is twice the particles'
// possible displacement during the scene, so that no particle reaches the rim. Bullet's soft bodies read distances and
// normals from a grid. Distances from a face are linear, so the grid has only rounding errors, for any voxel size. On a
// floor and on a slope of 25 degrees, single nodes and a cloth of 25 nodes stay within 1e-14 m of the face in the
// explicit deformable world and slide by Coulomb's law. btStaticPlaneShape has no such grid: Bullet treats it as a
// concave mesh of two triangles as large as the body's box, each with its own grid. On this shape, the same bodies sink
// in by 0.12 m and drift sideways by 43 mm in half a second, and the position-based world throws them up by 3 m.

class Obstacles {
 public:
  explicit Obstacles(const Scene& scene);

  void add_to_world(btDiscreteDynamicsWorld& world);
  void remove_from_world(btDiscreteDynamicsWorld& world);
  /// Moves kinematic obstacles to their positions at time t (s). Call it before each step with the time at the step's
  /// end: Bullet derives their speed from two successive positions.
  void place(double t);
  /// Reads positions at time t (s): centres of spheres, points of planes. Leaves the world unchanged.
  void read_places(double t, double margin, Readback::Places& places);

  /// The obstacles as built: positions, radii or normals, friction and restitution, and the soft body's margin.
  void read_back(const btDiscreteDynamicsWorld& world, const btSoftBody& body, Readback& readback) const;

 private:
  struct Obstacle {
    std::unique_ptr<btConvexShape> shape;
    std::unique_ptr<btRigidBody> body;
    Surface surface;
    Vec3 middle;  // m, middle of the body relative to the surface's origin
  };
  void add(const Surface& surface, std::unique_ptr<btConvexShape> shape, const Vec3& middle);

  std::vector<Obstacle> obstacles_;
  std::vector<btTransform> built_;  // transforms with which the bodies were added
};

/// Largest error of Bullet's normals on the scene's smallest ball, along each axis, e.g. "5 mrad on voxels of a = 10
/// mm". The scene must contain a ball. Inside a voxel, the gradient of the distance grid is constant along each axis.
/// It is therefore correct in the middle, and wrong by half a voxel's angle at the voxel's faces.
std::string normal_error_text(const Scene& scene, double voxel);

/// A soft body and its obstacles in a soft-body world of Bullet, destroyed in the right order. The derived class
/// creates world_ and soft_body_, calls add_to_world(), and calls remove_all() in its destructor, because its forces
/// and solvers must outlive the world.
template <class BulletWorld>
class SoftBodyWorld : public World {
 public:
  SoftBodyWorld(const Scene& scene, double h, const BulletDefaults& defaults)
      : scene_(supported(scene, defaults)), h_(h), obstacles_(scene) {}
  const State& state(double t) override { return soft_body_->read_state(t); }

 protected:
  btSoftBody& body() { return soft_body_->body(); }

  void add_to_world() {
    obstacles_.add_to_world(*world_);
    world_->addSoftBody(&body());
    world_->setGravity(btVector3(0, 0, 0));  // for rigid bodies only; the obstacles are fixed or kinematic
  }

  /// Prescribed positions of pins and surfaces, at a time when no motion of a round frequency is back at its start.
  Readback::Places prescribed_places() {
    const double t = 0.382 * scene_.duration;
    std::optional<ProbeState> kept;  // restores the nodes at the end
    if (scene_.model.particles.move) kept.emplace(scene_, *soft_body_, t);
    soft_body_->place_pins(t);
    const std::vector<int>& pins = scene_.model.particles.pins;
    Readback::Places places{t, Points(3, pins.size()), {}, {}};
    obstacles_.read_places(t, body().getCollisionShape()->getMargin(), places);
    for (size_t p = 0; p < pins.size(); ++p) {
      const auto& node = body().m_nodes[soft_body_->node_of(pins[p])];
      places.pins.col(static_cast<int>(p)) = from_bullet(node.m_x);
    }
    return places;
  }

  void remove_all() {
    world_->removeSoftBody(&body());
    soft_body_.reset();
    obstacles_.remove_from_world(*world_);
    world_->getWorldInfo().m_sparsesdf.Reset();
    world_.reset();
  }

  const Scene& scene_;
  double h_;  // s
  CollisionPipeline collision_;
  Obstacles obstacles_;
  std::unique_ptr<BulletWorld> world_;
  std::unique_ptr<SoftBody> soft_body_;

 private:
  static const Scene& supported(const Scene& scene, const BulletDefaults& defaults) {
    require_supported(scene, defaults.pieces);
    return scene;
  }
};

}  // namespace crosscheck::bullet
