// Planes as contact surfaces: gap and normal, scene-file errors, Coulomb's limit, restitution, walls, corners.

#include <numbers>

#include "mysim/run/contacts.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double degree = std::numbers::pi / 180, g = 9.81;

/// A particle on a plane through the origin that rises by `angle` (rad) towards +x.
Scene on_slope(double angle, const std::string& surface, const std::string& velocity = "[0, 0, 0]") {
  return small_scene(
      fmt::format("[[particle]]\nposition = [0, 0, 0]\nmass = 2\nvelocity = {}\n"
                  "[plane]\npoint = [0, 0, 0]\nnormal = [{:.17g}, {:.17g}, 0]\n{}\n{}",
                  velocity, -std::sin(angle), std::cos(angle), surface, gravity_text));
}

struct NamedRule {
  std::string name;
  const Stepper stepper;
  ContactRule contact;
};
/// Every stepper with contact on whole steps and, if it can locate events, also with located events.
std::vector<NamedRule> rules() {
  std::vector<NamedRule> list;
  for (const Stepper& s : fixed_steppers()) {
    list.push_back({std::string(s.name), s, ContactRule::coulomb});
    if (locates_events(s)) list.push_back({fmt::format("{}+events", s.name), s, ContactRule::events});
  }
  return list;
}

/// Bound on the displacement (m) by residual forces of implicit rules, at most 1e-10 m v / (h / 2) in each step, at
/// speeds v of up to g times 1 s.
double unsolved(const NamedRule& rule, double t, double h) {
  return rule.stepper.evaluations == 0 ? 1e-10 * g * t * t / h : 0;
}

Trajectory path_of(const NamedRule& rule, const Scene& scene, const Run& run) {
  Recorder recorder;
  simulate(rule.stepper, rule.contact, scene, run, recorder);
  return recorder.trajectory;
}

TEST(Surface, NormalIsTheGradientOfTheGapAndTheNearestPlaceLiesOnIt) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 normal = random.vector().normalized(), point = random.vector();
    const Surface surfaces[] = {Plane{point, normal, 0.1, 0, 0, std::nullopt},
                                Sphere{point, 0.5, 0.1, 0, 0, std::nullopt}};
    for (const Surface& surface : surfaces) {
      const Vec3 d = random.vector(), n = surface.normal(d), along = random.vector();
      const double step = std::cbrt(eps);  // m; the error of central differences is of second order
      const double slope = (surface.gap(d + step * along) - surface.gap(d - step * along)) / (2 * step);
      EXPECT_NEAR(slope, n.dot(along), 100 * step * step / d.norm());
      EXPECT_NEAR(n.norm(), 1, 4 * eps);
      const Vec3 on = surface.nearest(d, n);
      EXPECT_NEAR(surface.gap(on), 0, 8 * eps);
      EXPECT_NEAR((d - on).norm(), std::abs(surface.gap(d)), 8 * eps);
      EXPECT_LT((surface.normal_on(on) - n).norm(), 8 * eps);
      EXPECT_EQ(surface.approach(d, along) > 0, n.dot(along) > 0);
      EXPECT_LT((surface.put_on(point, point + d, n) - (point + on)).norm(), 8 * eps);
    }
  }
}

TEST(Surface, PlaneIsTheLimitOfALargeSphere) {
  // over a path of 1 m, a sphere of radius R drops by 1 / 2R below the plane
  const double radius = 1e7;
  const auto text = [&](const std::string& surface) {
    return "[[particle]]\nposition = [0, 0.2, 0]\nmass = 1\nvelocity = [1, 0, 0]\n" + surface + "friction = 0.2\n" +
           gravity_text;
  };
  const Scene plane = small_scene(text("[plane]\npoint = [0, 0, 0]\nnormal = [0, 2, 0]\n")),
              sphere =
                  small_scene(text(fmt::format("[sphere]\ncentre = [0, {0}, 0]\nradius = {1}\n", -radius, radius)));
  for (const NamedRule& rule : rules()) {
    if (rule.stepper.evaluations == 0) continue;  // implicit: accurate relative to the largest coordinate only
    SCOPED_TRACE(rule.name);
    const Trajectory a = path_of(rule, plane, {1e-3, 1, 20}), b = path_of(rule, sphere, {1e-3, 1, 20});
    // rounding errors of coordinates of 1e7 m, plus the sphere's drop below the plane
    EXPECT_LT(largest_rms_distance(a, b), 100 * radius * eps + 1 / radius);
  }
}

TEST(PlaneFile, ReportsWhatIsWrongWithFileLineAndKey) {
  const std::string particle =
                        "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, 1, 0]\nmass = 1\n"
                        "[[spring]]\nends = [0, 1]\nstiffness = 1\n",
                    pins = "[pins]\nparticles = [1]\n";
  const auto plane = [](const char* point, const char* normal, const std::string& more = "") {
    return fmt::format("[[plane]]\npoint = [{}]\nnormal = [{}]\n{}", point, normal, more);
  };
  const std::pair<std::string, const char*> bad[] = {
      {plane("0, -1, 0", "0, 0, 0"),
       "bad.toml:23: plane[0].normal: expected a direction out of the solid, got the zero vector"},
      {plane("0, -1, 0", "0, inf, 0"), "plane[0].normal[1]: expected a finite number, got inf"},
      {plane("0, -1, 0", "0, nan, 0"), "plane[0].normal[1]: expected a finite number, got nan"},
      {plane("0, 0.5, 0", "0, 1, 0"),
       "plane[0].point: expected no particle below the margin of 0 m at the start, got particle 0 at -0.5 m"},
      {plane("0, -0.5, 0", "0, 1, 0", "margin = 0.7\n"),
       "plane[0].point: expected no particle below the margin of 0.7 m at the start, got particle 0 at 0.5 m"},
      {plane("0, 0.5, 0", "0, -1, 0"),
       "plane[0].point: expected no pin below the margin of 0 m at the start, got particle 1 at -0.5 m"},
      {plane("0, -1, 0", "0, 1, 0", "margin = 0.2\n") + plane("0, -0.7, 0", "0, -3, 0", "margin = 0.2\n"),
       "particle 0 at -0.7 m"},
      {plane("5, 0, 0", "-1, 0, 0", "margin = 0\n") + plane("5, 0, 0", "1, 0, 0"), "particle 0 at -5 m"},
      {plane("0, -1, 0", "0, 1, 0", "restitution = 1.5\n"), "plane[0].restitution: expected a number from 0 to 1"},
      {plane("0, -1, 0", "0, 1, 0", "friction = -1\n"), "plane[0].friction: expected a number not below zero"},
      {plane("0, -1, 0", "0, 1, 0", "speed = 1\n"), "plane[0].speed"},
      {"[[plane]]\npoint = [0, -1, 0]\n", "normal"},
  };
  for (const auto& [text, expected] : bad) {
    // Particle 1 is the pin. It is the upper one, so a plane from above excludes it.
    const std::string message = message_of(scene_text(particle + pins + text));
    EXPECT_TRUE(contains(message, expected)) << text << message;
    EXPECT_TRUE(contains(message, "bad.toml:")) << message;
  }
  // A particle that lies, up to rounding, on two opposite planes whose gap is smaller than their margins.
  const std::string middle = "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n";
  const std::string thin = message_of(scene_text(middle + plane("0, 0, 0", "0, 1, 0") + plane("0, 0, 0", "0, -1, 0")));
  EXPECT_TRUE(contains(thin, "plane[1].point: expected more than both margins, 0 m, to the opposite plane, got 0 m"))
      << thin;
  EXPECT_EQ(message_of(scene_text(middle + plane("0, -0.1, 0", "0, 1, 0", "margin = 0.1\n") +
                                  plane("0, 1, 0", "0, -1, 0", "velocity = [0, 1, 0]\n"))),
            "");
}

TEST(Plane, HoldsAThousandthBelowCoulombsLimitAndSlidesAThousandthAbove) {
  for (const double angle : {10 * degree, 35 * degree})
    for (const NamedRule& rule : rules()) {
      SCOPED_TRACE(fmt::format("{} {}", rule.name, angle));
      const double h = 1e-3, t = 1;
      const Scene held = on_slope(angle, fmt::format("friction = {:.17g}", std::tan(angle) / 0.999));
      for (const Points& x : path_of(rule, held, {h, t, 100}).x)
        EXPECT_LT((x - held.start.x).norm(), 1e-3 * eps + unsolved(rule, t, h) + 1e-13);  // rounding of h v, 1000 times
      const double mu = std::tan(angle) / 1.001, a = g * (std::sin(angle) - mu * std::cos(angle));
      const Scene loose = on_slope(angle, fmt::format("friction = {:.17g}", mu));
      const Trajectory slid = path_of(rule, loose, {h, t, 1});
      const double way = slid.x.back().col(0).norm();
      // First-order rules err by the displacement of a step, h v = h a t, and by the free fall of the step before
      // friction acts, h^2 g. Located events are exact under constant forces.
      const double allowed = rule.contact == ContactRule::events ? 1e-12 : 2 * h * a * t + 2 * h * h * g;
      EXPECT_NEAR(way, a * t * t / 2, allowed + unsolved(rule, t, h));
      EXPECT_LT(slid.x.back()(0, 0), 0);  // downhill
    }
}

TEST(Plane, RestingParticlesLoseNothing) {
  for (const double angle : {0., 25 * degree})
    for (const NamedRule& rule : rules()) {
      SCOPED_TRACE(fmt::format("{} {}", rule.name, angle));
      const Scene scene = on_slope(angle, "friction = 0.6");
      Ledger ledger(scene.model, ContactLoss::reported);
      simulate(rule.stepper, rule.contact, scene, {1e-3, 1, 10}, ledger);
      // The bound is the rounding of m g h (J) in a thousand steps. Explicit Euler is in contact in every other step
      // only: free fall adds energy in one step and contact removes it in the next, which is no loss either.
      for (const LedgerRow& row : ledger.rows()) EXPECT_NEAR(row.contact, 0, 1e-12 + unsolved(rule, 1, 1e-3)) << row.t;
    }
}

TEST(Plane, ExplicitEulerHoldsARestingParticleEveryOtherStepAndTheOthersEveryStep) {
  for (const NamedRule& rule : rules()) {
    SCOPED_TRACE(rule.name);
    struct Count : Observer {
      bool every_step() const override { return true; }
      Verdict observe(const State&, bool) override { return Verdict::ok; }
      void contact(double) override { ++contacts; }
      int contacts = 0;
    } count;
    const Scene scene = on_slope(0, "");
    simulate(rule.stepper, rule.contact, scene, {1e-2, 1, 1}, count);
    EXPECT_EQ(count.contacts, rule.name == "explicit-euler" ? 50 : 100);
  }
}

TEST(Plane, ApicesFallByTheSquareOfRestitution) {
  const double drop = 0.3, fall = std::sqrt(2 * drop / g);
  for (const double e : {0.5, 0.8, 1.})
    for (const NamedRule& rule : rules()) {
      if (rule.contact != ContactRule::events) continue;
      for (int n = 1; n <= 4; ++n) {
        SCOPED_TRACE(fmt::format("{} e = {} apex {}", rule.name, e, n));
        Scene scene = on_slope(0, fmt::format("restitution = {}", e));
        scene.start.x(1, 0) = drop;
        double t = fall;
        for (int i = 1; i < n; ++i) t += 2 * fall * std::pow(e, i);
        t += fall * std::pow(e, n);
        const Trajectory path = path_of(rule, scene, {t / 97, t, 1});
        // Impact times are exact to their last bits; the speed converts their error to metres.
        EXPECT_NEAR(path.x.back()(1, 0), drop * std::pow(e, 2 * n), 1e-13 + unsolved(rule, t, t / 97) * 5);
        EXPECT_NEAR(path.v.back()(1, 0), 0, 1e-12 + unsolved(rule, t, t / 97) * 50);
      }
    }
}

TEST(Plane, ParticleBetweenTwoWallsReturnsAfterTwiceTheWayOverItsSpeed) {
  const double width = 0.7, speed = 3, period = 2 * width / speed;
  Scene scene = small_scene(
      "[[particle]]\nposition = [0.3, 0, 0]\nmass = 1\nvelocity = [3, 0, 1]\n"
      "[[plane]]\npoint = [0, 5, 0]\nnormal = [1, 0, 0]\nrestitution = 1\n"
      "[[plane]]\npoint = [0.75, 0, 1]\nnormal = [-1, 0, 0]\nmargin = 0.05\nrestitution = 1\n");
  for (const NamedRule& rule : rules()) {
    SCOPED_TRACE(rule.name);
    const double t = 20 * period;
    const auto off = [&](double h) { return std::abs(path_of(rule, scene, {h, t, 20}).x.back()(0, 0) - 0.3); };
    // In contact on whole steps, each impact puts the particle on the wall, up to the path v h of a step from its exact
    // position. With located events, a particle within 1e-12 of the coordinates counts as touching. This error matters
    // here, because every impact falls on the end of a step.
    for (const double h : {1e-3, 2.5e-4})
      EXPECT_LT(off(h), rule.contact == ContactRule::events ? 40 * 1e-12 * 6 : 40 * speed * h) << h;
  }
}

/// A particle that falls into a corner of rotated planes at right angles.
Scene corner(int planes, const Eigen::Matrix3d& turn) {
  const auto list = [](const Vec3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); };
  std::string text = "[[particle]]\nposition = " + list(turn * Vec3(0.1, 0.2, 0.3)) + "\nmass = 1\n";
  for (int i = 0; i < planes; ++i) text += "[[plane]]\npoint = [0, 0, 0]\nnormal = " + list(turn.col(i)) + "\n";
  return small_scene(text + "[gravity]\nacceleration = " + list(turn * Vec3(-2, -3, -4)) + "\n");
}

TEST(Plane, CornerAtRightAnglesStopsEachCoordinateByItself) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.7, Vec3::UnitZ()) *
                                Eigen::AngleAxisd(-0.4, Vec3::UnitY()))
                                   .toRotationMatrix();
  const Vec3 a(-2, -3, -4), start(0.1, 0.2, 0.3);
  for (const int planes : {2, 3})
    for (const NamedRule& rule : rules()) {
      SCOPED_TRACE(fmt::format("{} in a corner of {}", rule.name, planes));
      const Scene scene = corner(planes, turn);
      for (const double h : {1e-2, 2.5e-3}) {
        const Trajectory path = path_of(rule, scene, {h, 1, 20});
        for (int i = 0; i < path.frames(); ++i) {
          const Vec3 x = turn.transpose() * path.x[i].col(0), free = start + path.t[i] * path.t[i] / 2 * a;
          for (int k = 0; k < 3; ++k) {
            const double exact = k < planes ? std::max(0.0, free[k]) : free[k];
            // First-order rules and contact on whole steps may be off by the distance covered in a step, at speeds of
            // at most 4 m/s. Located events are exact, also with several planes, because events are located one by one.
            const double allowed = rule.stepper.order == 1 || rule.contact == ContactRule::coulomb ? 3 * h : 1e-12;
            EXPECT_NEAR(x[k], exact, allowed + unsolved(rule, 1, h)) << path.t[i];
          }
        }
        EXPECT_LT((turn.transpose() * path.x.back().col(0)).head(planes).cwiseAbs().maxCoeff(), 1e-12);
      }
    }
}

TEST(Plane, NoParticleEndsAStepBehindOneNotEvenInABlowUp) {
  const Scene scene = small_scene(
      "[grid]\nsize = [6, 6]\norigin = [0, 0.01, 0]\nu = [0.9, 0.1, 0]\nv = [0, 0, 1]\nmass = 1\n"
      "[grid.stiffness]\nstructural = 100\nshear = 100\nbend = 100\n[drag]\ngamma = 1\n"
      "[plane]\npoint = [0, 0, 0]\nnormal = [0.1, 1, 0.2]\nfriction = 0.4\nrestitution = 0.5\n"
      "[gravity]\nacceleration = [0, -9.81, 0]\n");
  for (const NamedRule& rule : rules())
    for (const double h : {1e-3, 5e-2}) {
      SCOPED_TRACE(fmt::format("{} h = {}", rule.name, h));
      const std::vector<Surface> surfaces = surfaces_of(scene.model);
      const Trajectory path = path_of(rule, scene, {h, 1, 20});
      for (int i = 0; i < path.frames(); ++i) {
        if (!path.x[i].allFinite()) break;
        // projection and measurement each round the coordinates by some ulps
        for (int p = 0; p < path.x[i].cols(); ++p)
          EXPECT_GE(clearance_from(surfaces, path.t[i], path.x[i].col(p)), -8 * eps * (1 + path.x[i].col(p).norm()));
      }
    }
}

TEST(MovingPlane, CarriesWhatLiesOnItAndItsWorkIsAccountedFor) {
  // The plane moves upwards and sideways. After slipping for v / (mu g), the particle is carried along by friction.
  const Scene scene = on_slope(0, "friction = 0.5\nvelocity = [0.6, 0.4, 0]");
  for (const NamedRule& rule : rules()) {
    SCOPED_TRACE(rule.name);
    const double h = 1e-3, slip = 0.6 / (0.5 * g);
    Recorder recorder;
    Ledger ledger(scene.model, ContactLoss::reported);
    Observers both({&recorder, &ledger});
    simulate(rule.stepper, rule.contact, scene, {h, 1, 20}, both);
    const State last{1, recorder.trajectory.x.back(), recorder.trajectory.v.back()};
    // The initial impact applies the friction of mu times 0.4 m/s at once, which shortens the slip.
    const double at_once = 0.5 * 0.4, rest = (0.6 - at_once) / (0.5 * g);
    const double x = 0.6 - (0.6 - at_once) * rest / 2;
    EXPECT_LT(rest, slip);
    EXPECT_NEAR(last.x(1, 0), 0.4, 1e-12 + unsolved(rule, 1, h) + (rule.name == "explicit-euler" ? g * h * h : 0));
    EXPECT_NEAR(last.x(0, 0), x, rule.contact == ContactRule::events ? 1e-12 + unsolved(rule, 1, h) : 2e-3);
    // J: the plane's work equals the particle's energy, m (v^2 / 2 + g y), to first order in the slip.
    const double off = ledger.rows().back().balance() - ledger.rows().front().balance();
    EXPECT_NEAR(off, 0, rule.contact == ContactRule::events ? 1e-11 + 10 * unsolved(rule, 1, h) : 0.03);
  }
}

TEST(Plane, RotatedAndScaledScenesGiveTheSameMotion) {
  // units: lengths in mm, times in ms
  const auto text = [](double length, double time) {
    return scene_text(
        fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = 1\nvelocity = [{}, 0, 0]\n"
                    "[plane]\npoint = [0, 0, 0]\nnormal = [-0.2, 1, 0]\nfriction = 0.3\nrestitution = 0.4\n"
                    "[gravity]\nacceleration = [0, {}, 0]\n",
                    0.5 * length, length / time, -9.81 * length / time / time),
        time, 1e-3 * time, 20);
  };
  for (const NamedRule& rule : rules()) {
    SCOPED_TRACE(rule.name);
    const Scene si = parse_scene(text(1, 1), "si"), milli = parse_scene(text(1e3, 1e3), "milli");
    const Trajectory a = path_of(rule, si, {1e-3, 1, 20}), b = path_of(rule, milli, {1, 1e3, 20});
    // With contact on whole steps, the rounding of decimal units may, rarely, move an impact to the end of a different
    // step.
    for (int i = 0; i < a.frames(); ++i)
      EXPECT_LT((a.x[i] - 1e-3 * b.x[i]).norm(), 1e-9 + 10 * unsolved(rule, 1, 1e-3)) << i;
  }
}

}  // namespace
}  // namespace crosscheck
