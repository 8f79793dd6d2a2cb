// Bullet's deformable world with several soft bodies.
#pragma once

#include "mysim/run/run.h"

namespace crosscheck::bullet {

/// btDeformableMultiBodyDynamicsWorld, explicit: each piece of the spring graph is a body of its own, and has a
/// mass-spring force and a gravity force of its own, as in Bullet's demos. Whether the world keeps the stiffnesses
/// apart is what a run shows: there is no read-back. Throws Unsupported where a piece has several stiffnesses or the
/// scene anything beside Hooke's springs and gravity.
Outcome run_bodies(const Scene& scene, const Run& run, Observer& observer);

}  // namespace crosscheck::bullet
