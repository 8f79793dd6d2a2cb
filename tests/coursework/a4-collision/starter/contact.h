// The functions that you write, and their data types. Do not change this file: the grader uses its own copy.
// Units: m, kg, s, N. The y axis points up.
#pragma once

#include <vector>

#include "springs.h"
#include "vec3.h"

/// A solid ball that does not move. Particles stay outside its contact surface, the sphere of radius + margin.
struct Sphere {
  Vec3 centre;             // m
  double radius = 0;       // m
  double margin = 0;       // m, half the thickness of the cloth
  double friction = 0;     // Coulomb's mu, dimensionless
  double restitution = 0;  // e, 0 to 1
};

/// A solid half-space that does not move: a floor, a slope, a wall. Particles stay outside its contact surface, a plane
/// at a distance of `margin` from its face.
struct Plane {
  Vec3 point;           // m, somewhere on the face
  Vec3 normal;          // out of the solid, length 1
  double margin = 0;    // m
  double friction = 0;  // Coulomb's mu, dimensionless
};

// ---- closest.cpp

/// Distance from the contact surface, m: positive outside, negative inside.
double gap(const Sphere& sphere, const Vec3& x);
/// Outward direction at x, length 1. At the exact centre, where all directions are equivalent: (0, 1, 0).
Vec3 normal(const Sphere& sphere, const Vec3& x);
/// The point of the contact surface that is nearest to x; for the exact centre, the topmost one.
Vec3 nearest(const Sphere& sphere, const Vec3& x);
/// The same for a plane.
double gap(const Plane& plane, const Vec3& x);
inline Vec3 normal(const Plane& plane, const Vec3& /*x*/) { return plane.normal; }
Vec3 nearest(const Plane& plane, const Vec3& x);

// ---- position.cpp

/// The position after contact of a particle that began the step at `before` and would go to `proposed`. Returns
/// `proposed` if that point is not inside.
Vec3 corrected_position(const Sphere& sphere, const Vec3& before, const Vec3& proposed);
Vec3 corrected_position(const Plane& plane, const Vec3& before, const Vec3& proposed);

// ---- velocity.cpp

/// The velocity after contact at a point with outward normal n. Returns v if it does not point inwards.
Vec3 corrected_velocity(const Sphere& sphere, const Vec3& n, const Vec3& v);

// ---- step.cpp

struct State {
  std::vector<Vec3> x;  // m
  std::vector<Vec3> v;  // m/s
};

/// One step of length h (s) of free particles under gravity g (m/s^2): symplectic Euler, then contact.
State contact_step(const Sphere& sphere, const State& state, const Vec3& g, double h);

// ---- cloth.cpp

struct Cloth {
  std::vector<double> mass;  // kg, of each particle
  std::vector<int> pins;     // these particles are fixed
  std::vector<Spring> springs;
  Vec3 gravity;     // m/s^2
  double drag = 0;  // N s/m, of each particle
};

/// Acceleration of each particle by springs, gravity and drag, m/s^2; zero at pins.
std::vector<Vec3> accelerations(const Cloth& cloth, const State& state);
/// One step of length h (s) of a cloth among spheres: symplectic Euler, then contact with one sphere after the other.
State cloth_step(const Cloth& cloth, const std::vector<Sphere>& spheres, const State& state, double h);
