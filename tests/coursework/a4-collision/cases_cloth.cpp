// Part 5: a cloth among spheres, computed with mysim's terms, its symplectic Euler and its contacts.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "mysim/run/contacts.h"
#include "mysim/scene/grid.h"
#include "mysim/steppers/steppers.h"
#include "tests/coursework/a4-collision/cases.h"

namespace coursework::a4 {
namespace {

using crosscheck::State;

struct Scene {
  crosscheck::Model model;
  State start;
  Vec3 gravity;
  double drag;
  std::vector<crosscheck::Spring> springs;
  std::vector<Sphere> spheres;

  Numbers cloth() const;
  Case run(const char* call, double h, int steps, int watched) const;
};

/// Adds masses, pins and terms to a scene that has particles and springs.
void complete(Random& random, Scene& scene, const std::vector<int>& pins) {
  const int count = static_cast<int>(scene.start.x.cols());
  scene.gravity = {0, -random.uniform(8, 12), 0};
  scene.drag = random.uniform(0.03, 0.05);
  crosscheck::Particles& p = scene.model.particles;
  p.mass.resize(count);
  for (int i = 0; i < count; ++i) p.mass[i] = random.rounds() ? 0.01 * (i + 1) : random.uniform(0.01, 0.015);
  p.pins = pins;
  p.pinned.assign(count, 0);
  for (int pin : pins) p.pinned[pin] = 1;
  p.pin_home = scene.start.x(Eigen::seqN(0, 3), pins);
  scene.model.terms = {crosscheck::Gravity{scene.gravity}, crosscheck::Springs{scene.springs},
                       crosscheck::Drag{Eigen::VectorXd::Constant(count, scene.drag)}};
}

/// A row of a few falling particles, with springs between neighbours.
Scene few(Random& random, int count, const std::vector<int>& pins) {
  Scene scene;
  scene.start = {0, Points::Zero(3, count), Points::Zero(3, count)};
  for (int i = 0; i < count; ++i) {
    scene.start.x.col(i) = Vec3(0.25 * i, 0, 0);
    if (i == 0 || pins.empty()) scene.start.v.col(i) = Vec3(0.5, -2, 0);
    if (i > 0) scene.springs.push_back({i - 1, i, 100, 0.2});
  }
  complete(random, scene, pins);
  return scene;
}

/// A square cloth of n x n particles, centred at `middle`, with sides along the unit vectors u and v.
Scene square(Random& random, int n, double side, const Vec3& middle, const Vec3& u, const Vec3& v,
             const std::vector<int>& pins) {
  Scene scene;
  crosscheck::Grid grid{};
  grid.nu = grid.nv = n;
  grid.nw = 1;
  grid.u = side * u;
  grid.v = side * v;
  grid.origin = middle - 0.5 * (grid.u + grid.v);
  const double k = random.uniform(80, 120);
  grid.stiffness = {k, 0.8 * k, 0.7 * k};
  scene.start = {0, grid_points(grid), Points::Zero(3, grid.size())};
  scene.springs = grid_springs(grid);
  complete(random, scene, pins);
  return scene;
}

Numbers Scene::cloth() const {
  const crosscheck::Particles& p = model.particles;
  Numbers in{double(p.size())};
  in.insert(in.end(), p.mass.begin(), p.mass.end());
  in.push_back(static_cast<double>(p.pins.size()));
  in.insert(in.end(), p.pins.begin(), p.pins.end());
  in.push_back(static_cast<double>(springs.size()));
  for (const auto& s : springs) in.insert(in.end(), {double(s.a), double(s.b), s.k, s.rest});
  put(in, gravity);
  in.push_back(drag);
  put(in, start.x);
  put(in, start.v);
  return in;
}

/// Runs mysim. Expects the path of the particle `watched` or, if watched < 0, the state of every particle at the end.
Case Scene::run(const char* call, double h, int steps, int watched) const {
  Case c{.call = call, .in = cloth(), .columns = watched < 0 ? 6 : 3};
  c.in.push_back(static_cast<double>(spheres.size()));
  for (const Sphere& sphere : spheres) put(c.in, sphere);
  c.in.insert(c.in.end(), {h, double(steps)});
  if (watched >= 0) c.in.push_back(watched);
  crosscheck::Model full = model;
  full.terms.push_back(crosscheck::Spheres{spheres});
  crosscheck::System system(full);
  crosscheck::Contacts contacts(full, crosscheck::ContactRule::coulomb);
  crosscheck::Workspace work(start);
  State state = start;
  for (int n = 0; n < steps; ++n) {
    contacts.begin(state);
    symplectic_euler(system, state, h, work);
    state.t = (n + 1) * h;
    contacts.resolve(state);
    if (watched >= 0) put(c.expected, Vec3(state.x.col(watched)));
  }
  if (watched < 0)
    for (int i = 0; i < state.x.cols(); ++i) {
      put(c.expected, Vec3(state.x.col(i)));
      put(c.expected, Vec3(state.v.col(i)));
    }
  c.row = watched < 0 ? "particle" : "step";
  c.column = watched < 0 ? "state" : "position";
  if (watched >= 0) {
    c.plot_x = 0;
    c.plot_y = 1;
    c.row_size = h;
  }
  return c;
}

void shake(Random& random, Scene& scene, double position, double velocity) {
  for (int i = 0; i < scene.start.x.cols(); ++i) {
    if (scene.model.particles.pinned[i]) continue;
    scene.start.x.col(i) += random_vector(random, position);
    scene.start.v.col(i) += random_vector(random, velocity);
  }
}

}  // namespace

namespace {

Case accelerations_of(const Scene& scene) {
  Case c{.call = "accelerations", .in = scene.cloth(), .columns = 3, .row = "particle", .column = "acceleration"};
  crosscheck::System system(scene.model);
  Points a(3, scene.start.x.cols());
  State state = scene.start;
  system.acceleration(state, a);
  put(c.expected, a);
  c.tolerance = 1e-8;  // sums of a dozen terms of at most 1000 m/s^2 have a round-off of 1e-11
  return c;
}

}  // namespace

Cases accelerations(Random& random) {
  const int n = random.integer(3, 5);
  Scene scene = square(random, n, 0.1 * n, random_vector(random, 1), Vec3::UnitX(), Vec3::UnitZ(), {0, n - 1});
  shake(random, scene, 0.02, 1);
  return {accelerations_of(scene)};
}

Cases small_accelerations(Random& random) {
  return {accelerations_of(few(random, 1, {})), accelerations_of(few(random, 2, {})),
          accelerations_of(few(random, 2, {1})), accelerations_of(few(random, 3, {}))};
}

Cases small_cloth_step(Random& random) {
  // a particle far from the sphere; inside it; inside it on a spring; inside it with a pin inside; inside two spheres
  Cases cases;
  for (int kind = 0; kind < 5; ++kind) {
    Scene scene = few(random, kind == 2 || kind == 3 ? 2 : 1, kind == 3 ? std::vector<int>{1} : std::vector<int>{});
    scene.spheres.push_back({{0.1, kind == 0 ? -2 : -0.5, 0}, 0.5, 0.03, 0.5, 0.5, std::nullopt});
    if (kind == 4) scene.spheres.push_back({{-0.1, -0.5, 0}, 0.5, 0.03, 0.5, 0.5, std::nullopt});
    cases.push_back(scene.run("cloth_step", 0.01, 1, -1));
    cases.back().tolerance = 1e-9;  // same bound as in pins_and_spheres_of()
  }
  return cases;
}

Case pins_and_spheres_of(Random& random, int n) {
  // a cloth that falls on two overlapping spheres. One pin is inside a sphere and stays there. The middle particle is
  // 0.07 m inside both spheres, and still 0.02 m inside the second sphere after the first has pushed it out
  const Vec3 middle = random_vector(random, 1);
  Scene scene = square(random, n, 0.8, middle, Vec3::UnitX(), Vec3::UnitZ(), {0, 2 * n + 1});
  shake(random, scene, 0.01, 0.5);
  for (int i = 0; i < n * n; ++i)
    if (!scene.model.particles.pinned[i]) scene.start.v(1, i) -= 2;
  const double radius = random.uniform(0.4, 0.6);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 centre = middle + Vec3(side * 0.15, 0.08 - radius, random.uniform(-0.05, 0.05));
    scene.spheres.push_back({centre, radius, 0.03, random.uniform(0.3, 0.8), random.uniform(0.3, 0.7), std::nullopt});
  }
  Case c = scene.run("cloth_step", 0.005, 1, -1);
  c.tolerance = 1e-9;  // velocities of at most 10 m/s after one step have a round-off of 1e-14
  return c;
}

// the second cloth is smaller: a solution must not keep state between calls
Cases pins_and_spheres(Random& random) { return {pins_and_spheres_of(random, 5), pins_and_spheres_of(random, 4)}; }

Cases patch_on_a_slope(Random& random) {
  // a patch at rest on the side of a large sphere, observed at its middle particle
  Cases cases;
  for (const double factor : {1.4, 0.5}) {
    const double angle = random.uniform(15, 25) * std::numbers::pi / 180, turn = random.uniform(0, 6);
    const Vec3 n = Vec3(std::sin(angle) * std::cos(turn), std::cos(angle), std::sin(angle) * std::sin(turn));
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    const Sphere sphere{
        random_vector(random, 1), random.uniform(1.5, 2), 0.03, factor * std::tan(angle), 0, std::nullopt};
    const double r = sphere.contact_radius();
    Scene scene = square(random, 3, 0.2, sphere.centre + r * n, u, v, {});
    for (int i = 0; i < 9; ++i)
      scene.start.x.col(i) = sphere.centre + r * (scene.start.x.col(i) - sphere.centre).normalized();
    scene.spheres = {sphere};
    Case c = scene.run("cloth_path", 0.005, 100, 4);
    c.tolerance = 1e-9;  // each step has a round-off of 1e-15 m; friction and drag keep it from growing
    cases.push_back(c);
  }
  return cases;
}

Cases drape(Random& random) {
  const Sphere sphere{
      random_vector(random, 1), random.uniform(0.3, 0.4), 0.02, random.uniform(0.2, 0.5), 0, std::nullopt};
  const Vec3 top = sphere.centre + Vec3(0, sphere.contact_radius(), 0);
  const Vec3 middle = top + Vec3(random.uniform(-0.05, 0.05), 0.05, random.uniform(-0.05, 0.05));
  Scene scene = square(random, 6, 0.7, middle, Vec3::UnitX(), Vec3::UnitZ(), {});
  scene.spheres = {sphere};
  Case c = scene.run("cloth_path", 0.004, 120, 0);
  // the round-off is at most 2e-14 m on 20 seeds; crumpling may amplify it by 1e5 in half a second
  c.tolerance = 1e-6;
  return {c};
}

}  // namespace coursework::a4
