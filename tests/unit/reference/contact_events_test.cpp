// Contact located within the step is of second order, compared with closed forms and an independent event-driven
// solution.

#include <numbers>
#include <numeric>

#include "reference/truth/exact/exact.h"
#include "reference/truth/independent/integrators.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double g = 9.81, degrees_of_turn = 180 / std::numbers::pi;

const std::vector<std::string> rules = {"leapfrog", "implicit-midpoint"};

Trajectory with_events(const std::string& rule, const Scene& scene, double h, double until, int samples) {
  Recorder recorder;
  simulate(stepper(rule), ContactRule::events, scene, {h, until, samples, 1e-10}, recorder);
  return recorder.trajectory;
}

/// Orders between steps h, h/2 and h/4.
template <class Error>
std::pair<double, double> orders(Error error, double h) {
  const double coarse = error(h), middle = error(h / 2), fine = error(h / 4);
  return {slope(coarse, middle), slope(middle, fine)};
}

/// Expects order 2: within 0.1 for leapfrog and trapezoidal, and above 1.9 for the other rules.
void expect_second_order(const std::string& rule, std::pair<double, double> seen) {
  for (const double order : {seen.first, seen.second}) {
    EXPECT_GT(order, 1.9) << rule;
    if (rule == "leapfrog" || rule == "trapezoidal") {
      EXPECT_LT(order, 2.1) << rule;
    }
  }
}

Scene on_ball(double degrees, const std::string& surface, const std::string& velocity = "[0, 0, 0]",
              const std::string& more = "") {
  const double angle = degrees / degrees_of_turn;
  return small_scene(
      fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 2\nvelocity = {}\n"
                  "[sphere]\ncentre = [0, 0, 0]\nradius = 1\n{}\n{}{}",
                  std::sin(angle), std::cos(angle), velocity, surface, more, gravity_text));
}

/// Angle (degrees) at which a particle left a ball of 1 m, from its state in free flight. The particle keeps the
/// horizontal speed v cos(theta) of the point where v^2 = g R cos(theta).
double left_at(const State& s) { return std::acos(std::cbrt(s.v(0, 0) * s.v(0, 0) / g)) * degrees_of_turn; }

TEST(ContactEvents, ParticleLeavesABallWhereEnergySays) {
  const Scene scene = on_ball(1, "");
  const double exact = std::acos(2. / 3 * std::cos(1 / degrees_of_turn)) * degrees_of_turn;
  for (const auto& rule : rules) {
    const auto error = [&](double h) {
      const Trajectory t = with_events(rule, scene, h, 1.5, 1);
      EXPECT_LT(t.x.back()(1, 0), 0.6) << "the particle must have left the ball";
      return std::abs(left_at({t.t.back(), t.x.back(), t.v.back()}) - exact);
    };
    EXPECT_LT(error(1e-3), 1e-3) << rule;
    expect_second_order(rule, orders(error, 0.01));
  }
}

TEST(ContactEvents, FrictionOnABallLeavesToSecondOrderWhereTheWholeStepRuleIsFirst) {
  const Scene scene = shipped_scene("slide");
  const auto exact = exact_solution(scene);
  const auto off = [&](const Trajectory& t) {
    double worst = 0;
    for (int i = 0; i < t.frames(); ++i) worst = std::max(worst, (t.x[i] - exact->at(t.t[i]).x).norm());
    return worst;
  };
  for (const auto& rule : rules)
    expect_second_order(rule, orders([&](double h) { return off(with_events(rule, scene, h, 1, 20)); }, 0.01));
  const auto whole = orders([&](double h) { return off(trajectory_of(stepper("leapfrog"), scene, {h, 1, 20})); }, 0.01);
  EXPECT_LT(whole.first, 1.5);
  EXPECT_LT(whole.second, 1.5);
}

TEST(ContactEvents, StopsOnABallWhereCoulombSays) {
  // u = theta'^2 satisfies du/dtheta = 2 (g/R) (sin - mu cos) + 2 mu u. The particle stops at the root of the closed
  // form.
  const double mu = 0.5, v0 = 1;
  const double a = g * (4 * mu * mu - 2) / (1 + 4 * mu * mu), b = -6 * mu * g / (1 + 4 * mu * mu), c = v0 * v0 - a;
  double low = 0, high = 0.3;
  for (int i = 0; i < 80; ++i) {
    const double at = (low + high) / 2;
    (c * std::exp(2 * mu * at) + a * std::cos(at) + b * std::sin(at) > 0 ? low : high) = at;
  }
  ASSERT_LT(std::tan(low), mu);  // friction holds it there
  const Scene scene = on_ball(0, fmt::format("friction = {}", mu), fmt::format("[{}, 0, 0]", v0));
  for (const auto& rule : rules) {
    const auto error = [&](double h) {
      const Trajectory t = with_events(rule, scene, h, 1, 10);
      EXPECT_EQ(t.v.back(), Points::Zero(3, 1));
      EXPECT_EQ(t.x[9], t.x[10]);
      return std::abs(std::atan2(t.x.back()(0, 0), t.x.back()(1, 0)) - low);
    };
    expect_second_order(rule, orders(error, 0.02));
  }
}

TEST(ContactEvents, StopsOnAPlaneAfterVSquaredOverTwoMuG) {
  // A ball of 1e6 m: its curvature changes the path by a relative 1e-6, the square of the path over the radius.
  const Scene scene = small_scene(std::string("[[particle]]\nposition = [0, 1e6, 0]\nmass = 1\nvelocity = [1, 0, 0]\n"
                                              "[sphere]\ncentre = [0, 0, 0]\nradius = 1e6\nfriction = 0.3\n") +
                                  gravity_text);
  for (const auto& rule : rules)
    EXPECT_NEAR(with_events(rule, scene, 1e-2, 1, 10).x.back()(0, 0), 1 / (2 * 0.3 * g), 1e-6) << rule;
}

TEST(ContactEvents, HoldsAndSlidesWithinAThousandthOfCoulombsAngle) {
  for (const double degrees : {5., 20., 50.})
    for (const auto& rule : rules) {
      SCOPED_TRACE(fmt::format("{} {}", rule, degrees));
      const double limit = std::tan(degrees / degrees_of_turn);
      const Scene held = on_ball(degrees, fmt::format("friction = {:.17g}", 1.001 * limit));
      EXPECT_LT((with_events(rule, held, 1e-3, 2, 2).x.back() - held.start.x).norm(), 8 * eps);
      const Scene loose = on_ball(degrees, fmt::format("friction = {:.17g}", 0.999 * limit));
      // The particle moves by at least g (sin - mu cos) t^2 / 2, because the slope only increases.
      const double way = g * 0.001 * std::sin(degrees / degrees_of_turn) * 0.25 / 2;
      EXPECT_GT((with_events(rule, loose, 1e-3, 0.5, 1).x.back() - loose.start.x).norm(), way);
    }
}

TEST(ContactEvents, ThirdApexIsExactAndEndlessBouncesEndInRest) {
  for (const double e : {0.5, 0.7, 1.})
    for (const auto& rule : rules) {
      SCOPED_TRACE(fmt::format("{} {}", rule, e));
      Scene scene = on_ball(0, fmt::format("restitution = {}", e));
      scene.start.x(1, 0) = 1.3;
      const auto exact = exact_solution(scene);
      ASSERT_TRUE(exact);
      const double fall = std::sqrt(0.6 / g), apex = fall * (1 + 2 * e + 2 * e * e + e * e * e);
      const Trajectory t = with_events(rule, scene, 7e-3, apex, 30);
      // Each of a few hundred steps rounds a position of 1.3 m, and the time of an impact at 2.4 m/s. Newton's method
      // of implicit rules may leave 1e-10 of the force m v / h at 2 m/s, which displaces the particle by 1e-10 g t^2
      // times v / (h g).
      const double allowed = rule == "implicit-midpoint" ? 1e-7 : 1e-13 * 30;
      for (int i = 0; i < t.frames(); ++i) EXPECT_NEAR(t.x[i](1, 0), exact->at(t.t[i]).x(1, 0), allowed);
      EXPECT_NEAR(t.x.back()(1, 0) - 1, 0.3 * std::pow(e, 6), allowed);
      if (e > 0.6) continue;
      const Trajectory rest = with_events(rule, scene, 7e-3, 2, 2);
      EXPECT_NEAR(rest.x.back()(1, 0), 1, 4 * eps);
      EXPECT_NEAR(rest.v.back().norm(), 0, 1e-12);
    }
}

TEST(ContactEvents, EnergyIsAccountedForInSlidesStopsAndImpacts) {
  for (const auto& scene : {shipped_scene("slide"), on_ball(0, "friction = 0.5", "[1, 0, 0]"), shipped_scene("bounce")})
    for (const auto& rule : rules) {
      const auto open = [&](double h) {
        Ledger ledger(scene.model, ContactLoss::reported);
        simulate(stepper(rule), ContactRule::events, scene, {h, 0.9, 9}, ledger);
        double worst = 0;
        for (const LedgerRow& row : ledger.rows())
          worst = std::max(worst, std::abs(row.balance() - ledger.rows()[0].balance()));
        return worst;
      };
      // Energy gap (J), of second order in h: some joules are exchanged, with a relative error of about (h / 1 s)^2. A
      // bounce that is too low to be resolved by a step is ignored, which adds m g (g h^2 / 8).
      EXPECT_LT(open(1e-3), 1e-4) << rule;
      EXPECT_LT(open(1e-4), 1e-6) << rule;
    }
}

/// Two balls of 1 m with centres `apart` (m), and a particle on the first one.
Scene valley(double apart, double degrees, double friction) {
  const double angle = degrees / degrees_of_turn;
  return small_scene(
      fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 1\n"
                  "[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\nfriction = {}\n"
                  "[[sphere]]\ncentre = [{}, 0, 0]\nradius = 1\nfriction = {}\n{}",
                  std::sin(angle), std::cos(angle), friction, apart, friction, gravity_text));
}

TEST(ContactEvents, ComesToRestInTheValleyBetweenTwoBalls) {
  for (const double apart : {0.6, 1., 1.6})
    for (const double friction : {0., 0.1})
      for (const auto& rule : rules) {
        SCOPED_TRACE(fmt::format("{} {} {}", rule, apart, friction));
        const Scene scene = valley(apart, 10, friction);
        const Trajectory t = with_events(rule, scene, 1e-3, 4, 8);
        EXPECT_NEAR(t.x.back()(0, 0), apart / 2, 1e-12);
        EXPECT_NEAR(t.x.back()(1, 0), std::sqrt(1 - apart * apart / 4), 1e-12);
        EXPECT_LT(t.v.back().norm(), 1e-12);
      }
}

TEST(ContactEvents, ValleyAgreesWithTheEventDrivenRouteToSecondOrder) {
  // the particle runs through the valley and up the other ball, several times
  const Scene scene = valley(0.8, 10, 0.05);
  Recorder truth;
  run_event_driven(scene, {1e-3, 1.2, 24, 1e-12}, truth);
  for (const auto& rule : rules) {
    const auto error = [&](double h) { return sup_rms(with_events(rule, scene, h, 1.2, 24), truth.trajectory); };
    EXPECT_LT(error(1e-3), 1e-5);
    expect_second_order(rule, orders(error, 5e-3));
  }
}

TEST(EventDriven, IsWhatClosedFormsSay) {
  for (const auto name : {"slide", "bounce"}) {
    const Scene scene = shipped_scene(name);
    const auto exact = exact_solution(scene);
    Recorder r;
    run_event_driven(scene, {1e-3, 1, 50, 1e-12}, r);
    for (int i = 0; i < r.trajectory.frames(); ++i)
      // each of a thousand steps may err by the tolerance, 1e-12 of some metres
      EXPECT_LT((r.trajectory.x[i] - exact->at(r.trajectory.t[i]).x).norm(), 1e-9) << name << ' ' << i;
  }
}

/// A chain of n particles along a great circle over the top of a ball. Only weight stretches the springs.
Scene chain_on_ball(int n, double friction, const std::string& more = "") {
  std::string text;
  for (int i = 0; i < n; ++i) {
    const double angle = -0.3 + 0.9 * i / (n - 1);
    text +=
        fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, 0]\nmass = 0.1\n", std::sin(angle), std::cos(angle));
  }
  for (int i = 0; i + 1 < n; ++i) text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = 200\n", i, i + 1);
  return small_scene(text + more + fmt::format("[sphere]\ncentre = [0, 0, 0]\nradius = 1\nfriction = {}\n", friction) +
                     gravity_text);
}

TEST(ContactEvents, ChainOnABallAgreesWithTheEventDrivenRouteToSecondOrder) {
  for (const double friction : {0., 0.3})
    for (const auto more : {"", "[drag]\ngamma = 1\n"}) {
      const Scene scene = chain_on_ball(9, friction, more);
      Recorder truth;
      run_event_driven(scene, {1e-3, 0.5, 10, 1e-11}, truth);
      for (const auto& rule : rules) {
        SCOPED_TRACE(fmt::format("{} {} {}", rule, friction, more));
        const auto error = [&](double h) { return sup_rms(with_events(rule, scene, h, 0.5, 10), truth.trajectory); };
        if (friction == 0) {
          expect_second_order(rule, orders(error, 5e-3));
        } else {
          // Errors vary by some per cent with the instant in a step at which friction lets go, so the order is averaged
          // over four halvings.
          EXPECT_NEAR(slope(error(2.5e-3), error(2.5e-3 / 16)) / 4, 2, 0.1);
        }
      }
    }
}

TEST(EventTruth, OfAChainCoversItsErrorAndIsNoDifference) {
  const Scene scene = chain_on_ball(5, 0.3, "[drag]\ngamma = 1\n");
  const crosscheck::Run run{2e-3, 0.3, 6};
  const auto truth = event_truth(scene, run);
  ASSERT_TRUE(truth);
  EXPECT_EQ(truth->tier, Tier::converged);
  EXPECT_FALSE(truth->under_contact_rule);
  EXPECT_TRUE(contains(truth->how, "mysim/leapfrog+events"));
  Recorder better;
  run_event_driven(scene, {2e-4, 0.3, 6, 1e-13}, better);
  const double off = sup_rms(truth->trajectory, better.trajectory);
  EXPECT_LT(off, truth->error_bar);
  // The error bar is that of the second-order route, which stops at 1e-8 of the scene's size.
  EXPECT_LT(truth->error_bar, 1e-8 * scene.size());
}

TEST(EventDriven, StopsSlipsAndShortBouncesDoNotHoldItUp) {
  // Friction may reverse a slow slide within a single step, however short. Without the creep rule, the second scene
  // took 4e7 evaluations and the third never ended. The first scene's bounces also never ended, if impacts were
  // detected only at a depth of 1e-13 of the radius.
  for (const unsigned seed : {3u, 4u, 8u}) {
    const Scene scene = random_contact_scene(seed);
    NullObserver nobody;
    const Outcome out = run_event_driven(scene, {scene.step, scene.duration, 20, 1e-10}, nobody);
    EXPECT_EQ(out.verdict, Verdict::ok) << seed;
    EXPECT_LT(out.evaluations, 4e5) << seed;
  }
}

/// A particle at `position` near a moving ball.
Scene on_moving_ball(double friction, const char* position, const char* amplitude, const char* velocity = "[0, 0, 0]") {
  return small_scene(
      fmt::format("[[particle]]\nposition = {}\nmass = 1\nvelocity = {}\n[sphere]\ncentre = [0, 0, 0]\nradius = 1\n"
                  "friction = {}\n[sphere.motion]\namplitude = {}\nfrequency = 0.7\nramp = 0.5\n{}",
                  position, velocity, friction, amplitude, gravity_text),
      0.4, 1e-3, 8);
}

TEST(EventTruth, BarsBesideMovingBallsAreThoseOfRoutesOfHighOrder) {
  // `round_off`: rounding errors of the other route in its thousands of steps, a few hundred eps of the positions.
  const auto expect_bar = [](const Scene& scene, auto exact, double round_off) {
    const auto truth = event_truth(scene, default_run(scene));
    ASSERT_TRUE(truth);
    ASSERT_TRUE(std::isinf(truth->until));
    double error = 0;
    for (int i = 0; i < truth->trajectory.frames(); ++i)
      error = std::max(error, (truth->trajectory.x[i].col(0) - exact(truth->trajectory.t[i])).norm());
    EXPECT_LE(error, truth->error_bar + round_off);
    EXPECT_LE(truth->error_bar, 50 * std::max(error, round_off)) << error;
  };
  // carried by friction
  const Scene carried = on_moving_ball(0.9, "[0, 1, 0]", "[0.05, 0.02, 0.03]");
  const Motion motion = *carried.model.find<Spheres>()->list[0].motion;
  expect_bar(
      carried, [&](double t) { return Vec3(Vec3(0, 1, 0) + displacement_at(motion, t)); }, 1e-13);
  // a particle thrown over the ball
  const Scene thrown = on_moving_ball(0.9, "[0, 2, 0]", "[0.05, 0.02, 0.03]", "[4, 1, 0]");
  expect_bar(
      thrown, [&](double t) { return Vec3(4 * t, 2 + t - g * t * t / 2, 0); }, 1e-13);
  // Without friction, a ball that accelerates downwards by more than g leaves the particle in free fall.
  const Scene left = on_moving_ball(0, "[0, 1, 0]", "[0, -40, 0]");
  Recorder path;
  run_event_driven(left, {1e-3, 0.4, 8, 1e-12}, path);
  const Motion& away = *left.model.find<Spheres>()->list[0].motion;
  // The particle follows the ball until the ball's downward acceleration reaches g.
  double low = 0, high = 0.2;
  const auto falls = [&](double t) { return (velocity_at(away, t + 1e-5) - velocity_at(away, t - 1e-5))[1] / 2e-5; };
  for (int i = 0; i < 50; ++i) (falls((low + high) / 2) < -g ? high : low) = (low + high) / 2;
  const double from = 1 + displacement_at(away, low)[1], v = velocity_at(away, low)[1];
  for (int i = 0; i < path.trajectory.frames(); ++i) {
    const double t = path.trajectory.t[i], s = t - low;
    const double height = s < 0 ? 1 + displacement_at(away, t)[1] : from + v * s - g * s * s / 2;
    EXPECT_NEAR(path.trajectory.x[i](1, 0), height, 1e-9) << t;  // error of a root from differences over 2e-5 s
  }
  // a slide with friction, compared with the same route at a tighter tolerance
  for (const double friction : {0., 0.1, 0.3}) {
    SCOPED_TRACE(friction);
    const Scene slide = on_moving_ball(friction, "[0, 1, 0]", "[0.05, 0.02, 0.03]", "[1, 0, 0.2]");
    const auto truth = event_truth(slide, default_run(slide));
    ASSERT_TRUE(truth);
    Recorder better;
    run_event_driven(slide, {2.5e-4, 0.4, 8, 1e-13}, better);
    EXPECT_LE(sup_rms(truth->trajectory, better.trajectory), truth->error_bar);
    EXPECT_LE(truth->error_bar, 1e-9);  // Moreau's rule of order 1 errs by 1e-4
    std::printf("slide on a moving ball, friction %g: error %.2g m, bar %.2g m\n", friction,
                sup_rms(truth->trajectory, better.trajectory), truth->error_bar);
  }
}

TEST(EventTruth, IsNoneWhereARouteKnowsNothingAndSaysWhy) {
  const auto refused = [](const Scene& scene) -> std::string {
    EXPECT_FALSE(event_truth(scene, {1e-3, 0.1, 2}));
    try {
      NullObserver nobody;
      run_event_driven(scene, {1e-3, 0.1, 2, 1e-9}, nobody);
    } catch (const Unsupported& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_TRUE(contains(refused(shipped_scene("chain")), "no contact"));
  // a particle moving along the valley between two balls, perpendicular to the plane of their centres
  Scene groove = valley(1, 10, 0);
  groove.start.x.col(0) = Vec3(0.5, std::sqrt(0.75) * std::cos(0.3), std::sqrt(0.75) * std::sin(0.3));
  EXPECT_TRUE(contains(refused(groove), "between two surfaces"));
  EXPECT_EQ(refused(chain_on_ball(160, 0)), "");  // it runs, but no truth is claimed for so many particles
}

TEST(ContactEvents, NothingEndsInsideAndNothingPassesThrough) {
  for (const Stepper& s : steppers())
    for (const bool moving : {false, true})
      for (const double h : {1e-3, 5e-2}) {  // the larger one blows up the cloth in every explicit rule
        SCOPED_TRACE(fmt::format("{} {} {}", s.name, moving, h));
        const Scene scene = small_scene(
            std::string("[grid]\nsize = [7, 7]\norigin = [-0.4, 1.05, -0.5]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 1\n"
                        "[grid.stiffness]\nstructural = 100\nshear = 100\nbend = 100\n[drag]\ngamma = 2\n"
                        "[[sphere]]\ncentre = [-0.5, 0, 0]\nradius = 1\nfriction = 0.3\n"
                        "[[sphere]]\ncentre = [0.6, 0, 0]\nradius = 0.9\nrestitution = 0.5\n") +
            (moving ? "[sphere.motion]\namplitude = [0, 0.2, 0.1]\nfrequency = 1\nramp = 0.2\n" : "") + gravity_text);
        Recorder path;
        simulate(s, ContactRule::events, scene, {h, 0.5, 10}, path);
        for (int i = 0; i < path.trajectory.frames(); ++i)
          for (int j = 0; j < path.trajectory.x[i].cols(); ++j) {
            const Vec3 x = path.trajectory.x[i].col(j);
            // tolerance: rounding of the projections onto one ball after the other, and of this measurement
            EXPECT_FALSE(clearance_from(surfaces_of(scene.model), path.trajectory.t[i], x) < -1e-12);
          }
      }
  // At 100 m/s, a step of 1/20 s would carry the particle past the ball at once.
  const Scene fast = on_ball(0, "restitution = 1", "[0, 0, 0]");
  Scene shot = fast;
  shot.start.x.col(0) = Vec3(0, 3.5, 0), shot.start.v.col(0) = Vec3(0, -100, 0);
  EXPECT_GT(with_events("leapfrog", shot, 0.05, 0.05, 1).x.back()(1, 0), 3);
  EXPECT_LT(trajectory_of(stepper("leapfrog"), shot, {0.05, 0.05, 1}).x.back()(1, 0), -1);
}

TEST(ContactEvents, KeepAMirrorSymmetry) {
  const int n = 5;
  const Scene scene = small_scene(
      std::string("[grid]\nsize = [5, 5]\norigin = [-0.4, 1.05, -0.4]\nu = [0.8, 0, 0]\nv = [0, 0, 0.8]\nmass = 0.5\n"
                  "[grid.stiffness]\nstructural = 150\nshear = 100\nbend = 100\n[drag]\ngamma = 1\n"
                  "[sphere]\ncentre = [0, 0, 0]\nradius = 1\nfriction = 0\n") +
      gravity_text);
  for (const Stepper& rule : steppers()) {
    if (!locates_events(rule)) continue;
    SCOPED_TRACE(rule.name);
    Recorder r;
    simulate(rule, ContactRule::events, scene, {1e-3, 0.3, 6, 1e-10}, r);
    for (const Points& x : r.trajectory.x)
      for (int i = 0; i < n * n; ++i) {
        const Vec3 here = x.col(i), there = x.col(i / n * n + n - 1 - i % n);
        // Rounding of 300 steps grows about a hundredfold. Two different paths differ by 1e-7 or more.
        EXPECT_LT((here - Vec3(-there[0], there[1], there[2])).norm(), 300 * 100 * eps);
      }
  }
}

TEST(ContactEvents, ChangeNoBitWhereNothingTouches) {
  for (const auto& rule : rules) {
    Scene scene = shipped_scene("chain");
    scene.model.terms.emplace_back(Spheres{{Sphere{{0, 5, 0}, 1, 0, 0, 0, std::nullopt}}});
    scene.duration = 1;
    EXPECT_TRUE(identical(with_events(rule, scene, 1e-3, 1, 10), [&] {
      Recorder r;
      simulate(stepper(rule), ContactRule::coulomb, scene, {1e-3, 1, 10, 1e-10}, r);
      return r.trajectory;
    }()));
  }
}

/// In the frame of the moving sphere, gravity is reduced by the sphere's acceleration.
TEST(ContactEvents, AMovingSphereIsFollowedToSecondOrder) {
  for (const double friction : {0., 0.1, 0.5}) {
    const Scene scene = small_scene(
        fmt::format("[[particle]]\nposition = [0, 1, 0]\nmass = 1\n[sphere]\ncentre = [0, 0, 0]\nradius = 1\n"
                    "friction = {}\n[sphere.motion]\namplitude = [0.05, 0.02, 0.03]\nfrequency = 0.7\nramp = 0.5\n",
                    friction) +
        gravity_text);
    for (const auto& rule : rules) {
      SCOPED_TRACE(fmt::format("{} {}", rule, friction));
      const Trajectory finest = with_events(rule, scene, 5e-5, 0.8, 8);
      const auto error = [&](double h) { return sup_rms(with_events(rule, scene, h, 0.8, 8), finest); };
      if (friction == 0) {
        // the finest run's error is 1/2500 of the last one's
        expect_second_order(rule, orders(error, 1e-2));
      } else if (friction == 0.1) {
        // The particle sticks and slips. The constant of h^2 depends on the instant in a step at which the particle
        // lets go.
        EXPECT_LT(error(1.25e-3), 2e-6);
        EXPECT_GT(sup_rms(trajectory_of(stepper(rule), scene, {1.25e-3, 0.8, 8}), finest), 5e-5);
      } else {  // the particle is carried along the sphere's known path
        const Vec3 carried = displacement_at(*scene.model.find<Spheres>()->list[0].motion, 0.8);
        EXPECT_LT((finest.x.back().col(0) - Vec3(0, 1, 0) - carried).norm(), 1e-12);
        EXPECT_LT(error(1e-2), 1e-12);
      }
    }
  }
}

/// Checks the statement of contact_events.h with a solution that shares no equation with the rule.
TEST(ContactEvents, StickAndSlipOnAMovingSphereKeepTheOrderInTheTrendOnly) {
  const char* const motions[] = {"amplitude = [0.05, 0.02, 0.03]\nfrequency = 0.7\nramp = 0.5\n",
                                 "amplitude = [0.02, 0.01, 0.04]\nfrequency = 2\nramp = 0.3\n",
                                 "amplitude = [0.2, 0.1, 0.1]\nfrequency = 0.5\nramp = 0.5\n"};
  std::vector<double> trends;
  double least = INFINITY, most = 0;
  for (const char* motion : motions)
    for (const double friction : {0.05, 0.12, 0.2}) {
      SCOPED_TRACE(fmt::format("{} {}", motion, friction));
      const Scene scene =
          on_ball(0, fmt::format("friction = {}", friction), "[0, 0, 0]", std::string("[sphere.motion]\n") + motion);
      Recorder truth;
      run_event_driven(scene, {1e-3, 0.8, 8, 1e-11}, truth);
      const auto error = [&](double h) { return sup_rms(with_events("leapfrog", scene, h, 0.8, 8), truth.trajectory); };
      std::vector<double> steps, errors;
      for (int k = 8; k <= 256; k = k * 6 / 5) {  // 13 to 0.4 ms
        const double h = 0.1 / k;
        steps.push_back(std::log(h)), errors.push_back(std::log(error(h)));
        const double order = slope(std::exp(errors.back()), error(h / 2));
        least = std::min(least, order), most = std::max(most, order);
      }
      const Eigen::Map<const Eigen::ArrayXd> x(steps.data(), std::ssize(steps)), y(errors.data(), std::ssize(errors));
      trends.push_back(((x - x.mean()) * y).sum() / (x - x.mean()).square().sum());
      // standard deviation of the trend over 33 such scenes: 0.14
      EXPECT_NEAR(trends.back(), 2, 3.5 * 0.14);
    }
  const double count = static_cast<double>(trends.size());
  EXPECT_NEAR(std::accumulate(trends.begin(), trends.end(), 0.) / count, 2, 3.5 * 0.14 / std::sqrt(count));
  EXPECT_LT(least, 0.5);
  EXPECT_GT(most, 3.5);
}

TEST(ContactEvents, AreTheSameInTheFusedStepOfACloth) {
  for (const bool moving : {false, true}) {
    const Scene scene = small_scene(
        std::string("[grid]\nsize = [20, 20]\norigin = [-0.4, 1.05, -0.5]\nu = [1, 0, 0]\nv = [0, 0, 1]\nmass = 1\n"
                    "[grid.stiffness]\nstructural = 100\nshear = 100\nbend = 100\n[drag]\ngamma = 2\n"
                    "[sphere]\ncentre = [0, 0, 0]\nradius = 1\nfriction = 0.3\n") +
        (moving ? "[sphere.motion]\namplitude = [0, 0.1, 0.1]\nfrequency = 1\nramp = 0.2\n" : "") + gravity_text);
    for (const auto& rule : {"leapfrog", "symplectic-euler"}) {
      Recorder fused, general;
      simulate(stepper(rule), ContactRule::events, scene, {1e-3, 0.2, 10}, fused);
      simulate(stepper(rule), ContactRule::events, scene, {1e-3, 0.2, 10}, general, {ExecutionPath::general, 1});
      // The paths differ by rounding. They also differ by h^3 for each particle that leaves a ball in a fused step
      // although an acceleration of O(h) still presses it onto the ball. Under a first-order rule, its two paths
      // separate by h^2.
      EXPECT_LT(sup_rms(fused.trajectory, general.trajectory), rule == std::string_view("leapfrog") ? 1e-6 : 1e-3);
      double nearest = 1;
      for (int i = 0; i < general.trajectory.frames(); ++i)
        for (const auto& x : general.trajectory.x[i].colwise())
          nearest = std::min(nearest, clearance_from(surfaces_of(scene.model), general.trajectory.t[i], x));
      EXPECT_LT(nearest, 1e-9) << "expected a contact";
    }
  }
}

}  // namespace
}  // namespace crosscheck
