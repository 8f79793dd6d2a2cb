// A force class of our own in Bullet's deformable world, for what Bullet's mass-spring force cannot carry: more than
// two stiffnesses, another spring law than Hooke's, drag that differs between particles, and wind.
#pragma once

#include <BulletSoftBody/btDeformableLagrangianForce.h>

#include "reference/bullet/scene_body.h"

namespace crosscheck::bullet {

/// Only the explicit world is served: there the forces are evaluated at x_n, v_n and no derivative is asked for.
class NetForce : public btDeformableLagrangianForce {
 public:
  struct Parts {
    const Springs* springs = nullptr;
    const Drag* drag = nullptr;
    const Wind* wind = nullptr;
    double factor = 1;  // all forces are multiplied by it
  };
  NetForce(const Parts& parts, const Particles& particles, const SceneBody& body)
      : parts_(parts), particles_(particles), scene_body_(body) {}

  void set_time(double t) { t_ = t; }  // of the wind, s

  void addScaledExplicitForce(btScalar scale, TVStack& force) override;
  void addScaledForces(btScalar scale, TVStack& force) override { addScaledExplicitForce(scale, force); }
  /// Springs only, at m_q: what the certificate's probe asks.
  void addScaledElasticForce(btScalar scale, TVStack& force);

  void addScaledDampingForce(btScalar, TVStack&) override {}
  void addScaledElasticForceDifferential(btScalar, const TVStack&, TVStack&) override {}
  void addScaledDampingForceDifferential(btScalar, const TVStack&, TVStack&) override {}
  void buildDampingForceDifferentialDiagonal(btScalar, TVStack&) override {}
  /// A value that Bullet does not use: forces of a known type would be merged with the first of their kind.
  btDeformableLagrangianForceType getForceType() override { return static_cast<btDeformableLagrangianForceType>(100); }

 private:
  Parts parts_;
  const Particles& particles_;
  const SceneBody& scene_body_;
  double t_ = 0;
};

}  // namespace crosscheck::bullet
