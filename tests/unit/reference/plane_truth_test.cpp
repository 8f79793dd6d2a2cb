// Planes: closed forms satisfy their own laws; the event-driven route and located events agree with closed forms; and
// Bullet's worlds, the certificate and the protocol handle planes.

#include <Eigen/Geometry>
#include <functional>
#include <numbers>

#include "reference/certificate/certificate.h"
#include "reference/protocol/scene_json.h"
#include "reference/truth/exact/exact.h"
#include "reference/truth/independent/integrators.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double g = 9.81, degree = std::numbers::pi / 180;

std::string list(const Vec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); }

std::string plane_text(const Vec3& point, const Vec3& normal, const std::string& more = "") {
  return "[[plane]]\npoint = " + list(point) + "\nnormal = " + list(normal) + "\n" + more + "\n";
}
Scene particle(const Vec3& x, const Vec3& v, const std::string& more, double duration = 1) {
  return small_scene("[[particle]]\nposition = " + list(x) + "\nmass = 2\nvelocity = " + list(v) + "\n" + more,
                     duration, 1e-3, 50);
}

/// A particle over or on a slope that rises towards +x.
Scene slope(double angle, double friction, double restitution, double height, double up, double duration = 1) {
  const Vec3 n(-std::sin(angle), std::cos(angle), 0), along(std::cos(angle), std::sin(angle), 0);
  return particle(
      height * n, up * along,
      plane_text(Vec3::Zero(), n, fmt::format("friction = {}\nrestitution = {}", friction, restitution)) + gravity_text,
      duration);
}

Scene room(double restitution, const Vec3& v, const std::string& gravity = gravity_text) {
  const std::string e = fmt::format("restitution = {}", restitution);
  std::string text;
  for (int k = 0; k < 3; ++k)
    text += plane_text(Vec3::Zero(), Vec3::Unit(k), e) + plane_text(Vec3(2, 1.5, 1), -Vec3::Unit(k), e);
  return particle({0.5, 0.4, 0.3}, v, text + gravity, 2);
}

Scene corner(int planes, const std::string& surface = "") {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.7, Vec3::UnitZ())).toRotationMatrix();
  std::string text;
  for (int i = 0; i < planes; ++i) text += plane_text(Vec3(1, 2, 3), turn.col(i), surface);
  const Vec3 inside = Vec3(1, 2, 3) + turn * Vec3(0.1, 0.2, 0.3), a = turn * Vec3(-2, -3, -4);
  return particle(inside, turn * Vec3(0, 0.5, -0.2), text + "[gravity]\nacceleration = " + list(a) + "\n");
}

TEST(BetweenPlanes, SlopeHoldsAThousandthBelowTheLimitAndSlidesAThousandthAbove) {
  for (const double angle : {5 * degree, 40 * degree}) {
    const auto held = exact_solution(slope(angle, std::tan(angle) / 0.999, 0, 0, 0));
    ASSERT_TRUE(held);
    EXPECT_LT(held->at(0.7).x.norm(), eps);
    const double mu = std::tan(angle) / 1.001;
    const auto slid = exact_solution(slope(angle, mu, 0, 0, 0));
    ASSERT_TRUE(slid);
    const double way = g * (std::sin(angle) - mu * std::cos(angle)) * 0.7 * 0.7 / 2;
    EXPECT_NEAR(slid->at(0.7).x.norm(), way, 4 * eps);  // some roundings of g t^2 / 2
    EXPECT_LT(slid->at(0.7).x(0, 0), 0);
  }
}

TEST(BetweenPlanes, PushedUpASlopeItTurnsAndComesBackAsCoulombSays) {
  const double angle = 20 * degree, mu = 0.3, v = 2;
  const auto exact = exact_solution(shipped_scene("slope-slide"));
  ASSERT_TRUE(exact);
  const double down = g * (std::sin(angle) + mu * std::cos(angle)), back = g * (std::sin(angle) - mu * std::cos(angle)),
               turn = v / down;
  const Vec3 along(std::cos(angle), std::sin(angle), 0);
  EXPECT_NEAR(exact->at(turn).x.col(0).dot(along), v * v / (2 * down), 8 * eps);
  EXPECT_NEAR(exact->at(turn + 1).x.col(0).dot(along), v * v / (2 * down) - back / 2, 16 * eps);
  EXPECT_NEAR(exact->at(turn + 1).v.col(0).dot(along), -back, 16 * eps);
}

TEST(BetweenPlanes, ApicesAndPeriodsAreThoseOfABall) {
  for (const double e : {0.5, 0.9, 1.}) {
    const auto exact = exact_solution(slope(0, 0, e, 0.3, 0, 2));
    ASSERT_TRUE(exact);
    const double fall = std::sqrt(2 * 0.3 / g);
    double t = fall;
    for (int n = 1; n < 5; ++n) {
      EXPECT_NEAR(exact->at(t + fall * std::pow(e, n)).x(1, 0), 0.3 * std::pow(e, 2 * n), 16 * eps) << e;
      t += 2 * fall * std::pow(e, n);
    }
  }
  const auto exact = exact_solution(room(1, {3, 0, 0}, ""));
  ASSERT_TRUE(exact);
  const double period = 2 * 2 / 3.;
  for (const double t : {0.1, 0.5}) {
    const State first = exact->at(t), later = exact->at(t + 7 * period);
    EXPECT_NEAR(first.x(0, 0), later.x(0, 0), 64 * eps);
    EXPECT_EQ(first.v, later.v);
  }
}

TEST(BetweenPlanes, FrictionAtImpactsAndEndlessBouncesFollowsCoulomb) {
  // Each impact at speed u e^k removes mu (1 + e) u e^k of the tangential speed. After the bounces, the particle slides
  // to a stop.
  const double e = 0.5, mu = 0.1, u = std::sqrt(2 * g * 0.2), fall = u / g, end = fall * (1 + e) / (1 - e);
  const Scene scene = slope(0, mu, e, 0.2, 2, 3);
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->at(fall * (1 + 1e-6)).v(0, 0), 2 - mu * (1 + e) * u, 8 * eps);
  const double lying = 2 - mu * (1 + e) * u / (1 - e);
  EXPECT_NEAR(exact->at(end + 0.1).v(0, 0), lying - mu * g * 0.1, 1e-14);
  EXPECT_EQ(exact->at(end + lying / (mu * g) + 0.01).v(0, 0), 0);
}

TEST(BetweenPlanes, OtherScenesAreRefused) {
  const std::string floor = plane_text(Vec3::Zero(), Vec3::UnitY()), rough = "friction = 0.1";
  const std::string slanted = plane_text(Vec3::Zero(), Vec3(1, 1, 0).normalized());
  EXPECT_TRUE(exact_solution(particle({0, 1, 0}, {0, 0, 0}, floor + gravity_text)));
  for (const std::string& more : {floor + slanted + gravity_text, floor + gravity_text + "[drag]\ngamma = 1\n",
                                  plane_text(Vec3::Zero(), Vec3::UnitY(), rough) +
                                      plane_text(Vec3(-9, 0, 0), Vec3::UnitX(), rough) + gravity_text,
                                  // across the fall line of a rough slope: a curve without a closed form
                                  plane_text(Vec3::Zero(), Vec3(-0.6, 0.8, 0), rough) + gravity_text})
    EXPECT_FALSE(exact_solution(particle({0.01, 1, 0}, {0, 0, 1}, more))) << more;
}

std::vector<std::pair<std::string, Scene>> closed_scenes() {
  return {{"held", slope(0.3, 0.4, 0, 0, 0)},
          {"slides", slope(0.3, 0.1, 0, 0, 0)},
          {"turns", slope(0.3, 0.2, 0, 0, 1.5)},
          {"stops", slope(0.3, 0.5, 0, 0, -0.5)},
          {"bounces aside", slope(0, 0.1, 0.6, 0.2, 1)},
          {"bounces down a slope", slope(0.4, 0.05, 0.7, 0.2, -0.3)},
          {"room", room(0.9, {3, 5, 2})},
          {"elastic room", room(1, {3, 1, 2}, "")},
          {"corner of two", corner(2)},
          {"corner of three", corner(3)},
          {"corner of three that returns a part", corner(3, "restitution = 0.4")},
          {"belt",
           particle({0, 0, 0}, {0, 0, 0},
                    plane_text(Vec3::Zero(), Vec3::UnitY(), "friction = 0.3\nvelocity = [0.5, 0, 0]") + gravity_text)},
          {"lift", particle({0, 0.1, 0}, {0.2, 0, 0},
                            plane_text(Vec3::Zero(), Vec3::UnitY(), "restitution = 0.5\nvelocity = [0, 0.4, 0]") +
                                gravity_text)}};
}

TEST(EventDriven, OnPlanesIsWhatClosedFormsSay) {
  for (const auto& [name, scene] : closed_scenes()) {
    SCOPED_TRACE(name);
    const auto exact = exact_solution(scene);
    ASSERT_TRUE(exact);
    Recorder r;
    try {
      run_event_driven(scene, {1e-3, scene.duration, 50, 1e-12}, r);
    } catch (const Unsupported& e) {
      EXPECT_TRUE(name.starts_with("corner")) << e.what();  // the route supports only rest between several surfaces
    }
    EXPECT_GT(r.trajectory.frames(), name.starts_with("corner") ? 0 : 50);
    for (int i = 0; i < r.trajectory.frames(); ++i)
      // each of a thousand steps may err by the tolerance, 1e-12 of some metres
      EXPECT_LT((r.trajectory.x[i] - exact->at(r.trajectory.t[i]).x).norm(), 1e-9) << i;
  }
}

TEST(ContactEvents, OnFixedPlanesUnderConstantForcesMakesRoundingsOnly) {
  for (const auto& [name, scene] : closed_scenes())
    for (const char* rule : {"leapfrog", "implicit-midpoint"})
      for (const double h : {1e-2, 3e-3}) {
        SCOPED_TRACE(fmt::format("{} {} {}", name, rule, h));
        const auto exact = exact_solution(scene);
        ASSERT_TRUE(exact);
        Recorder r;
        simulate(stepper(rule), ContactRule::events, scene, {h, scene.duration, 50}, r);
        double worst = 0;
        for (int i = 0; i < r.trajectory.frames(); ++i)
          worst = std::max(worst, (r.trajectory.x[i] - exact->at(r.trajectory.t[i]).x).norm());
        // Rebounds within a step are ignored. For e = 0.5 to 0.9 this neglects a height of g h^2 / 8 and the friction
        // of these rebounds. Implicit rules may leave 1e-10 of the force m v / h.
        const bool ends_in_rest = contains(name, "bounces") || contains(name, "returns") || name == "lift";
        EXPECT_LT(worst, 1e-11 + (ends_in_rest ? g * h * h : 0) + (std::string(rule) == "leapfrog" ? 0 : 1e-6));
      }
}

TEST(ContactEvents, OnFixedPlanesIsOfOrderTwo) {
  // a spring across the slope, and drag: forces that vary
  const Vec3 n(-0.6, 0.8, 0), along(0.8, 0.6, 0);
  const auto scene_of = [&](double friction, double restitution, double height) {
    return small_scene(
        "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = " +
            list(0.5 * along + height * n + Vec3(0, 0, 0.3)) + "\nmass = 1\nvelocity = [0, 0, 1]\n" +
            "[[spring]]\nends = [0, 1]\nstiffness = 30\nrest = 0.4\n[pins]\nparticles = [0]\n" +
            "[drag]\ngamma = 0.5\n" +
            plane_text(Vec3::Zero(), n, fmt::format("friction = {}\nrestitution = {}", friction, restitution)) +
            gravity_text,
        1);
  };
  for (const auto& [friction, restitution, height] : {std::tuple{0., 0., 0.}, {0.1, 0., 0.}, {0.1, 0.7, 0.3}}) {
    const Scene scene = scene_of(friction, restitution, height);
    Recorder truth;
    run_event_driven(scene, {1e-3, 1, 20, 1e-13}, truth);
    ASSERT_EQ(truth.trajectory.frames(), 21);
    for (const char* rule : {"leapfrog", "implicit-midpoint"}) {
      SCOPED_TRACE(fmt::format("{} {} {}", rule, friction, restitution));
      // Uses the trend over four halvings, because events fall anywhere in a step, which scatters single orders.
      const auto error = [&](double h) {
        Recorder r;
        simulate(stepper(rule), ContactRule::events, scene, {h, 1, 20, 1e-10}, r);
        return sup_rms(r.trajectory, truth.trajectory);
      };
      const double order = std::log2(error(5e-3) / error(5e-3 / 16)) / 4;
      EXPECT_GT(order, 1.85);
      EXPECT_LT(order, 2.15);
    }
  }
}

TEST(Truth, OfARoughCornerEndsWhereItIsReachedOrIsMarkedAsAContactModel) {
  const std::string rough = "friction = 0.2";
  const Scene scene = particle({0.1, 0.1, 0}, {0, 0, 1},
                               plane_text(Vec3::Zero(), Vec3(1, 1, 0).normalized(), rough) +
                                   plane_text(Vec3::Zero(), Vec3(-0.5, 1, 0).normalized(), rough) + gravity_text);
  const auto truth = truth_of(scene, default_run(scene));
  ASSERT_TRUE(truth);
  // The particle slides into the corner at 0.27 s, then alternates between the slopes until it rests there, before 0.5
  // s.
  EXPECT_TRUE(truth->under_contact_rule || truth->until < 0.5);
  const auto closed = truth_of(corner(3), default_run(corner(3)));
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->tier, Tier::exact);
}

std::string mismatches(const Certificate& certificate) {
  std::string all;
  for (const CertificateRow& row : certificate.rows)
    if (row.parity == Parity::mismatch)
      all += fmt::format("{}: asked {}, read back {}\n", row.quantity, row.requested, row.read_back);
  return all;
}

TEST(BulletOnPlanes, HoldsAndSlidesAtCoulombsAngleAndDiffersFromOursByRoundings) {
  // slopes to either side and a floor, away from the origin
  for (const double angle : {0., 25 * degree, -50 * degree}) {
    const Vec3 n(-std::sin(angle), std::cos(angle), 0), point(3, -2, 1), along(std::cos(angle), std::sin(angle), 0);
    const auto scene_of = [&](double friction, double speed) {
      const std::string plane = plane_text(point, n, fmt::format("friction = {:.17g}\nmargin = 0.02", friction));
      return particle(point + 0.02 * n, speed * along, plane + gravity_text);
    };
    const double limit = std::abs(std::tan(angle));
    for (const bool holds : {true, false}) {
      SCOPED_TRACE(fmt::format("{} {}", angle, holds));
      const Scene scene = scene_of(holds ? 1.05 * limit + 0.1 : 0.95 * limit, angle == 0 ? 1 : 0);
      const MethodRun bullet = run_and_record("bullet/deformable-explicit", scene, default_run(scene)),
                      ours = run_and_record("symplectic-euler", scene, default_run(scene));
      ASSERT_EQ(bullet.outcome.verdict, Verdict::ok) << bullet.outcome.reason;
      const double apart = sup_rms(bullet.trajectory, ours.trajectory);
      std::printf("slope of %.0f degrees, %s: Bullet differs by %.2g m\n", angle / degree, holds ? "held" : "sliding",
                  apart);
      EXPECT_LT(apart, 2e-3);
      EXPECT_EQ(mismatches(certify("bullet/deformable-explicit", scene, bullet.outcome)), "");
    }
  }
}

TEST(BulletOnPlanes, HoldsWhatSlidesFarOverAFaceThatIsNearlyAlongAnAxis) {
  // If Bullet ignored the rotation, the face of the unrotated cube would end next to the particle.
  for (const Vec3& direction : {Vec3(0.09, -0.98, 0.2), Vec3(0.03, -1, 0.02), Vec3(0.1, 0.1, 0.99)}) {
    const Vec3 n = direction.normalized();
    int axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    const Vec3 e = n[axis] < 0 ? Vec3(-Vec3::Unit(axis)) : Vec3(Vec3::Unit(axis)),
               along = (e - e.dot(n) * n).normalized();
    const Scene scene = particle(0.02 * n, Vec3::Zero(),
                                 plane_text(Vec3::Zero(), n, "margin = 0.02\nfriction = 0.2") +
                                     "[gravity]\nacceleration = " + list(9.81 * (0.6 * along - 0.8 * n)) + "\n");
    for (const char* method : {"bullet/deformable-explicit", "bullet/deformable-implicit"}) {
      SCOPED_TRACE(fmt::format("{} {}", method, list(n)));
      const MethodRun run = run_and_record(method, scene, default_run(scene));
      ASSERT_EQ(run.outcome.verdict, Verdict::ok) << run.outcome.reason;
      // Rounding may delay contact of a node on the face by one step, in which the node falls by at most g h^2.
      for (const Points& x : run.trajectory.x) EXPECT_GT(x.col(0).dot(n), 0.02 - g * 1e-6);
      EXPECT_GT(run.trajectory.x.back().col(0).dot(along), 2);
    }
  }
}

TEST(BulletOnPlanes, RefusesRestitutionAndSeveralMargins) {
  const auto refusal = [](const std::string& more) -> std::string {
    const Scene scene = particle({0, 1, 0}, {0, 0, 0}, more + gravity_text);
    for (const char* world : {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"}) {
      const Outcome out = run_and_record(world, scene, default_run(scene)).outcome;
      if (out.verdict != Verdict::unsupported) return "ran";
      if (std::string(world) == "bullet/pbd") return out.reason;
    }
    return "";
  };
  EXPECT_TRUE(contains(refusal(plane_text({0, 0, 0}, {0, 1, 0}, "restitution = 0.1")), "no restitution"));
  EXPECT_TRUE(contains(refusal(plane_text({0, 0, 0}, {0, 1, 0}, "margin = 0.1") + plane_text({-9, 0, 0}, {1, 0, 0})),
                       "surfaces have several"));
}

TEST(PlaneCertificate, CatchesEveryChange) {
  const Scene asked = particle({0, 0.5, 0}, {0, 0, 0},
                               plane_text({0, 0, 0}, {0.6, 0.8, 0}, "margin = 0.01\nfriction = 0.3") + gravity_text);
  const std::pair<const char*, std::function<void(Plane&)>> changes[] = {
      {"normal", [](Plane& p) { p.normal = Vec3(0.6, 0.8, 1e-3).normalized(); }},
      {"contact offset", [](Plane& p) { p.point += 1e-3 * p.normal; }},
      {"friction", [](Plane& p) { p.friction = 0.31; }},
      {"motion of the plane", [](Plane& p) { p.velocity = Vec3(0.1, 0, 0); }},
  };
  for (const char* world : {"bullet/deformable-explicit", "bullet/pbd"}) {
    EXPECT_EQ(mismatches(certify(world, asked, run_and_record(world, asked, {1e-3, 2e-3, 1}).outcome)), "");
    for (const auto& [row, change] : changes) {
      Scene other = asked;
      change(other.model.find<Planes>()->list[0]);
      const auto certificate = certify(world, asked, run_and_record(world, other, {1e-3, 2e-3, 1}).outcome);
      bool named = false;
      for (const CertificateRow& r : certificate.rows)
        named |= r.parity == Parity::mismatch && r.quantity.starts_with(row);
      EXPECT_TRUE(named) << world << ": " << row;
    }
  }
}

class PlaneProtocol : public InFolder {};

TEST_F(PlaneProtocol, SceneComesBackWithTheSameHash) {
  const Scene scene = particle({0, 1, 0}, {0, 0, 0},
                               plane_text({0, 0, 0}, {0, 1, 0}, "margin = 0.1\nfriction = 0.2\nrestitution = 0.3") +
                                   plane_text({0, 0, 0}, {1, 1, 0}, "velocity = [1, 2, 3]") + gravity_text);
  const auto file = write("scene.json", scene_json(scene, default_run(scene), {}));
  EXPECT_EQ(hash_of(read_scene_json(file).scene), hash_of(scene));
}

}  // namespace
}  // namespace crosscheck
