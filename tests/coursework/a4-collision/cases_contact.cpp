// Parts 1 to 3: one particle and one sphere.
#include "tests/coursework/a4-collision/cases.h"

namespace coursework::a4 {
namespace {

// a handful of operations on numbers of about 10 m or m/s have a round-off of 1e-14; friction divides by lengths of at
// least 0.01, which raises the round-off to 1e-12
constexpr double round_off = 1e-9;

Case contact_case(const char* call, const Sphere& sphere, int count, const char* column, int columns) {
  Case c{.call = call, .columns = columns, .tolerance = round_off, .row = "place", .column = column};
  put(c.in, sphere);
  c.in.push_back(count);
  return c;
}

constexpr int places = 6;

/// Positions alternately outside and inside the sphere, in random directions. `expect` appends the expected numbers.
template <class Expect>
Cases around(Random& random, const char* call, const char* column, int columns, Expect expect) {
  const Sphere sphere = random_sphere(random, 0, 0);
  Case c = contact_case(call, sphere, places, column, columns);
  for (int i = 0; i < places; ++i) {
    const double height = i % 2 == 0 ? random.uniform(0.1, 1) : -random.uniform(0.1, 0.4);
    const Vec3 n = random_direction(random);
    put(c.in, Vec3(sphere.centre + (sphere.contact_radius() + height) * n));
    expect(c.expected, sphere, n, height);
  }
  return {c};
}

/// A particle that began at `before` and proposes to go to `proposed`, which is `depth` inside the sphere. Its
/// displacement along the sphere is `multiple` times mu times depth: it slides if `multiple` > 1, and sticks if
/// `multiple` < 1.
struct Move {
  Vec3 before, proposed;
};
Move random_move(Random& random, const Sphere& sphere, double depth, double multiple) {
  const Vec3 n = random_direction(random), along = random_tangent(random, n);
  const double r = sphere.contact_radius(), mu = sphere.friction > 0 ? sphere.friction : 1;
  const Vec3 before = sphere.centre + r * n - multiple * mu * depth * along + random.uniform(0.02, 0.06) * n;
  return {before, sphere.centre + (r - depth) * n};
}

Cases moves(Random& random, double friction, double least, double most) {
  const Sphere sphere = random_sphere(random, friction, 0);
  Case c = contact_case("corrected_position", sphere, places, "position", 3);
  for (int i = 0; i < places; ++i) {
    const double depth = random.uniform(0.04, 0.1);
    // every other particle is near the limit of friction, where a wrong comparison is noticed
    const double multiple = i % 2 == 0 ? random.uniform(least, most)
                            : most < 1 ? random.uniform(0.9, 0.97)
                                       : random.uniform(1.05, 1.3);
    Move move = random_move(random, sphere, depth, multiple);
    if (friction == 0 && i == 0)  // straight down, with exactly no motion along the sphere
      move = {sphere.centre + Vec3(0, sphere.contact_radius() + 0.02, 0),
              sphere.centre + Vec3(0, sphere.contact_radius() - depth, 0)};
    put(c.in, move.before);
    put(c.in, move.proposed);
    put(c.expected, resolved(sphere, move.before, move.proposed, Vec3::Zero()).x);
  }
  return {c};
}

/// Velocities with a normal component (against n if sign < 0) and a tangential one. The tangential component is `least`
/// to `most` times mu (1 + e) times the normal one; without friction, `least` to `most` times the normal one.
Cases velocities(Random& random, double friction, double restitution, double sign, double least, double most) {
  const Sphere sphere = random_sphere(random, friction, restitution);
  Case c = contact_case("corrected_velocity", sphere, places, "velocity", 3);
  for (int i = 0; i < places; ++i) {
    Vec3 n = random_direction(random);
    const Vec3 along = random_tangent(random, n);
    const double normal = random.uniform(0.5, 2), change = (1 + restitution) * normal;
    const double most_lost = friction * change;  // Coulomb
    double tangential = random.uniform(least, most) * (friction > 0 ? most_lost : normal);
    if (friction == 0 && i == 0) n = Vec3::UnitY(), tangential = 0;  // straight down: no tangential component
    const Vec3 v = sign * normal * n + tangential * along;
    put(c.in, n);
    put(c.in, v);
    const Vec3 after = restitution * normal * n + std::max(0.0, tangential - most_lost) * along;
    put(c.expected, sign > 0 ? v : after);
  }
  return {c};
}

}  // namespace

namespace {

/// A sphere around the origin that a particle touches at height 1, so that the expected numbers are simple.
Sphere plain_sphere(double friction, double restitution) {
  return {Vec3::Zero(), 0.75, 0.25, friction, restitution, std::nullopt};
}

Case place_case(const char* call, const char* column, int columns, const Vec3& x, const Numbers& expected) {
  Case c = contact_case(call, plain_sphere(0, 0), 1, column, columns);
  put(c.in, x);
  c.expected = expected;
  return c;
}

Case move_case(double friction, const Vec3& before, const Vec3& proposed) {
  const Sphere sphere = plain_sphere(friction, 0);
  Case c = contact_case("corrected_position", sphere, 1, "position", 3);
  put(c.in, before);
  put(c.in, proposed);
  put(c.expected, resolved(sphere, before, proposed, Vec3::Zero()).x);
  return c;
}

/// Contact at the top of the sphere.
Case velocity_case(double friction, double restitution, const Vec3& v, const Vec3& after) {
  Case c = contact_case("corrected_velocity", plain_sphere(friction, restitution), 1, "velocity", 3);
  put(c.in, Vec3(0, 1, 0));
  put(c.in, v);
  put(c.expected, after);
  return c;
}

}  // namespace

Cases small_place(Random&) {
  return {place_case("gap", "gap", 1, {0, 3, 0}, {2}), place_case("gap", "gap", 1, {0, 0.5, 0}, {-0.5}),
          place_case("normal", "normal", 3, {0, 3, 0}, {0, 1, 0}),
          place_case("nearest", "position", 3, {0, 3, 0}, {0, 1, 0}),
          place_case("nearest", "position", 3, {0, 0.5, 0}, {0, 1, 0})};
}

Cases small_move(Random&) {
  // not inside; straight down; along the sphere without friction; stopped by friction; sliding with friction
  return {move_case(0.5, {0, 3, 0}, {0.5, 2, 0}), move_case(0, {0, 1.5, 0}, {0, 0.75, 0}),
          move_case(0, {-0.5, 1.5, 0}, {0, 0.75, 0}), move_case(0.5, {-0.0625, 1.5, 0}, {0, 0.75, 0}),
          move_case(0.5, {-0.5, 1.5, 0}, {0, 0.75, 0})};
}

Cases small_velocity(Random&) {
  // separating; straight inwards; inwards and along the sphere: without friction and restitution, with restitution,
  // with friction, stopped by friction, with friction and restitution
  return {velocity_case(0.25, 0.5, {3, 2, 0}, {3, 2, 0}),    velocity_case(0, 0, {0, -2, 0}, {0, 0, 0}),
          velocity_case(0, 0, {3, -2, 0}, {3, 0, 0}),        velocity_case(0, 0.5, {3, -2, 0}, {3, 1, 0}),
          velocity_case(0.25, 0, {3, -2, 0}, {2.5, 0, 0}),   velocity_case(0.25, 0, {0.25, -2, 0}, {0, 0, 0}),
          velocity_case(0.25, 0.5, {3, -2, 0}, {2.25, 1, 0})};
}

Cases gap(Random& random) {
  return around(random, "gap", "gap", 1,
                [](Numbers& out, const Sphere&, const Vec3&, double height) { out.push_back(height); });
}

Cases normal(Random& random) {
  return around(random, "normal", "normal", 3, [](Numbers& out, const Sphere&, const Vec3& n, double) { put(out, n); });
}

Cases nearest(Random& random) {
  return around(random, "nearest", "position", 3, [](Numbers& out, const Sphere& sphere, const Vec3& n, double) {
    put(out, Vec3(sphere.centre + sphere.contact_radius() * n));
  });
}

Cases very_centre(Random& random) {
  const Sphere sphere = random_sphere(random, 0, 0);
  Case c = contact_case("normal_and_nearest", sphere, 1, "centre", 6);
  put(c.in, sphere.centre);
  put(c.expected, Vec3(0, 1, 0));
  put(c.expected, Vec3(sphere.centre + Vec3(0, sphere.contact_radius(), 0)));
  return {c};
}

Cases untouched(Random& random) {
  const Sphere sphere = random_sphere(random, random.uniform(0.3, 0.8), 0);
  Case c = contact_case("corrected_position", sphere, places, "position", 3);
  for (int i = 0; i < places; ++i) {
    const double depth = -random.uniform(0.005, 0.3);  // outside: the position must not change, not even by round-off
    const Move move = random_move(random, sphere, depth, 1);
    put(c.in, move.before);
    put(c.in, move.proposed);
    put(c.expected, move.proposed);
  }
  c.tolerance = 0;
  return {c};
}

Cases pushed_out(Random& random) { return moves(random, 0, 1.5, 4); }
Cases sliding(Random& random) { return moves(random, random.uniform(0.3, 0.8), 1.5, 4); }
Cases holding(Random& random) { return moves(random, random.uniform(0.3, 0.8), 0.2, 0.8); }

Cases inside_at_the_start(Random& random) {
  const Sphere sphere = random_sphere(random, random.uniform(0.3, 0.8), 0);
  const double r = sphere.contact_radius();
  Case c = contact_case("corrected_position", sphere, places, "position", 3);
  for (int i = 0; i < places; ++i) {
    // both positions are inside; one proposed position is the exact centre; friction stops two of the other particles
    const Vec3 n = random_direction(random);
    const double depth = random.uniform(0.1, 0.2) * r, along = random.uniform(1.5, 2.5) * sphere.friction * depth;
    const Vec3 proposed = i == 0 ? sphere.centre : Vec3(sphere.centre + (r - depth) * n);
    const Vec3 before = proposed - 0.05 * r * n -
                        (i == 0       ? 0.1
                         : i % 2 == 0 ? 0.3
                                      : 1) *
                            along * random_tangent(random, n);
    put(c.in, before);
    put(c.in, proposed);
    put(c.expected, resolved(sphere, before, proposed, Vec3::Zero()).x);
  }
  return {c};
}

namespace {

crosscheck::Plane random_plane(Random& random, double friction) {
  return {random_vector(random, 1), random_direction(random), random.uniform(0.02, 0.05), friction, 0, std::nullopt};
}
Case plane_case(const char* call, const crosscheck::Plane& plane, const char* column, int columns) {
  Case c{.call = call, .columns = columns, .tolerance = round_off, .row = "place", .column = column};
  put(c.in, plane.point);
  put(c.in, plane.normal);
  c.in.insert(c.in.end(), {plane.margin, plane.friction, double(places)});
  return c;
}

}  // namespace

/// Positions alternately outside and inside the solid.
Cases plane_places(Random& random) {
  const crosscheck::Plane plane = random_plane(random, 0);
  Case c = plane_case("plane", plane, "gap_and_nearest", 4);
  for (int i = 0; i < places; ++i) {
    const double height = (i % 2 == 0 ? 1 : -1) * random.uniform(0.1, 1);
    const Vec3 on =
        plane.point + plane.margin * plane.normal + random.uniform(1, 3) * random_tangent(random, plane.normal);
    put(c.in, Vec3(on + height * plane.normal));
    c.expected.push_back(height);
    put(c.expected, on);
  }
  return {c};
}

/// Every third particle stays outside; the others alternately slide and stick.
Cases plane_moves(Random& random) {
  const crosscheck::Plane plane = random_plane(random, random.uniform(0.3, 0.8));
  Case c = plane_case("on_plane", plane, "position", 3);
  const Vec3 origin = plane.point + plane.margin * plane.normal;
  for (int i = 0; i < places; ++i) {
    const double depth = (i % 3 == 0 ? -1 : 1) * random.uniform(0.04, 0.1);
    const double multiple = i % 3 == 1 ? random.uniform(1.5, 4) : random.uniform(0.2, 0.8);
    const Vec3 on = origin + random_tangent(random, plane.normal), proposed = on - depth * plane.normal;
    const Vec3 before = on + random.uniform(0.01, 0.03) * plane.normal -
                        multiple * plane.friction * std::abs(depth) * random_tangent(random, plane.normal);
    Vec3 x = proposed, v = Vec3::Zero();
    resolve_contact(plane, origin, before, x, v);
    put(c.in, before);
    put(c.in, proposed);
    put(c.expected, x);
  }
  return {c};
}

Cases going_away(Random& random) {
  return velocities(random, random.uniform(0.3, 0.8), random.uniform(0.3, 0.7), 1, 0.5, 2);
}
Cases inward_removed(Random& random) { return velocities(random, 0, 0, -1, 0.5, 2); }
Cases bounce(Random& random) { return velocities(random, 0, random.uniform(0.3, 0.7), -1, 0.5, 2); }
Cases rubbing(Random& random) {
  return velocities(random, random.uniform(0.3, 0.8), random.uniform(0.3, 0.7), -1, 1.5, 3);
}
Cases stopped(Random& random) {
  return velocities(random, random.uniform(0.3, 0.8), random.uniform(0.3, 0.7), -1, 0.2, 0.5);
}

}  // namespace coursework::a4
