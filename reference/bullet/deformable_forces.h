// The forces of a scene in Bullet's deformable world: Bullet's own where they can carry it, a class of our own for the
// rest; and what the world tells of them.
#pragma once

#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>

#include "reference/bullet/net_force.h"

namespace crosscheck::bullet {

class DeformableForces {
 public:
  /// Adds the forces to the world. implicit: the world's mode; shipped: in implicit mode too, Bullet's own spring force
  /// is wanted. Throws Unsupported where it is wanted and cannot carry the springs.
  DeformableForces(const Scene& scene, double h, bool implicit, bool shipped, SceneBody& body,
                   btDeformableMultiBodyDynamicsWorld& world);

  void set_time(double t);  // of wind and pins, s

  /// Gravity, drag rates, and probes of springs, dashpots and wind, from the forces that the world's solver holds.
  void read_back(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world, Readback& readback) const;

 private:
  void carry_drag(const Drag* drag, NetForce::Parts& ours);
  void carry_springs(const Springs* springs, const Dashpots* dashpots, NetForce::Parts& ours, bool shipped);
  /// 1/s, of each particle; nothing where they cannot be told from other forces.
  std::optional<std::vector<double>> drag_rates(NetForce* own) const;
  ForceProbe probe(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world) const;

  const Scene& scene_;
  double h_;
  bool implicit_;
  SceneBody& scene_body_;
  double factor_ = 1;  // 1 - h gamma: what the body's drag factor leaves of a velocity in one step
  double t_ = 0;
  std::map<std::string, std::string> mapped_;
  std::unique_ptr<btDeformableMassSpringForce> spring_force_;
  std::unique_ptr<btDeformableGravityForce> gravity_force_;
  std::unique_ptr<NetForce> net_force_;
};

}  // namespace crosscheck::bullet
