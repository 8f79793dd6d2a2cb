// Bullet's deformable world with several soft bodies.
#pragma once

#include "mysim/run/run.h"

namespace crosscheck::bullet {

/// btDeformableMultiBodyDynamicsWorld, explicit: each piece of the spring graph is a body with its own mass-spring
/// force and gravity force, as in Bullet's demos. The world has no read-back, so only its runs show whether each body
/// keeps its own stiffness. Throws Unsupported if a piece has several stiffnesses, or if the scene contains anything
/// but Hookean springs and gravity.
Outcome run_bodies(const Scene& scene, const Run& run, Observer& observer);

}  // namespace crosscheck::bullet
