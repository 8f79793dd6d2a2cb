// A scene as one Bullet soft body: the part that all Bullet worlds share.
//
// Traps met here (all measured): pinned nodes go last, since the implicit world shifts its contact prediction by one
// node for each pin before; the first step overwrites rest lengths unless the update flag is cleared; bodies slower
// than 0.04 m/s fall asleep unless told not to; a disconnected network hangs the builder of the node tree; the body's
// margin is 0.25 m unless set; the explicit world clamps speeds to the diagonal of the body's box over the step.
#pragma once

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "mysim/frequency.h"
#include "mysim/march.h"

namespace crosscheck::bullet {

/// Bullet's vector, in the precision that it was built with, from ours, and back.
inline btVector3 to_bullet(const Vec3& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }
inline Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// What every world needs and what it leaves behind in the right order.
struct Stage {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
};

/// Throws Unsupported where Bullet would hang (a network in several pieces beside a sphere) or cannot follow
/// (first-order scenes, restitution). To be asked before a world is built.
void require_supported(const Scene& scene);

/// What is left at Bullet's defaults, to be seen failing.
struct Defaults {
  bool rest = false;    // the first step overwrites rest lengths with the lengths it finds
  bool margin = false;  // 0.25 m
  bool sleep = false;   // what is slower than 0.04 m/s for 2 s is put to sleep
};

class SceneBody {
 public:
  /// Nodes, links with rest lengths, start velocities, margin; no forces. The scene must be supported.
  SceneBody(const Scene& scene, btSoftBodyWorldInfo& info, const Defaults& defaults);

  btSoftBody& body() { return *body_; }
  int node_of(int particle) const { return node_of_[particle]; }

  /// Writes rest lengths and their squares into the links, springs first, then hard distances: Bullet overwrites them.
  void restore_lengths();
  /// Writes position and velocity of the pins at time t into the nodes. Bullet's forces read m_q.
  void place_pins(double t);
  /// Positions and velocities in the scene's numbering.
  const State& read_state(double t);
  /// Masses, pins, start, links with rest lengths, springs first; the world adds what it alone knows.
  Readback read_back() const;

 private:
  const Scene& scene_;
  Defaults defaults_;
  std::vector<int> node_of_, particle_of_;
  std::unique_ptr<btSoftBody> body_;
  State state_, built_;  // now; as built
};

/// mu of the pair of ends, 1 / (1/m_a + 1/m_b) with pins of infinite mass, kg; infinite between two pins.
double pair_mass(const Particles& particles, const Spring& spring);

}  // namespace crosscheck::bullet
