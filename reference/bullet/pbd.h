// Bullet's position-based soft-body world.
#pragma once

#include "mysim/run/run.h"
#include "reference/bullet/soft_body.h"

namespace crosscheck::bullet {

struct PbdSettings {
  int iterations = 1;
  bool demo = false;      // as in Bullet's own cloth demos: every link at kLST = 1
  bool own_wind = false;  // Bullet's wind on triangles instead of the scene's
  double voxel = 0.02;    // m, voxel size of the distance field; at Bullet's 0.25, a ball would be misplaced by 1.5 cm
  BulletDefaults defaults;
};

/// btSoftRigidDynamicsWorld: position-based links. Stiffness is mapped per link, drag for the whole body
/// (parameters.h). Links do not follow Hooke's law, nor friction Coulomb's: both are reported as different laws. Throws
/// Unsupported with the reason.
Outcome run_pbd(const Scene& scene, const Run& run, Observer& observer, const PbdSettings& settings);

}  // namespace crosscheck::bullet
