// Contact with fixed and moving spheres: leaving angle, Coulomb's cone, restitution, no penetration, symmetry.

#include <numbers>

#include "mysim/run/observers.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double degree = std::numbers::pi / 180;

/// A particle at rest on a sphere of 1 m about the origin, `angle` (rad) from its top.
Scene on_sphere(double angle, const std::string& surface = "") {
  return small_scene(
      fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 1\n", std::sin(angle), std::cos(angle)) +
      "[sphere]\ncentre = [0, 0, 0]\nradius = 1\n" + surface + gravity_text);
}

/// Records the angle (rad) of the last contact, and the deepest penetration at the end of a step.
class Slide : public Observer {
 public:
  explicit Slide(const Scene& scene) : sphere_(scene.model.find<Spheres>()->list.at(0)) {}
  bool every_step() const override { return true; }
  Verdict observe(const State& s, bool) override {
    for (int i = 0; i < s.x.cols(); ++i)
      nearest = std::min(nearest, (s.x.col(i) - sphere_.centre).norm() / sphere_.contact_radius());
    if (touched_) angle = std::acos(s.x(1, 0) / s.x.col(0).norm());
    touched_ = false;
    return s.x.allFinite() ? Verdict::ok : Verdict::nan;
  }
  void contact(double) override {
    touched_ = true;
    ++contacts;
  }
  double angle = 0;    // rad
  double nearest = 1;  // distance to the centre, relative to the contact radius
  long contacts = 0;

 private:
  const Sphere& sphere_;
  bool touched_ = false;  // during the step that ends with the next observed state
};

double leaving_angle(const Stepper& s, double h) {
  const Scene scene = on_sphere(1 * degree);
  Slide slide(scene);
  simulate(s, ContactRule::coulomb, scene, {h, 1.6, 16}, slide);
  EXPECT_GT(slide.contacts, 0);
  return slide.angle;
}

// Energy: v^2 = 2 g R (cos theta0 - cos theta). The normal force vanishes where v^2 / R = g cos theta.
const double exact_leaving_angle = std::acos(2.0 / 3 * std::cos(1 * degree));

TEST(SinglePrecision, OnSpheresIsForRulesOfOneKickWithoutStickyAndOthersSaySo) {
  const Scene scene = small_scene(
      std::string("[grid]\nsize = [20, 20]\norigin = [-0.5, 1.1, -0.5]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 1\n"
                  "[grid.stiffness]\nstructural = 100\n[sphere]\ncentre = [0, 0, 0]\nradius = 1\n") +
      gravity_text);
  const auto remark = [&](const char* rule, ContactRule contact) {
    NullObserver nobody;
    return simulate(stepper(rule), contact, scene, {1e-3, 0.01, 1}, nobody, {ExecutionPath::single_precision}).remark;
  };
  EXPECT_EQ(remark("leapfrog", ContactRule::coulomb), "");
  EXPECT_EQ(remark("symplectic-euler", ContactRule::coulomb), "");
  for (const std::string& said : {remark("leapfrog", ContactRule::sticky), remark("suzuki4", ContactRule::coulomb)})
    EXPECT_TRUE(contains(
        said,
        "computed in double precision: single precision requires a regular cloth of 17 columns or more without "
        "bending, dashpots and aerodynamics; with contact, also symplectic-euler or leapfrog without +sticky"))
        << said;
}

TEST(Contact, FrictionlessParticleLeavesAtTheExactAngleInEveryStepper) {
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    // First-order rules let the particle leave too early or too late by about h g: 0.16 degrees, measured at 1e-5 s.
    EXPECT_NEAR(leaving_angle(s, 1e-5) / degree, exact_leaving_angle / degree, 0.5);
  }
}

TEST(Contact, SecondOrderRulesLeaveWithinATenthOfADegreeAtAMillisecond) {
  for (const Stepper& s : steppers()) {
    if (s.order < 2) continue;
    SCOPED_TRACE(s.name);
    // At the leaving speed of 2.6 m/s, a step is 0.15 degrees. The last contact falls within the last step before
    // leaving.
    EXPECT_NEAR(leaving_angle(s, 1e-3) / degree, exact_leaving_angle / degree, 0.1);
  }
}

TEST(Contact, HoldsBelowCoulombsLimitAndSlidesAboveInEveryStepper) {
  const double angle = 20 * degree;
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Scene held = on_sphere(angle, fmt::format("friction = {:.17g}\n", 1.05 * std::tan(angle)));
    const Trajectory still = trajectory_of(s, held, {1e-3, 10, 100});
    for (const Points& x : still.x) EXPECT_LT((x - held.start.x).norm(), 1e-9);  // required bound; measured: 0 m
    const Scene loose = on_sphere(angle, fmt::format("friction = {:.17g}\n", 0.95 * std::tan(angle)));
    const Trajectory slid = trajectory_of(s, loose, {1e-3, 10, 100});
    EXPECT_LT(slid.x.back()(1, 0), 0) << "the particle must have slid off";
  }
}

TEST(Contact, SlidesAtTheAccelerationThatCoulombLeaves) {
  // near the start the slope hardly changes: s = g (sin theta - mu cos theta) t^2 / 2
  const double angle = 30 * degree, mu = 0.3, t_end = 0.1;
  const double expected = 9.81 * (std::sin(angle) - mu * std::cos(angle)) * t_end * t_end / 2;
  const Scene scene = on_sphere(angle, "friction = 0.3\n");
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-4, t_end, 10});
    const double path = std::acos(t.x.back()(1, 0)) - angle;
    // Along the path the slope changes by path / R (1.2 %), and the normal force decreases as the particle gains speed
    // on the curved surface. Together they change the path by about path / R times 2 / tan(angle). The first-order
    // error in h is 0.4 %.
    EXPECT_NEAR(path / expected, 1, 0.05);
  }
}

/// A small cloth dropped on a sphere, off-centre so that it slides.
Scene dropped_cloth(double offset, const std::string& surface = "friction = 0.3\nmargin = 0.02\n") {
  return small_scene(
      fmt::format("[grid]\nsize = [9, 9]\norigin = [{}, 1.1, -0.5]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 1\n"
                  "[grid.stiffness]\nstructural = 100\nshear = 100\nbend = 100\n",
                  offset - 0.5) +
      "[drag]\ngamma = 2\n[sphere]\ncentre = [0.1, -0.05, 0]\nradius = 1\n" + surface + gravity_text);
}

TEST(Contact, NoParticleEndsAStepInsideNotEvenInABlowUp) {
  const Scene scene = dropped_cloth(0.1);  // close above the sphere, so that it touches before it blows up
  for (const Stepper& s : steppers())
    for (const double h : {1e-3, 5e-2}) {  // the larger one blows up in every stepper
      SCOPED_TRACE(fmt::format("{} h = {}", s.name, h));
      Slide slide(scene);
      simulate(s, ContactRule::coulomb, scene, {h, 1, 5}, slide);
      EXPECT_GT(slide.contacts, 0);
      EXPECT_GE(slide.nearest, 1 - 1e-13);  // projection and measurement each round the radius by some ulps
    }
}

TEST(Contact, ReboundsToTheSquareOfRestitutionTimesTheDrop) {
  const double drop = 0.2, speed = std::sqrt(2 * 9.81 * drop);
  for (const double e : {0.5, 0.9})
    for (const Stepper& s : steppers()) {
      Scene scene = on_sphere(0, fmt::format("restitution = {}\n", e));
      scene.start.x(1, 0) = 1 + drop;
      for (const double h : {1e-3, 1e-4}) {
        SCOPED_TRACE(fmt::format("{} e = {} h = {}", s.name, e, h));
        const Trajectory t = trajectory_of(s, scene, {h, 0.7, 700});
        double peak = 0;
        bool bounced = false;
        for (int i = 0; i < t.frames(); ++i) {
          bounced |= t.v[i](1, 0) > 0;
          if (bounced && t.x[i](1, 0) - 1 < peak - 1e-6) break;  // past the top of the first rebound
          if (bounced) peak = std::max(peak, t.x[i](1, 0) - 1);
        }
        // The step of the impact and the error of a first-order rule each change heights by the path of a step.
        // Sampling changes them by g (1 ms)^2.
        EXPECT_NEAR(peak, e * e * drop, 3 * speed * h + 1e-5);
      }
    }
}

TEST(Contact, OutcomeSaysThatRestitutionHopsAtRest) {
  const auto text = [](double restitution, const char* height) {
    return fmt::format(
        "[[particle]]\nposition = [0, {}, 0]\nmass = 1\n[sphere]\ncentre = [0, 0, 0]\nradius = 1\nfriction = 0.3\n"
        "restitution = {}\n{}",
        height, restitution, gravity_text);
  };
  for (const Stepper& s : fixed_steppers())
    for (const double restitution : {0.3, 0.7})
      for (const double h : {1e-2, 2.5e-3}) {
        SCOPED_TRACE(fmt::format("{} {} {}", s.name, restitution, h));
        const Scene scene = small_scene(text(restitution, "1.01"), 2, h);
        if (!takes(s, scene)) continue;
        Recorder path;
        const Outcome out = simulate(s, ContactRule::coulomb, scene, {h, 2, 200}, path);
        double hop = 0;  // m, in the last half second, long after the last bounce
        for (int i = 150; i <= 200; ++i)
          hop = std::max(hop, clearance_from(surfaces_of(scene.model), 0, path.trajectory.x[i].col(0)));
        // explicit Euler adds energy in each flight, so bounces of a centimetre continue
        if (s.name != "explicit-euler" && hop > 0.1 * 9.81 * out.step * out.step) {
          EXPECT_TRUE(contains(out.remark, "never quite at rest")) << hop;
        }
        NullObserver none;
        EXPECT_EQ(simulate(s, ContactRule::events, scene, {h, 2, 8}, none).remark, "");
      }
  for (const auto& silent : {text(0, "1.01"), text(0.7, "3")}) {  // no restitution; still falling
    NullObserver none;
    EXPECT_EQ(
        simulate(stepper("leapfrog"), ContactRule::coulomb, small_scene(silent, 0.3), {1e-3, 0.3, 3}, none).remark, "");
  }
}

TEST(Contact, StickyFreezesWhereCoulombSlides) {
  const Scene scene = on_sphere(20 * degree, "friction = 0.05\n");
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    Recorder sticky, coulomb;
    simulate(s, ContactRule::sticky, scene, {1e-3, 2, 20}, sticky);
    simulate(s, ContactRule::coulomb, scene, {1e-3, 2, 20}, coulomb);
    EXPECT_LT((sticky.trajectory.x.back() - scene.start.x).norm(), 1e-9);  // moved back to its position at the start
    EXPECT_GT((coulomb.trajectory.x.back() - scene.start.x).norm(), 0.5);
  }
}

TEST(Contact, SymmetricSceneStaysSymmetric) {
  Scene scene = dropped_cloth(0);
  for (Term& term : scene.model.terms)
    if (auto* spheres = std::get_if<Spheres>(&term)) spheres->list[0].centre = Vec3(0, -0.05, 0);
  const int n = 9;
  for (const Stepper& s : steppers()) {
    if (s.order == 1 && s.first_order) continue;  // explicit Euler is unstable here and amplifies rounding
    if (s.hard_constraints) continue;             // a Gauss-Seidel pass starts at one side and is not symmetric
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 0.3, 30});
    double worst = 0;
    for (const Points& x : t.x)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 here = x.col(i + n * j), mirrored_x = x.col(n - 1 - i + n * j),
                     mirrored_z = x.col(i + n * (n - 1 - j));
          worst = std::max(worst, (here - Vec3(-mirrored_x.x(), mirrored_x.y(), mirrored_x.z())).norm());
          worst = std::max(worst, (here - Vec3(mirrored_z.x(), mirrored_z.y(), -mirrored_z.z())).norm());
        }
    // The bound is the round-off of 300 steps (eps each, because sums are in different orders), which contact amplifies
    // tenfold. Implicit rules may leave up to 1e-10 of the force m v / (h/2) at 2 m/s, for 0.3 s.
    EXPECT_LT(worst, 10 * (300 * eps + (s.evaluations == 0 ? 1e-10 * 2 / 5e-4 * 0.3 * 0.3 / 2 : 0)));
  }
}

TEST(Contact, RuleOnOneParticle) {
  const Sphere sphere{{0, 0, 0}, 1, 0, 0.5, 0, std::nullopt};
  {  // a particle outside or on the surface does not change
    Vec3 x(0, 1, 0), v(1, -1, 0);
    EXPECT_EQ(resolve_contact(sphere, sphere.centre, x, x, v), 0);
    EXPECT_EQ(v, Vec3(1, -1, 0));
  }
  {  // the impulse equals the depth; a fast slider keeps speed 1 - 0.5 * 0.1
    Vec3 x(0, 0.9, 0), v(1, -0.1, 0);
    EXPECT_NEAR(resolve_contact(sphere, sphere.centre, {0, 1, 0}, x, v), 0.1, 2 * eps);  // rounded 1 - 0.9
    EXPECT_EQ(x, Vec3(0, 1, 0));
    EXPECT_NEAR(v.x(), 0.95, 4 * eps);
    EXPECT_NEAR(v.y(), 0, eps);
  }
  {  // friction stops a slow slider, both its position and its velocity
    Vec3 x(0.01, 0.95, 0), v(0.01, -1, 0);
    resolve_contact(sphere, sphere.centre, {0, 1, 0}, x, v);
    EXPECT_LT((x - Vec3(0, 1, 0)).norm(), 2e-4);  // curvature: d^2 / 2R = 5e-5 for the displacement d
    EXPECT_LT(std::abs(v.dot(Vec3(x.y(), -x.x(), 0))), 4 * eps);
  }
  {  // an outward velocity does not change
    Vec3 x(0, 0.99, 0), v(0.3, 0.2, 0);
    resolve_contact(sphere, sphere.centre, {0, 1, 0}, x, v);
    EXPECT_EQ(v, Vec3(0.3, 0.2, 0));
  }
  {  // a particle at the exact centre is pushed in an arbitrary direction, with finite values
    Vec3 x(0, 0, 0), v(0, -1, 0);
    EXPECT_EQ(resolve_contact(sphere, sphere.centre, {0, 0, 0}, x, v), 1);
    EXPECT_NEAR(x.norm(), 1, 2 * eps);
    EXPECT_TRUE(v.allFinite());
  }
}

TEST(Contact, NeverAddsEnergyOfMotion) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Sphere sphere{{0, 0, 0}, 1, 0.1, random.between(0, 2), random.between(0, 1), std::nullopt};
    const Vec3 x_n = 1.2 * random.vector().normalized(), v0 = 3 * random.vector();
    Vec3 x = random.vector() * 0.6, v = v0;
    resolve_contact(sphere, sphere.centre, x_n, x, v);
    EXPECT_LE(v.norm(), v0.norm() * (1 + 8 * eps));
    EXPECT_GE(x.norm(), 1.1 * (1 - 4 * eps));
    EXPECT_GE(v == v0 ? 0.0 : v.dot(x), -16 * eps);  // no longer inward
  }
}

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
  // Accelerations stay below 60 A / ramp^2 / 10 = 1 m/s^2, a tenth of g, well below what mu = 0.5 can hold.
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
    // Friction removes the whole tangential displacement of a step. The projection to the surface is of second order in
    // this displacement (h a h = 1e-6 m relative to the sphere), i.e. 1e-12 m per step. Explicit Euler drifts before it
    // kicks, so contact, and hence friction, acts in every other step only. In the other steps the particle slips by
    // h^2 a / 2: 1e-3 m in total.
    const bool drifts_first = s.first_order && s.order == 1;
    EXPECT_LT(furthest, drifts_first ? 1e-3 : 1e-8);
  }
}

TEST(MovingSphere, WithoutFrictionItIsLeftBehind) {
  const Scene scene = on_moving_sphere(0, {0.03, 0, 0.02}, 0.5);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    const Trajectory t = trajectory_of(s, scene, {1e-3, 1, 10});
    // The top of a sphere without friction does not hold the particle: it slides off by several times the sphere's
    // displacement.
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
      // The sphere accelerates by less than g: the particle leaves its surface for one step only, by g h^2.
      EXPECT_NEAR(t.x[i](1, 0), 1 + displacement(scene, t.t[i]).y(), 2 * 9.81 * 1e-6);
  }
}

TEST(MovingSphere, OnlyTheMotionRelativeToTheSphereCounts) {
  // Compares a slowly moving sphere with the same motion in the sphere's frame, where the particle feels minus the
  // sphere's acceleration.
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
    // minus the sphere's mean acceleration in this step
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
  // The slides differ by the discretisation of the sphere's motion in a step, h^2 a' h / 24. The unstable top amplifies
  // this by e^(sqrt(g/R) t) = e^3: 1e-8 m measured.
  EXPECT_LT(furthest, 1e-5 * path + 1e-7);
  EXPECT_GT(path, 0.01);
}

constexpr auto two_spheres =
    "[[sphere]]\ncentre = [-0.8, 0, 0]\nradius = 0.7\n[[sphere]]\ncentre = [0.8, 0.1, 0]\nradius = 0.6\n";

/// Records the largest penetration (m) at the end of a step, and which spheres were touched.
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
      EXPECT_LT(inside.deepest, 4 * eps * 2);  // projection and measurement each round 2 m by some ulps
    }
  }
}

TEST(SeveralSpheres, ALedgerClosesWithWhatMovingSpheresGave) {
  // Contact loss is the energy missing after contact: negative if a moving sphere pushes.
  const Scene scene = on_moving_sphere(0.5, {0, 0.03, 0}, 0.5);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    // In each resting step, gravity does work along the displacement by its own kick: m g (g h t / 2) over 1 s. The
    // sphere's motion contributes as much.
    EXPECT_LT(imbalance(s, scene, {1e-3, 1, 20}), 2 * 9.81 * 9.81 * 1e-3 / 2);
  }
}

}  // namespace
}  // namespace crosscheck
