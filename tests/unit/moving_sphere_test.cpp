// Moving spheres and several spheres: friction carries, nothing ends inside, motion counts only relative to the sphere.
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

const std::string ball_on_top = "[[particle]]\nposition = [0, 1, 0]\nmass = 1\n";

Scene on_moving_sphere(double friction, const Vec3& amplitude, double frequency) {
  return small_scene(ball_on_top +
                         fmt::format("[sphere]\ncentre = [0, 0, 0]\nradius = 1\n{}[sphere.motion]\n"
                                     "amplitude = [{}, {}, {}]\nfrequency = {}\nramp = 0.5\n",
                                     friction > 0 ? fmt::format("friction = {}\n", friction) : "", amplitude.x(),
                                     amplitude.y(), amplitude.z(), frequency) +
                         gravity_text,
                     2, 1e-3, 20);
}

Vec3 displacement(const Scene& scene, double t) {
  return displacement_at(*scene.model.find<Spheres>()->list.at(0).motion, t);
}

TEST(MovingSphere, CarriesWhatRestsOnItByFriction) {
  // accelerations stay below 60 A / ramp^2 / 10 = 1 m/s^2, a tenth of g: mu = 0.5 holds with room
  const Scene scene = on_moving_sphere(0.5, {0.03, 0, 0.02}, 0.5);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 2, 20});
    double furthest = 0, moved = 0;
    for (int i = 0; i < t.frames(); ++i) {
      const Vec3 relative = t.x[i].col(0) - displacement(scene, t.t[i]) - Vec3(0, 1, 0);
      furthest = std::max(furthest, relative.norm());
      moved = std::max(moved, (t.x[i].col(0) - Vec3(0, 1, 0)).norm());
    }
    EXPECT_GT(moved, 0.02);
    // friction takes all of the tangential displacement of a step; what is put on the surface again is second order in
    // it (h a h = 1e-6 m relative to the sphere): 1e-12 m a step. Explicit Euler drifts before it kicks, so that it is
    // pushed, and held, in every other step only; in between it slips by h^2 a / 2: 1e-3 m in all
    const bool drifts_first = s.first_order && s.order == 1;
    EXPECT_LT(furthest, drifts_first ? 1e-3 : 1e-8);
  }
}

TEST(MovingSphere, WithoutFrictionItIsLeftBehind) {
  const Scene scene = on_moving_sphere(0, {0.03, 0, 0.02}, 0.5);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 1, 10});
    // a smooth sphere cannot hold a ball on its top: it has slid off by several times what the sphere moved
    const Vec3 relative = t.x.back().col(0) - displacement(scene, t.t.back()) - Vec3(0, 1, 0);
    EXPECT_GT(std::hypot(relative.x(), relative.z()), 0.05);
  }
}

TEST(MovingSphere, RaisesWhatRestsOnIt) {
  const Scene scene = on_moving_sphere(0.5, {0, 0.03, 0}, 0.5);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 2, 20});
    for (int i = 0; i < t.frames(); ++i)
      // it never leaves the surface (accelerations below g) but for the flight of one step, g h^2
      EXPECT_NEAR(t.x[i](1, 0), 1 + displacement(scene, t.t[i]).y(), 2 * 9.81 * 1e-6);
  }
}

TEST(MovingSphere, OnlyTheMotionRelativeToTheSphereCounts) {
  // pushed aside slowly, and the same in the sphere's frame: there the ball feels minus the sphere's acceleration
  const Scene scene = on_moving_sphere(0.05, {0.05, 0, 0}, 0.5);
  const Motion motion = *scene.model.find<Spheres>()->list.at(0).motion;
  const double h = 1e-4;
  const Trajectory seen = trajectory_of(stepper("leapfrog"), scene, {h, 1, 1000});

  Sphere still = scene.model.find<Spheres>()->list.at(0);
  still.motion.reset();
  Scene frame = scene;
  frame.model.find<Spheres>()->list.at(0).motion.reset();
  State s = frame.start;
  double furthest = 0, path = 0;
  for (int n = 0; n < 10000; ++n) {
    // the sphere's acceleration in this step, as its velocity's change
    const Vec3 inertial = -(velocity_at(motion, (n + 1) * h) - velocity_at(motion, n * h)) / h;
    frame.model.find<Gravity>()->acceleration = Vec3(0, -9.81, 0) + inertial;
    System f(frame.model);
    Workspace w(s);
    const Points x_n = s.x;
    leapfrog(f, s, h, w);
    Vec3 x = s.x.col(0), v = s.v.col(0);
    resolve_contact(still, still.centre, x_n.col(0), x, v);
    s.x.col(0) = x, s.v.col(0) = v, s.t = (n + 1) * h;
    if ((n + 1) % 10 == 0) {
      const Vec3 relative = seen.x[(n + 1) / 10].col(0) - displacement_at(motion, s.t);
      furthest = std::max(furthest, (relative - x).norm());
      path = std::max(path, (relative - Vec3(0, 1, 0)).norm());
    }
  }
  // the drifts differ by the rounding of the sphere's motion in a step, h^2 a' h / 24, which the slope of the top makes
  // grow as e^(sqrt(g/R) t) = e^3: measured 1e-8 m
  EXPECT_LT(furthest, 1e-5 * path + 1e-7);
  EXPECT_GT(path, 0.01);
}

constexpr auto two_spheres =
    "[[sphere]]\ncentre = [-0.8, 0, 0]\nradius = 0.7\n[[sphere]]\ncentre = [0.8, 0.1, 0]\nradius = 0.6\n";

/// How deep a particle ever was inside a sphere at the end of a step, m, and which spheres were touched.
class Inside : public Observer {
 public:
  explicit Inside(const Scene& scene) : spheres_(*scene.model.find<Spheres>()), touched(spheres_.list.size()) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& s, bool) override {
    for (int i = 0; i < s.x.cols(); ++i)
      for (size_t k = 0; k < spheres_.list.size(); ++k) {
        const Sphere& sphere = spheres_.list[k];
        const double gap = (Vec3(s.x.col(i)) - sphere.centre_at(s.t)).norm() - sphere.contact_radius();
        deepest = std::max(deepest, -gap);
        if (std::abs(gap) < 1e-12) touched[k] = true;
      }
    return s.x.allFinite() ? Verdict::ok : Verdict::nan;
  }
  double deepest = 0;

 private:
  const Spheres& spheres_;

 public:
  std::vector<bool> touched;
};

TEST(SeveralSpheres, EachActsAndNothingEndsInside) {
  for (const bool moving : {false, true}) {
    const std::string motion = moving ? "[sphere.motion]\namplitude = [0, 0.2, 0.1]\nfrequency = 1\nramp = 0.2\n" : "";
    const Scene scene = small_scene(std::string("[grid]\nsize = [9, 9]\norigin = [-1, 0.9, -0.5]\nu = [2, 0, 0]\n"
                                                "v = [0, 0, 1]\nmass = 1\n[grid.stiffness]\nstructural = 100\n"
                                                "shear = 100\nbend = 100\n[drag]\ngamma = 2\n") +
                                    two_spheres + motion + gravity_text);
    for (const Stepper& s : steppers()) {
      SCOPED_TRACE(fmt::format("{} {}", s.name, moving));
      Inside inside(scene);
      simulate(s, ContactRule::coulomb, scene, {1e-3, 1, 5}, inside);
      EXPECT_TRUE(inside.touched[0] && inside.touched[1]);
      EXPECT_LT(inside.deepest, 4 * eps * 2);  // put on the surface and measured again: some ulps of 2 m
    }
  }
}

TEST(SeveralSpheres, ALedgerClosesWithWhatMovingSpheresGave) {
  // the loss of contact is what is not there after it: negative where a moving sphere pushes
  const Scene scene = on_moving_sphere(0.5, {0, 0.03, 0}, 0.5);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    // the kick of each resting step works along its own path, over 1 s: m g (g h t / 2), and as much for the sphere's
    EXPECT_LT(imbalance(s, scene, {1e-3, 1, 20}), 2 * 9.81 * 9.81 * 1e-3 / 2);
  }
}

}  // namespace
}  // namespace crosscheck
