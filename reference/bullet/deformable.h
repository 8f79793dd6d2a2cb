// Bullet's deformable world, explicit and implicit, and the forces added to it.
#pragma once

#include <BulletSoftBody/btDeformableGravityForce.h>
#include <BulletSoftBody/btDeformableLagrangianForce.h>
#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>

#include "mysim/run/run.h"
#include "reference/bullet/soft_body.h"

namespace crosscheck::bullet {

// A force class for Bullet's deformable world. It applies what Bullet's own forces cannot: springs with more than two
// stiffnesses, with another law than Hooke's, or solved implicitly without blowing up; bending; dashpots that differ or
// are attached to moved pins; drag that is implicit or differs between particles; and wind.

/// In the explicit world, springs, drag and wind act at (x_n, v_n, t_n), and Bullet solves the dashpots separately and
/// implicitly. In the implicit world all forces are evaluated at q = x + h v, v and t_{n+1}. The springs' matrix omits
/// the negative transverse stiffness of compressed springs, so that it is positive definite. Wind on triangles is
/// constant within the step.
class SceneForce : public btDeformableLagrangianForce {
 public:
  struct CarriedTerms {
    const Springs* springs = nullptr;
    const Bending* bending = nullptr;
    const Dashpots* dashpots = nullptr;
    const Drag* drag = nullptr;
    const Wind* wind = nullptr;
    const Aerodynamics* air = nullptr;
    double factor = 1;  // multiplies all forces but the dashpots'
    bool implicit = false;
    bool any() const { return springs || bending || dashpots || drag || wind || air; }
  };
  SceneForce(const CarriedTerms& carried, const Scene& scene, const SoftBody& body);

  const CarriedTerms& carried() const { return carried_; }
  void set_time(double t) { t_ = t; }  // s, for wind and pins

  void addScaledForces(btScalar scale, TVStack& force) override;
  void addScaledExplicitForce(btScalar scale, TVStack& force) override;
  void addScaledDampingForce(btScalar scale, TVStack& force) override;
  void addScaledDampingForceDifferential(btScalar scale, const TVStack& dv, TVStack& df) override;
  void addScaledElasticForceDifferential(btScalar scale, const TVStack& dx, TVStack& df) override;
  void buildDampingForceDifferentialDiagonal(btScalar scale, TVStack& diagonal) override;

  /// Add only the spring force, or only the bending force, at m_q. The certificate's probe calls them, too.
  void addScaledElasticForce(btScalar scale, TVStack& force);
  void add_bending_force(btScalar scale, TVStack& force);
  /// A type that Bullet does not use, because Bullet would merge the force with the first one of the same type.
  static constexpr auto type = static_cast<btDeformableLagrangianForceType>(7);
  btDeformableLagrangianForceType getForceType() override { return type; }

 private:
  const btSoftBody::Node& node(int particle) const;
  btVector3 velocity(int particle) const;
  btVector3 dashpot_axis(int a, int b) const;  // direction from b to a, along which the dashpot acts
  void add_particle_forces(btScalar scale, TVStack& force);

  CarriedTerms carried_;
  const Scene& scene_;
  const SoftBody& soft_body_;
  double t_ = 0;
  State state_;                // for aerodynamic forces
  Forces aerodynamic_forces_;  // N
};

// The forces of a scene in Bullet's deformable world and their read-back: Bullet's own forces where it supports the
// law, otherwise SceneForce.

class DeformableForces {
 public:
  /// Adds the forces to the world. implicit: the world's mode; shipped: use Bullet's own spring force in implicit mode
  /// too. Throws Unsupported if that force does not support the springs.
  DeformableForces(const Scene& scene, double h, bool implicit, bool shipped, SoftBody& body,
                   btDeformableMultiBodyDynamicsWorld& world);

  void set_time(double t);  // s, for wind and pins

  /// Fills in gravity, drag rates, and probes of springs, bending, dashpots and wind. All are read from the forces that
  /// the world's solver holds.
  void read_back(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world, Readback& readback) const;

 private:
  void carry_drag(const Drag* drag, SceneForce::CarriedTerms& ours);
  void carry_springs(const Springs* springs, const Dashpots* dashpots, SceneForce::CarriedTerms& ours, bool shipped);
  /// Drag rate of each particle (1/s); nullopt if the drag cannot be separated from other forces.
  std::optional<std::vector<double>> drag_rates(SceneForce* own) const;
  ForceProbe probe(btAlignedObjectArray<btDeformableLagrangianForce*>& in_world) const;

  const Scene& scene_;
  double h_;
  bool implicit_;
  SoftBody& soft_body_;
  double factor_ = 1;  // 1 - h gamma: in each step, the body's drag multiplies velocities by this factor
  double t_ = 0;
  std::map<std::string, std::string> mapped_;
  std::unique_ptr<btDeformableMassSpringForce> spring_force_;
  std::unique_ptr<btDeformableGravityForce> gravity_force_;
  std::unique_ptr<SceneForce> scene_force_;
};

struct DeformableSettings {
  bool implicit = false;
  bool shipped = false;   // implicit: Bullet's own spring force, with indefinite second derivatives
  bool tight = false;     // implicit: conjugate gradients stop at 1e-28 of the squared residual instead of Bullet's
                          // 2.2e-16
  bool projected = true;  // implicit: setUseProjection(true), without which the world freezes
  double voxel = 0.005;   // m, voxel size of the distance field; Bullet's default
  BulletDefaults defaults;
};

/// btDeformableMultiBodyDynamicsWorld.
///
/// Explicit: symplectic Euler with the scene's own laws. Bullet's own mass-spring force applies the springs if possible
/// (at most two stiffnesses, Hooke's law). In this case, stiffness and gravity are divided by (1 - h gamma) first, and
/// the body's drag factor is h gamma (gamma: drag rate), so that Bullet's rule v' = (v + h f/m)(1 - h gamma) equals
/// drag as a force at v_n. After these forces, Bullet solves the dashpots implicitly.
///
/// Implicit: one Newton step of backward Euler from q = x + h v, that is, (M + h C + h^2 K(q)) dv = h f(q, v). This is
/// mysim's implicit-euler+linear.
///
/// Throws Unsupported with the reason.
Outcome run_deformable(const Scene& scene, const Run& run, Observer& observer, const DeformableSettings& settings);

}  // namespace crosscheck::bullet
