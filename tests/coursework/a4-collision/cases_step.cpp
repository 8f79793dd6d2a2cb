// Part 4: free particles that fly, slide, stick and bounce.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/coursework/a4-collision/cases.h"

namespace coursework::a4 {
namespace {

struct Start {
  Sphere sphere;
  Vec3 g;
  double h;
  int steps;
  std::vector<Vec3> x, v;
};

Case step_case(const char* call, const Start& s, const char* row, const char* column, int columns, double tolerance) {
  Case c{.call = call, .columns = columns, .tolerance = tolerance, .row = row, .column = column};
  put(c.in, s.sphere);
  put(c.in, s.g);
  c.in.insert(c.in.end(), {s.h, double(s.steps), double(s.x.size())});
  for (const Vec3& x : s.x) put(c.in, x);
  for (const Vec3& v : s.v) put(c.in, v);
  return c;
}

Case path_case(const Start& s, double tolerance) {
  Case c = step_case("contact_path", s, "step", "position", 3, tolerance);
  c.plot_x = 0;
  c.plot_y = 1;
  c.row_size = s.h;
  return c;
}

/// One step of symplectic Euler and mysim's contact rule.
Resolved next(const Start& s, const Vec3& x, const Vec3& v) {
  const Vec3 faster = v + s.h * s.g;
  return resolved(s.sphere, x, x + s.h * faster, faster);
}

/// A particle on the surface, at an angle (rad) from the top. The direction of gravity is random.
Start on_the_slope(Random& random, double angle, double friction) {
  Start s{random_sphere(random, friction, 0), random_gravity(random), 0, 0, {}, {Vec3::Zero()}};
  const Vec3 up = -s.g.normalized();
  const Vec3 n = std::cos(angle) * up + std::sin(angle) * random_tangent(random, up);
  s.x = {s.sphere.centre + s.sphere.contact_radius() * n};
  return s;
}

}  // namespace

Cases free_flight(Random& random) {
  Start s{random_sphere(random, 0.5, 0.5), random_gravity(random), random.uniform(0.01, 0.02), 40, {}, {}};
  // the particle misses the sphere narrowly; after n steps, symplectic Euler is at x0 + n h v0 + n (n + 1) / 2 h^2 g
  const Vec3 n = random_tangent(random, s.g.normalized());
  s.x = {s.sphere.centre + (s.sphere.contact_radius() + random.uniform(0.5, 1)) * n};
  s.v = {-random.uniform(0.1, 0.3) * n + random.uniform(1, 2) * n.cross(s.g.normalized())};
  Case c = path_case(s, 1e-10);  // 40 sums of numbers of a few metres have a round-off of 1e-14
  for (int k = 1; k <= s.steps; ++k)
    put(c.expected, Vec3(s.x[0] + k * s.h * s.v[0] + 0.5 * k * (k + 1) * s.h * s.h * s.g));
  return {c};
}

/// `count` particles around one sphere; `kind` is the situation of the first.
Case one_step_of(Random& random, int count, int kind = 0) {
  Start s{random_sphere(random, random.uniform(0.3, 0.8), random.uniform(0.3, 0.7)),
          random_gravity(random),
          random.uniform(0.01, 0.02),
          1,
          {},
          {}};
  const double r = s.sphere.contact_radius();
  Numbers expected;
  for (int i = 0; i < count; ++i) {
    // the particle is far outside, just above the surface (and slow or fast along it), or inside from the start
    const Vec3 n = random_direction(random), along = random_tangent(random, n);
    const double height[] = {random.uniform(0.5, 1), random.uniform(0.001, 0.005), random.uniform(0.001, 0.005),
                             -random.uniform(0.05, 0.1) * r};
    const double speed[] = {1, random.uniform(0.05, 0.1), random.uniform(6, 9), 1};
    s.x.push_back(s.sphere.centre + (r + height[(i + kind) % 4]) * n);
    s.v.push_back(-random.uniform(2, 4) * n + speed[(i + kind) % 4] * along);
    const Resolved after = next(s, s.x.back(), s.v.back());
    put(expected, after.x);
    put(expected, after.v);
  }
  // a few operations on numbers below 100 have a round-off of 1e-13
  Case c = step_case("contact_step", s, "particle", "state", 6, 1e-10);
  c.expected = expected;
  return c;
}

// the second case has fewer particles: a solution must not keep state between calls
Cases one_step(Random& random) { return {one_step_of(random, 8), one_step_of(random, 4)}; }
// one case for each situation of one_step_of()
Cases small_step(Random& random) {
  Cases cases;
  for (int kind = 0; kind < 4; ++kind) cases.push_back(one_step_of(random, 1, kind));
  return cases;
}

Cases leaving_angle(Random& random) {
  const double start = random.uniform(10, 20) * std::numbers::pi / 180;
  Start s = on_the_slope(random, start, 0);
  s.h = 2e-4 * std::sqrt(s.sphere.contact_radius() / s.g.norm());
  s.steps = 30000;
  // each step of symplectic Euler falls too far by h^2 g / 2. The particle therefore leaves the surface
  // sqrt(h v cos / (3 R sin)) = 0.4 degrees too late, and 0.6 % too fast (measured). With friction or a loss of speed,
  // it would leave the surface at least 5 degrees away from the right place
  Case c = step_case("leaving", s, "whole", "leaving", 2, 1.0);
  const double cosine = 2.0 / 3 * std::cos(start);
  c.expected = {std::acos(cosine) * 180 / std::numbers::pi, 100 * std::sqrt(cosine)};
  return {c};
}

Cases rebound_height(Random& random) {
  const double e = random.uniform(0.4, 0.8), drop = random.uniform(0.4, 0.8);
  Start s{random_sphere(random, 0.5, e), random_gravity(random), 0, 6000, {}, {Vec3::Zero()}};
  s.x = {s.sphere.centre - (s.sphere.contact_radius() + drop) * s.g.normalized()};
  s.h = 5e-4 * std::sqrt(2 * drop / s.g.norm());
  // the moment of impact shifts by at most h. This changes the speed by 2 h / fall time = 0.1 %, the height by 0.2 %
  Case c = step_case("rebound", s, "whole", "rebound", 1, 0.5);
  c.expected = {100 * e * e};
  return {c};
}

Cases coulomb_cone(Random& random) {
  Cases cases;
  for (const double factor : {1.05, 0.8}) {
    const double angle = random.uniform(20, 35) * std::numbers::pi / 180;
    Start s = on_the_slope(random, angle, factor * std::tan(angle));
    s.h = 0.01 * std::sqrt(s.sphere.contact_radius() / s.g.norm());
    s.steps = 100;
    // a sticking particle stays exactly at the start; for a sliding one mysim computes the same rule, with a round-off
    // of 1e-16 m in each step
    Case c = path_case(s, 1e-9);
    Resolved now{s.x[0], s.v[0]};
    for (int k = 0; k < s.steps; ++k) {
      if (factor < 1) now = next(s, now.x, now.v);
      put(c.expected, now.x);
    }
    cases.push_back(c);
  }
  return cases;
}

}  // namespace coursework::a4
