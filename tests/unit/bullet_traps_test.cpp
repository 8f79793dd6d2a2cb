// Bullet's traps, each seen failing where it is left open and holding where it is closed; and runs in which nothing
// moves.
#include "experiments/metrics.h"
#include "experiments/scenes.h"
#include "mysim/energy.h"
#include "mysim/observers/watch.h"
#include "reference/certificate.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

Scene trap(const std::string& name) {
  return load_scene(CROSSCHECK_SOURCE "/experiments/scenes/disagreements/" + name + ".toml");
}
Answered play(const std::string& method, const Scene& scene) { return answer(method, scene, default_run(scene)); }

TEST(BulletTraps, ImplicitWorldFreezesWithoutProjectionAndMovesWithIt) {
  for (const Scene& scene : {trap("implicit-freeze"), load_scene("chain"), load_scene("cloth-student")}) {
    const crosscheck::Run run{scene.step, 0.5, 10};
    const Answered frozen = answer("bullet/deformable-implicit+unprojected", scene, run),
                   moving = answer("bullet/deformable-implicit", scene, run);
    EXPECT_EQ(frozen.outcome.verdict, Verdict::frozen) << scene.name;
    EXPECT_EQ(moving.outcome.verdict, Verdict::ok) << moving.outcome.reason;
    EXPECT_EQ(motion_of(frozen.trajectory), 0);
    EXPECT_GT(motion_of(moving.trajectory), 0.05);
  }
}

TEST(BulletTraps, ShippedImplicitForceBlowsUpWhereSpringsArePushed) {
  const Scene scene = trap("indefinite-hessian");
  const Answered shipped = play("bullet/deformable-implicit+shipped", scene),
                 clamped = play("bullet/deformable-implicit", scene);
  // it clamps speeds: what blows up is seen by its length before it is seen by its energy
  EXPECT_TRUE(shipped.outcome.verdict == Verdict::energy || shipped.outcome.verdict == Verdict::stretch)
      << shipped.outcome.reason;
  EXPECT_EQ(clamped.outcome.verdict, Verdict::ok);
  // where springs are pulled only, it is the same force
  Scene pulled = load_scene("spring");
  pulled.start.x(1, 1) = -1.15;
  EXPECT_LE(sup_distance(play("bullet/deformable-implicit+shipped", pulled).trajectory,
                         play("bullet/deformable-implicit", pulled).trajectory),
            1e-7);  // both solve to eight digits
}

TEST(BulletTraps, SpeedLimitActsOnlyWithTheDefaultMargin) {
  const Scene scene = trap("speed-clamp");
  const Answered open = play("bullet/deformable-explicit+default-margin", scene),
                 closed = play("bullet/deformable-explicit", scene), ours = play("symplectic-euler", scene);
  // a lone particle's box is a cube of twice the margin: its diagonal in a step, here below the 80 m/s asked
  const double limit = 2 * 0.25 * std::sqrt(3) / scene.step;
  for (size_t i = 1; i < open.trajectory.v.size(); ++i)
    EXPECT_LE(open.trajectory.v[i].col(0).norm(), limit * (1 + 1e-12));
  EXPECT_NEAR(open.trajectory.v.back().col(0).norm(), limit, 0.01 * limit);
  bool said = false;
  for (const std::string& law : open.outcome.different_law) said |= law.starts_with("speeds: ");
  EXPECT_TRUE(said);
  EXPECT_TRUE(closed.outcome.different_law.empty());
  EXPECT_LE(sup_distance(ours.trajectory, closed.trajectory), 1e-12);
}

TEST(BulletTraps, OwnWindDoesNotBeginOnAClothAtRest) {
  const Scene scene = trap("wind-at-rest");
  const Trajectory own = play("bullet/pbd+own-wind", scene).trajectory, added = play("bullet/pbd", scene).trajectory;
  double fastest = 0;
  for (int i = 0; i < own.frames() && own.t[i] <= 0.3; ++i) fastest = std::max(fastest, largest_column(own.v[i]));
  EXPECT_LT(fastest, 1e-6);
  // 13.5 m/s^2 at first, half of it at 0.9 m/s of 3
  EXPECT_GT(largest_column(added.v[added.frames() / 4]), 1);
}

TEST(BulletTraps, RestLengthsAreOverwrittenUnlessTheFlagIsCleared) {
  const Scene scene = trap("rest-lengths");
  for (const std::string world : {"bullet/deformable-explicit", "bullet/pbd"}) {
    const Outcome open = play(world + "+default-rest", scene).outcome, closed = play(world, scene).outcome;
    EXPECT_NEAR(open.readback->links[0].rest, 0.9, 1e-12) << world;  // what it found
    EXPECT_EQ(closed.readback->links[0].rest, 1.0) << world;
    EXPECT_TRUE(certify(world, scene, open).mismatch());
    EXPECT_FALSE(certify(world, scene, closed).mismatch());
  }
}

TEST(BulletTraps, DistanceFieldIsWrongByTheSquareOfItsVoxel) {
  const Scene scene = trap("distance-field");
  const double radius = scene.model.find<Spheres>()->list[0].radius;
  auto gap = [&](const std::string& method) {
    const Trajectory path = play(method, scene).trajectory;
    return std::abs(*clearance(scene, path.t.back(), path.x.back()));
  };
  const double coarse = gap("bullet/pbd+default-voxel"), fine = gap("bullet/pbd");
  fmt::print("distance field: {:.3g} m with 0.25 m, {:.3g} m with 0.02 m\n", coarse, fine);
  // between two nodes a distance is interpolated: off by a^2 / 8R along one axis, twice that across a cell
  EXPECT_LE(coarse, 0.25 * 0.25 / (4 * radius));
  EXPECT_LE(fine, 0.02 * 0.02 / (4 * radius));
  EXPECT_GT(coarse, 1e-3);
  EXPECT_GT(coarse, 10 * fine);
}

TEST(BulletTraps, SlowBodiesStayAwake) {
  // 1e-3 m at 10 rad/s: at most 0.01 m/s, and Bullet puts to sleep what is slower than 0.04 m/s for 2 s
  Scene scene = load_scene("spring");
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Gravity>(t); });
  scene.start.x(1, 1) = -1 - 1e-3;
  for (const auto& [method, kept] : {std::pair{"bullet/deformable-explicit", 1.},
                                     // backward Euler takes exp(-omega^2 h t / 2) off
                                     {"bullet/deformable-implicit", std::exp(-0.05 * 4.5)},
                                     {"bullet/pbd", std::exp(-0.05 * 4.5)}}) {
    const Answered a = play(method, scene);
    EXPECT_FALSE(a.outcome.readback->may_sleep.value());
    double low = 1e300, high = -1e300;
    for (int i = 0; i < a.trajectory.frames(); ++i)
      if (a.trajectory.t[i] > 4) {
        low = std::min(low, a.trajectory.x[i](1, 1));
        high = std::max(high, a.trajectory.x[i](1, 1));
      }
    EXPECT_NEAR((high - low) / 2, 1e-3 * kept, 3e-5) << method;
  }
  // left to itself it stops after two seconds, wherever it is
  const Answered asleep = play("bullet/deformable-explicit+default-sleep", scene);
  EXPECT_TRUE(asleep.outcome.readback->may_sleep.value());
  for (int i = 1; i < asleep.trajectory.frames(); ++i)
    if (const double t = asleep.trajectory.t[i]; t < 1.5 || t > 2.5) {
      EXPECT_EQ(asleep.trajectory.x[i] == asleep.trajectory.x[i - 1], t > 2.5) << t;
    }
}

TEST(Frozen, IsWhatGetsForcesAndDoesNotMove) {
  const Scene scene = load_scene("chain");
  Watch watch(scene.model);
  State state = scene.start;
  EXPECT_EQ(watch.observe(state, true), Verdict::ok);
  state.t = 0.01;
  EXPECT_EQ(watch.observe(state, true), Verdict::frozen);
  // one bit of motion, or of speed, is motion
  for (const bool speed : {false, true}) {
    Watch other(scene.model);
    other.observe(scene.start, true);
    State moved = state;
    (speed ? moved.v : moved.x)(1, 2) = -1e-12;
    EXPECT_EQ(other.observe(moved, true), Verdict::ok);
  }
}

TEST(Frozen, IsNotWhatIsAtRestByItself) {
  const std::string two =
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.5, 0, 0]\nmass = 1\n";
  const std::string at_rest = two + "[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 0.5\n";
  Scene held = trap("pbd-friction");
  held.model.find<Spheres>()->list[0].friction = 0.7;
  const struct {
    const char* what;
    Scene scene;
  } still[] = {{"a spring at its rest length", small_scene(at_rest)},
               {"without any force", small_scene(two)},
               {"held by friction", held},
               {"lying on a ball", trap("distance-field")}};
  for (const auto& s : still)
    for (const auto method : {"leapfrog", "symplectic-euler", "bullet/deformable-explicit"}) {
      const Answered a = answer(method, s.scene, {1e-3, 0.02, 2});
      EXPECT_EQ(a.outcome.verdict, Verdict::ok) << s.what << ", " << method << ": " << a.outcome.reason;
      EXPECT_LT(motion_of(a.trajectory), 1e-5) << s.what << ", " << method;
    }
  // explicit Euler moves nothing in its first step from rest, but it gives speed
  const Answered first = answer("explicit-euler", load_scene("chain"), {1e-3, 1e-3, 1});
  EXPECT_EQ(first.trajectory.x[1], first.trajectory.x[0]);
  EXPECT_GT(largest_column(first.trajectory.v[1]), 0);
  EXPECT_EQ(first.outcome.verdict, Verdict::ok);
}

}  // namespace
}  // namespace crosscheck
