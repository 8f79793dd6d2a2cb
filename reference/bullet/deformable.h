// Bullet's deformable world, in its explicit and its implicit mode.
#pragma once

#include "mysim/run.h"
#include "reference/bullet/scene_body.h"

namespace crosscheck::bullet {

struct DeformableSettings {
  bool implicit = false;
  bool shipped = false;   // implicit: Bullet's own spring force, whose second derivatives are indefinite
  bool tight = false;     // implicit: conjugate gradients to 1e-28 of the squared residual, not to round-off of it
  bool projected = true;  // implicit: with setUseProjection(true); without it the world freezes
  double voxel = 0.005;   // m, of the distance field: Bullet's default here
  Defaults defaults;
};

/// btDeformableMultiBodyDynamicsWorld.
///
/// Explicit: symplectic Euler with the scene's own laws. Bullet's own mass-spring force carries the springs wherever it
/// can (at most two stiffnesses, Hooke's law); then, with gamma the drag rate, stiffness and gravity are handed over
/// divided by (1 - h gamma) and the body's drag factor is h gamma, which makes its rule v' = (v + h f/m)(1 - h gamma)
/// equal to drag as a force at v_n. Dashpots are solved implicitly by Bullet after that.
///
/// Implicit: one Newton step of backward Euler from q = x + h v, (M + h C + h^2 K(q)) dv = h f(q, v): mysim's
/// implicit-euler+linear.
///
/// Throws Unsupported with the reason.
Outcome run_deformable(const Scene& scene, const Run& run, Observer& observer, const DeformableSettings& settings);

}  // namespace crosscheck::bullet
