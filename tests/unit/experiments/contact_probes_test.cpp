
#include "experiments/contact/probes.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "reference/truth/exact/exact.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr auto sticky = "symplectic-euler+sticky";

TEST(TriangleDepth, NearestPointsByHand) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
  EXPECT_EQ(nearest_on_triangle({1, 1, 5}, a, b, c), Vec3(1, 1, 0));    // above the face
  EXPECT_EQ(nearest_on_triangle({2, -1, 2}, a, b, c), Vec3(2, 0, 0));   // next to an edge
  EXPECT_EQ(nearest_on_triangle({-1, -2, 2}, a, b, c), Vec3(0, 0, 0));  // beyond a corner
  EXPECT_EQ(nearest_on_triangle({9, -1, -2}, a, b, c), Vec3(4, 0, 0));
  EXPECT_NEAR((nearest_on_triangle({4, 3, 1}, a, b, c) - Vec3(2.56, 1.08, 0)).norm(), 0, 8 * eps);  // the long edge
  EXPECT_EQ(nearest_on_triangle({1, 5, 0}, a, b, b), Vec3(1, 0, 0));  // degenerate triangle without area
  EXPECT_EQ(nearest_on_triangle({1, 5, 0}, b, b, b), b);
}

TEST(TriangleDepth, NoPointOfTheTriangleIsNearer) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const Vec3 a = random.vector(), b = random.vector(), c = random.vector(), p = 2 * random.vector();
    const double found = (nearest_on_triangle(p, a, b, c) - p).norm();
    double best = INFINITY;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; i + j <= 60; ++j) best = std::min(best, (a + i / 60. * (b - a) + j / 60. * (c - a) - p).norm());
    EXPECT_LE(found, best + 8 * eps) << seed;
    EXPECT_GT(found, best - 2 * 3.5 / 60) << seed;  // width of the mesh, for sides up to 2 sqrt(3)
  }
}

TEST(TriangleDepth, CutsTheBallBetweenCornersThatLieOnIt) {
  Scene scene = small_scene(std::string("[grid]\nsize = [2, 2]\norigin = [0, 3, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\n"
                                        "mass = 1\n[grid.stiffness]\nstructural = 10\n[sphere]\n"
                                        "centre = [0, 0, 0]\nradius = 1.5\nmargin = 0.5\n") +
                            gravity_text);
  scene.triangles = {{0, 1, 2}};
  Points x = scene.start.x;
  x.col(0) = Vec3(2, 0, 0), x.col(1) = Vec3(0, 2, 0), x.col(2) = Vec3(0, 0, 2);
  EXPECT_NEAR(*depth_of_triangles(scene, 0, x), 2 - 2 / std::sqrt(3), 8 * eps);  // centre at 2 / sqrt(3)
  EXPECT_EQ(*clearance(scene, 0, x), 0);
  x.col(2) = Vec3(0, 0, 9);  // the nearest point is now near the edge between the other corners
  EXPECT_NEAR(*depth_of_triangles(scene, 0, x), 2 - 1 / std::sqrt(0.25 + 0.25 + 1. / 81), 8 * eps);
  x.col(0) = Vec3(2, 1, 0), x.col(1) = Vec3(2, -1, 0), x.col(2) = Vec3(9, 0, 0);
  EXPECT_NEAR(*depth_of_triangles(scene, 0, x), 0, 8 * eps);                  // touching edge
  EXPECT_NEAR(*depth_of_triangles(scene, 0, scene.start.x), 2 - 3, 8 * eps);  // outside: negative
  scene.triangles.clear();
  EXPECT_FALSE(depth_of_triangles(scene, 0, x));
}

TEST(SphereCone, EnginesStickAndSlideOnBothSidesOfTheLine) {
  Outcome out;
  for (const double degrees : {15., 35.}) {
    const double limit = std::tan(degrees * 0.017453292519943295);
    for (const auto name : {"symplectic-euler", "leapfrog", "rk4", "implicit-midpoint", "bullet/deformable-explicit",
                            "bullet/deformable-implicit"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, degrees));
      const Method method = find_method(name);
      EXPECT_EQ(cone(method, degrees, 1.05 * limit, Ground::ball, 1e-3, out)->state, ContactState::sticks);
      const auto below = cone(method, degrees, 0.95 * limit, Ground::ball, 1e-3, out);
      EXPECT_EQ(below->state, ContactState::slides);
      EXPECT_GT(below->distance, 0.01);
    }
    // detects two failures: the position-based world creeps, and the sticky sphere holds everything
    EXPECT_EQ(cone(find_method("bullet/pbd"), degrees, 0.5 * limit, Ground::ball, 1e-3, out)->state,
              ContactState::neither);
    EXPECT_EQ(cone(find_method(sticky), degrees, 0, Ground::ball, 1e-3, out)->state, ContactState::sticks);
  }
}

/// All methods of mysim that follow Coulomb's law, and those that also locate events.
std::vector<Method> coulomb_methods() {
  std::vector<Method> methods;
  for (const Method& m : builtin_methods()) {
    if (!m.family().is_subject() || !m.stepper || m.sticky_contact) continue;
    methods.push_back(m);
    if (!m.adaptive && locates_events(*m.stepper)) methods.push_back(find_method(m.name + "+events"));
  }
  return methods;
}

TEST(PlaneCone, HoldsAThousandthInsideAndSlidesAThousandthOutside) {
  std::vector<Method> methods = coulomb_methods();
  EXPECT_GT(methods.size(), 10u);
  for (const auto name : {"bullet/deformable-explicit", "bullet/deformable-implicit"})
    methods.push_back(find_method(name));
  Outcome out;
  for (const double degrees : {10., 50.})
    for (const Method& method : methods) {
      SCOPED_TRACE(fmt::format("{} {}", method.name, degrees));
      const double limit = std::tan(degrees * 0.017453292519943295);
      const auto held = cone(method, degrees, limit / 0.999, Ground::plane, 1e-3, out);
      ASSERT_TRUE(held) << out.reason;
      EXPECT_EQ(held->state, ContactState::sticks);
      EXPECT_EQ(held->coulomb, 0);
      // The bounds cover the rounding of h v in 500 steps, and the residual of implicit rules, which is 1e-10 of the
      // weight in each step. In Bullet's implicit world, a node that leaves the face falls freely for a step or two
      // (experiments/check/known.toml).
      const double free_step = 9.81 * 1e-3 * 1e-3;
      EXPECT_LT(held->distance, 1e-13 + (!method.implicit  ? 0
                                         : !method.stepper ? 2 * free_step
                                                           : 1e-10 * 9.81 * 0.25 / 1e-3));
      const auto slid = cone(method, degrees, limit / 1.001, Ground::plane, 1e-3, out);
      EXPECT_EQ(slid->state, ContactState::slides);
      const Scene scene = on_slope(degrees, limit / 1.001, Ground::plane);
      const auto exact = exact_solution(scene);
      ASSERT_TRUE(exact);
      EXPECT_NEAR((exact->at(0.5).x - scene.start.x).norm(), slid->coulomb, 1e-13);  // rounding of terms of 1 m
    }
  // detects two failures: the position-based world creeps, and the sticky rule holds everything
  EXPECT_EQ(cone(find_method("bullet/pbd"), 35, 0.35, Ground::plane, 1e-3, out)->state, ContactState::neither);
  EXPECT_EQ(cone(find_method(sticky), 35, 0, Ground::plane, 1e-3, out)->state, ContactState::sticks);
}

TEST(PlaneProbes, ClosedFormsHoldWithinTheOrderOfEachMethod) {
  for (const Method& method : coulomb_methods()) {
    const bool events = method.name.ends_with("+events");
    for (const double h : {1. / 240, 1e-3}) {
      SCOPED_TRACE(fmt::format("{} {}", method.name, h));
      Outcome out;
      const auto off = [&](PlaneProbe probe) {
        const auto value = measured(probe, method, h, out);
        EXPECT_TRUE(value) << out.reason;
        return std::abs(value.value_or(NAN) - by_theory(probe));
      };
      // An impact may add an excess of up to (1 + e) g h to the speed. At the later speed v = 1.24 m/s, three impacts
      // change the height by up to v / g times the sum of their excesses, plus the distance of one step. With events,
      // only sampling matters: the highest sample is up to g h^2 / 8 below the apex. Heights are relative to 0.3 m.
      EXPECT_LT(off(PlaneProbe::apex), events ? 9.81 * h * h / 8 / 0.3 + 1e-9 : (3 * 1.8 + 1) * 1.24 * h / 0.3);
      // each of the two impacts in 0.467 s lasts until the end of its step
      EXPECT_LT(off(PlaneProbe::period), events ? 1e-9 : 2 * h / (1.4 / 3) * (1 + 1e-9));
      EXPECT_LT(off(PlaneProbe::loss), 1e-12);  // rounding
      // Explicit Euler moves particles with the velocity before the fall, so that they touch one step later.
      EXPECT_EQ(off(PlaneProbe::held), method.name == "mysim/explicit-euler" ? 0.5 : 0);
    }
  }
}

TEST(PlaneProbes, AreThoseOfTheClosedForms) {
  const auto floor = exact_solution(drop_on_floor()), walls = exact_solution(between_walls());
  ASSERT_TRUE(floor && walls);
  const double fall = std::sqrt(2 * 0.3 / 9.81), e = 0.8, third = fall * (1 + 2 * e + 2 * e * e + e * e * e);
  EXPECT_NEAR(floor->at(third).x(1, 0) / 0.3, by_theory(PlaneProbe::apex), 32 * eps);
  EXPECT_NEAR(floor->at(third).v(1, 0), 0, 32 * eps);
  EXPECT_NEAR(walls->at(10 * 2 * 0.7 / 3).x(0, 0), 0.3, 64 * eps);  // ten times 1.4 m
  EXPECT_NEAR(walls->at(10 * 0.7 / 3 * 1.5).x(0, 0), 0.4, 64 * eps);
}

TEST(PlaneProbes, RefusalsAreVerdictsAndOtherProbesGoOn) {
  Outcome out;
  for (const auto name : {"bullet/pbd", "bullet/deformable-explicit"}) {
    EXPECT_FALSE(measured(PlaneProbe::apex, find_method(name), 1e-3, out));
    EXPECT_EQ(out.verdict, Verdict::unsupported);
    EXPECT_TRUE(contains(out.reason, "no restitution"));
    EXPECT_NEAR(measured(PlaneProbe::loss, find_method(name), 1e-3, out).value(), 0, 1e-3);
  }
  EXPECT_EQ(measured(PlaneProbe::apex, find_method(sticky), 1e-3, out), 0.) << "expected no rise";
  EXPECT_FALSE(measured(PlaneProbe::period, find_method(sticky), 1e-3, out));
}

TEST(ContactExperiment, AnswersToItsFormerName) {
  EXPECT_EQ(&find_experiment("sphere"), &find_experiment("contact"));
  EXPECT_EQ(find_experiment("sphere").name, "contact");
  EXPECT_EQ(experiment_named("ball"), nullptr);
  for (const Experiment& e : experiments()) EXPECT_NE(e.name, "sphere");
}

TEST(SphereRebound, ComesToTheSquareOfRestitution) {
  Outcome out;
  for (const auto name : {"symplectic-euler", "leapfrog", "rk4", "implicit-euler"})
    for (const double e : {0., 0.5, 0.9}) {
      SCOPED_TRACE(fmt::format("{} {}", name, e));
      const Scene scene = drop_on_ball(e);
      for (const double h : {1e-3, 1e-4}) {
        const auto height = rebound(find_method(name), scene, h, out);
        ASSERT_TRUE(height);
        // The impact at 2.4 m/s may occur anywhere within a step, and Euler lags by as much again.
        EXPECT_NEAR(*height, 0.3 * e * e, 2 * 2.43 * h) << h;
      }
    }
  EXPECT_EQ(*rebound(find_method(sticky), drop_on_ball(0.9), 1e-3, out), 0);
  EXPECT_FALSE(rebound(find_method("bullet/pbd"), drop_on_ball(0.5), 1e-3, out));
  EXPECT_EQ(out.verdict, Verdict::unsupported);
  EXPECT_TRUE(contains(out.reason, "no restitution"));
  // the position-based world rebounds even without restitution
  EXPECT_GT(*rebound(find_method("bullet/pbd"), drop_on_ball(0), 1. / 240, out), 1e-5);
}

TEST(SphereOrder, EveryProbeHasATruthAndEventsAreOfOrderTwoOnIt) {
  for (const Scene& scene : contact_order_probes()) {
    SCOPED_TRACE(scene.name);
    crosscheck::Run run = default_run(scene);
    const auto truth = truth_of(scene, run);
    ASSERT_TRUE(truth);
    EXPECT_FALSE(truth->under_contact_rule);
    const auto error = [&](const char* method, int steps) {
      run.step = run.duration / run.samples / steps;
      return largest_rms_distance(run_and_record(method, scene, run).trajectory, truth->trajectory);
    };
    if (scene.name == "bounces") {
      EXPECT_LT(error("leapfrog+events", 10), 1e-12);  // parabolas are exact up to the rounding of a hundred steps
    } else {
      EXPECT_NEAR(slope(error("leapfrog+events", 10), error("leapfrog+events", 40)) / 2, 2, 0.1);
      EXPECT_GT(error("leapfrog", 40), 10 * error("leapfrog+events", 40));
    }
  }
}

TEST(SphereLeaving, IsWhereEnergyAndFreeFlightSay) {
  // On the ball, v^2 = 2 g R (1 - cos). The particle leaves at cos = 2/3, and then falls freely until the gap is a
  // millimetre.
  const double r = 1.02, g = 9.81, c = 2. / 3, s = std::sqrt(1 - c * c), v = std::sqrt(g * r * c);
  double t = 0, x = 0, y = 0;
  while (std::hypot(x, y) < r + 1e-3) {
    t += 1e-6;
    x = r * s + v * c * t, y = r * c - v * s * t - g * t * t / 2;
  }
  const Leaving exact = leaving_by_theory();
  EXPECT_NEAR(exact.angle, std::atan2(x, y) * 57.29577951308232, 2e-4);  // 1e-6 s times 150 degrees per second
  EXPECT_NEAR(exact.speed, std::hypot(v * c, v * s + g * t), 2e-5);
  EXPECT_GT(exact.angle, 48.19);
  Outcome out;
  for (const auto name : {"leapfrog", "rk4", "bullet/deformable-explicit"}) {
    const auto found = leaving(find_method(name), 1e-3, out);
    ASSERT_TRUE(found) << name;
    // Near the exact angle, a step covers 0.15 degrees. After contact ends, the gap grows as the cube of the time. One
    // step more or less of contact therefore changes the angle by at most a degree.
    EXPECT_NEAR(found->angle, exact.angle, 1) << name;
    EXPECT_NEAR(found->speed, exact.speed, 0.02 * exact.speed) << name;
  }
  EXPECT_FALSE(leaving(find_method(sticky), 1e-3, out));
  EXPECT_EQ(out.verdict, Verdict::ok);
}

TEST(MirrorSymmetry, FindsPartnersAndMeasuresWhatIsMissing) {
  const Scene scene = drop_centred();
  const auto mirror = MirrorSymmetry::of(scene);
  ASSERT_TRUE(mirror);
  EXPECT_LT(mirror->asymmetry(scene.start.x), 4 * eps);
  Points x = scene.start.x;
  x(0, 5) += 1e-6;
  EXPECT_NEAR(mirror->asymmetry(x), 1e-6, 1e-15);
  x = scene.start.x;
  x.row(1) *= 3;  // remains symmetric
  EXPECT_LT(mirror->asymmetry(x), 4 * eps);
  EXPECT_FALSE(MirrorSymmetry::of(drop_aside()));
  EXPECT_FALSE(MirrorSymmetry::of(small_cloth()));
}

TEST(SphereDrape, ASymmetricClothStaysSymmetricUnlessLinksAreSwept) {
  const Scene scene = drop_centred();
  const auto mirror = MirrorSymmetry::of(scene);
  const crosscheck::Run run{2e-3, 0.6, 10};  // first touch at 0.18 s
  auto skew = [&](const char* method) {
    const Trajectory t = run_and_record(method, scene, run).trajectory;
    EXPECT_LT(*clearance(scene, t.t.back(), t.x.back()), 1e-3);
    return mirror->asymmetry(t.x.back());
  };
  // bounds on the rounding error, which is amplified at most ten-thousandfold
  EXPECT_LT(skew("leapfrog"), 1e-11);
  EXPECT_LT(skew("symplectic-euler"), 1e-11);
  EXPECT_GT(skew("xpbd"), 1e-5);
  EXPECT_GT(skew("bullet/pbd"), 1e-5);
}

}  // namespace
}  // namespace crosscheck
