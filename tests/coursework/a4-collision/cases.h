// Inputs and expected answers of the collision assignment, from mysim's contact rule, its stepper and closed forms.
// Includes none of the student's headers.
#pragma once

#include <vector>

#include "tests/coursework/grader/vectors.h"

namespace coursework::a4 {

using crosscheck::Points;
using crosscheck::Sphere;
using crosscheck::Vec3;
using Cases = std::vector<Case>;

/// A random unit vector perpendicular to n.
Vec3 random_tangent(Random& random, const Vec3& n);
Sphere random_sphere(Random& random, double friction, double restitution);
/// About 10 m/s^2 in a random direction.
Vec3 random_gravity(Random& random);

using coursework::put;
void put(Numbers& out, const Sphere& sphere);

/// x and v of one particle after mysim's contact rule.
struct Resolved {
  Vec3 x, v;
};
Resolved resolved(const Sphere& sphere, const Vec3& before, Vec3 x, Vec3 v);

// part 1
Cases gap(Random& random);
Cases normal(Random& random);
Cases nearest(Random& random);
Cases very_centre(Random& random);
Cases plane_places(Random& random);
Cases small_place(Random& random);
// part 2
Cases untouched(Random& random);
Cases pushed_out(Random& random);
Cases sliding(Random& random);
Cases holding(Random& random);
Cases inside_at_the_start(Random& random);
Cases plane_moves(Random& random);
Cases small_move(Random& random);
// part 3
Cases going_away(Random& random);
Cases inward_removed(Random& random);
Cases bounce(Random& random);
Cases rubbing(Random& random);
Cases stopped(Random& random);
Cases small_velocity(Random& random);
// part 4
Cases free_flight(Random& random);
Cases one_step(Random& random);
Cases small_step(Random& random);
Cases leaving_angle(Random& random);
Cases rebound_height(Random& random);
Cases coulomb_cone(Random& random);
// part 5
Cases accelerations(Random& random);
Cases small_accelerations(Random& random);
Cases pins_and_spheres(Random& random);
Cases small_cloth_step(Random& random);
Cases patch_on_a_slope(Random& random);
Cases drape(Random& random);

}  // namespace coursework::a4
