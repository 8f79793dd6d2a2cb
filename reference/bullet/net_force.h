// A force class of our own in Bullet's deformable world, for what Bullet's own forces cannot carry: more than two
// stiffnesses, another spring law than Hooke's, springs whose implicit step cannot blow up, dashpots that differ or
// hang on moved pins, drag that differs between particles or is implicit, and wind.
#pragma once

#include <BulletSoftBody/btDeformableLagrangianForce.h>

#include "reference/bullet/scene_body.h"

namespace crosscheck::bullet {

/// In the explicit world springs, drag and wind act at (x_n, v_n, t_n), and Bullet solves the dashpots by themselves,
/// implicitly. In the implicit world all is taken at q = x + h v, v and t_{n+1}; the springs' stiffness is handed over
/// with its negative part left out (a shortened spring takes nothing from the stiffness across itself), which keeps the
/// matrix positive definite; wind on triangles counts as a constant within the step.
class NetForce : public btDeformableLagrangianForce {
 public:
  struct Parts {
    const Springs* springs = nullptr;
    const Dashpots* dashpots = nullptr;
    const Drag* drag = nullptr;
    const Wind* wind = nullptr;
    const Aerodynamics* air = nullptr;
    double factor = 1;  // all forces but the dashpots' are multiplied by it
    bool implicit = false;
    bool any() const { return springs || dashpots || drag || wind || air; }
  };
  NetForce(const Parts& parts, const Scene& scene, const SceneBody& body);

  const Parts& parts() const { return parts_; }
  void set_time(double t) { t_ = t; }  // of wind and pins, s

  void addScaledForces(btScalar scale, TVStack& force) override;
  void addScaledExplicitForce(btScalar scale, TVStack& force) override;
  void addScaledDampingForce(btScalar scale, TVStack& force) override;
  void addScaledDampingForceDifferential(btScalar scale, const TVStack& dv, TVStack& df) override;
  void addScaledElasticForceDifferential(btScalar scale, const TVStack& dx, TVStack& df) override;
  void buildDampingForceDifferentialDiagonal(btScalar scale, TVStack& diagonal) override;

  /// Springs only, at m_q: what the certificate's probe asks too.
  void addScaledElasticForce(btScalar scale, TVStack& force);
  /// A value that Bullet does not use: forces of a known type would be merged with the first of their kind.
  static constexpr auto type = static_cast<btDeformableLagrangianForceType>(100);
  btDeformableLagrangianForceType getForceType() override { return type; }

 private:
  const btSoftBody::Node& node(int particle) const;
  btVector3 velocity(int particle) const;
  btVector3 line(int a, int b) const;  // from b to a, along which a dashpot acts
  void add_particle_forces(btScalar scale, TVStack& force);

  Parts parts_;
  const Scene& scene_;
  const SceneBody& scene_body_;
  double t_ = 0;
  State seen_;     // by the air
  Forces of_air_;  // N
};

}  // namespace crosscheck::bullet
