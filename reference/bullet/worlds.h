// Bullet's two soft-body worlds as engines, in the precision they are compiled in.
#pragma once

#include "mysim/run.h"

namespace crosscheck::bullet {

/// btDeformableMultiBodyDynamicsWorld in its explicit mode: symplectic Euler with the scene's own laws. Bullet's own
/// mass-spring force carries the springs wherever it can (at most two stiffnesses, one drag rate); then, with gamma the
/// drag rate, stiffness and gravity are handed over divided by (1 - h gamma) and the body's drag factor is h gamma,
/// which makes its rule v' = (v + h f/m)(1 - h gamma) equal to drag as a force at v_n. Throws Unsupported with the
/// reason.
Outcome run_deformable_explicit(const Scene& scene, const Run& run, Observer& observer);

/// btSoftRigidDynamicsWorld: position-based links. Stiffness is mapped per link by kLST = 1 - (1 + k h^2/mu)^(-1/n),
/// with mu the pair's reduced mass and n the iterations; drag by kDP = 1 - exp(-gamma h). Its link law is not Hooke's
/// and its friction is not Coulomb's: both are marked as different laws.
Outcome run_pbd(const Scene& scene, const Run& run, Observer& observer, int iterations);

/// Any of them by name, with the options behind the pluses of a method. Throws InputError for names and options that it
/// does not know, Unsupported with the reason.
Outcome run_world(const std::string& world, const std::vector<std::string>& options, const Scene& scene, const Run& run,
                  Observer& observer);

}  // namespace crosscheck::bullet
