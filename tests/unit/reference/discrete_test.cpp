// Closed forms of one-step rules: mysim's steppers and Bullet's explicit world agree to round-off with their own closed
// form, and with no other.

#include <numbers>

#include "mysim/eigenvalues.h"
#include "mysim/model/system.h"
#include "reference/truth/discrete.h"
#include "reference/truth/exact/exact.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

const DiscreteStepper& discrete(std::string_view name) {
  for (const DiscreteStepper& rule : discrete_steppers())
    if (rule.name == name) return rule;
  throw std::out_of_range("no rule " + std::string(name));
}

std::optional<Truth> closed_form(const DiscreteStepper& rule, const Scene& scene, const crosscheck::Run& run,
                                 std::string* reason = nullptr) {
  try {
    return discrete_truth(rule, scene, run);
  } catch (const Unsupported& e) {
    if (reason) *reason = e.what();
    return std::nullopt;
  }
}

std::string reason(std::string_view rule, const Scene& scene, const crosscheck::Run& run) {
  std::string text;
  closed_form(discrete(rule), scene, run, &text);
  return text;
}

Scene spring(double gamma, double dashpot, double g = 9.81) {
  SceneWriter w;
  w.particle({0, 0, 0}, 1);
  w.particle({0, -1.05, 0}, 0.5, {0, 0.3, 0});
  w.spring(0, 1, 50, 1, dashpot);
  w.pins({0});
  w.gravity({0, -g, 0});
  w.drag(gamma);
  return w.scene(fmt::format("spring with drag {} and dashpot {}", gamma, dashpot), 2, 5e-3, 40);
}

/// Linear shipped scenes, and linear scenes of kinds that are not shipped.
std::vector<Scene> linear_scenes() {
  std::vector<Scene> scenes;
  for (const auto& name : shipped_scene_names()) {
    Scene scene = shipped_scene(std::string(name));
    if (scene.model.find<Rotation>() || linear_scene(scene)) scenes.push_back(std::move(scene));
  }
  EXPECT_EQ(scenes.size(), 4u);  // circle, spring, normal-modes, projectile
  for (const auto& [gamma, dashpot] : {std::pair{3.0, 0.0}, {0.0, 2.0}, {3.0, 2.0}, {20.0, 0.0}, {60.0, 5.0}})
    scenes.push_back(spring(gamma, dashpot));
  for (unsigned seed = 0; scenes.size() < 20; ++seed)
    if (Scene scene = random_exact_scene(seed); !scene.model.particles.move) scenes.push_back(std::move(scene));
  return scenes;
}

/// An implicit rule's solver leaves a residual of 1e-12 of the forces in each step (mysim/implicit/newton.cpp). It is
/// converted to a velocity, and to a position after 1 / omega.
double left_by_solver(const Stepper& s, const Truth& truth, const Scene& scene, const crosscheck::Run& run) {
  if (s.evaluations > 0) return 0;
  const auto linear = linear_scene(scene);
  double slowest = INFINITY, fastest = 0, farthest = 0;
  for (const Mode& m : linear->modes) slowest = std::min(slowest, std::max(std::sqrt(m.omega2), 1 / run.duration));
  for (const Points& v : truth.trajectory.v) fastest = std::max(fastest, largest_column(v));
  for (const Points& x : truth.trajectory.x)
    farthest = std::max(farthest, largest_column(x - truth.trajectory.x.front()));
  const double omega = highest_frequency(scene.model, scene.start), steps = run.duration / time_grid(run).h;
  return 1e-12 * steps * (fastest + time_grid(run).h * (9.81 + omega * omega * farthest)) / slowest;
}

TEST(ExactDiscrete, EveryFixedStepRuleHasARow) {
  for (const Stepper& s : steppers())
    EXPECT_EQ(s.adaptive, std::ranges::none_of(discrete_steppers(), [&](const auto& r) { return r.name == s.name; }))
        << s.name;
  for (const DiscreteStepper& r : discrete_steppers()) EXPECT_EQ(r.of_system != nullptr, stepper(r.name).first_order);
}

TEST(ExactDiscrete, MysimProducesTheClosedFormOfItsRuleOverTime) {
  std::map<std::string_view, int> agreed;
  for (const Scene& scene : linear_scenes())
    for (const DiscreteStepper& rule : discrete_steppers()) {
      SCOPED_TRACE(fmt::format("{} {}", scene.name, rule.name));
      const crosscheck::Run run = default_run(scene);
      const auto truth = closed_form(rule, scene, run);
      if (!truth) continue;
      ++agreed[rule.name];
      Stepper s = stepper(rule.name);
      const double allowed = truth->error_bar + left_by_solver(s, *truth, scene, run);
      EXPECT_LE(sup_distance(trajectory_of(s, scene, run), truth->trajectory), allowed);
      if (s.linear) {  // on linear springs one Newton step solves the equations
        s.step = s.linear;
        EXPECT_LE(sup_distance(trajectory_of(s, scene, run), truth->trajectory), allowed);
      }
      // The error bar must be far below the rule's own error.
      EXPECT_LT(truth->error_bar, 1e-9 * (1 + scene.size()));
    }
  for (const DiscreteStepper& rule : discrete_steppers())
    EXPECT_GE(agreed[rule.name], rule.one_spring ? 8 : 15) << rule.name;
}

/// True if two rules coincide on a scene. One Gauss-Seidel pass over one spring without a dashpot solves the implicit
/// Euler equation. If no force depends on position, leapfrog's mean velocity is the implicit midpoint's.
bool one_and_the_same(const Scene& scene, std::set<std::string_view> pair) {
  using Names = std::set<std::string_view>;
  return (pair == Names{"xpbd", "implicit-euler"} && !scene.model.find<Dashpots>()) ||
         (pair == Names{"leapfrog", "implicit-midpoint"} && !scene.model.find<Springs>());
}

TEST(ExactDiscrete, NoRuleProducesTheClosedFormOfAnother) {
  for (const Scene& scene : linear_scenes()) {
    // long steps, so that high-order rules differ by more than round-off
    crosscheck::Run run = default_run(scene);
    run.step *= 20;
    for (const DiscreteStepper& rule : discrete_steppers()) {
      const auto truth = closed_form(rule, scene, run);
      for (const DiscreteStepper& wrong : discrete_steppers()) {
        if (wrong.name == rule.name || !truth || !closed_form(wrong, scene, run)) continue;
        SCOPED_TRACE(fmt::format("{}: {} for {}", scene.name, wrong.name, rule.name));
        const Stepper s = stepper(wrong.name);
        const double difference = sup_distance(trajectory_of(s, scene, run), truth->trajectory);
        const double error_bar = truth->error_bar + left_by_solver(s, *truth, scene, run);
        if (one_and_the_same(scene, {wrong.name, rule.name}))
          EXPECT_LE(difference, error_bar);
        else
          EXPECT_GT(difference, 100 * error_bar);
      }
    }
  }
}

TEST(ExactDiscrete, FallsToTheExactSolutionWithTheOrderOfTheRule) {
  const Scene scene = spring(1, 0.5);
  const auto exact = exact_solution(scene);
  ASSERT_TRUE(exact);
  for (const DiscreteStepper& rule : discrete_steppers()) {
    SCOPED_TRACE(rule.name);
    auto off = [&](double h) {
      const Truth truth = discrete_truth(rule, scene, {h, 2, 40});
      double worst = 0;
      for (int i = 0; i < truth.trajectory.frames(); ++i)
        worst = std::max(worst, (truth.trajectory.x[i] - exact->at(truth.trajectory.t[i]).x).norm());
      return worst;
    };
    // the next order is smaller by about h omega = 0.0125
    EXPECT_NEAR(slope(off(1.25e-3), off(6.25e-4)), stepper(rule.name).order, 0.05);
  }
}

TEST(ExactDiscrete, FrequencyAndDecayOfOneSpringAreTheTextbooks) {
  const double omega = 10, h = 0.013, z = omega * h;
  const Mode m{omega * omega, 0, 0, 0, 0, 1, 0, {}};
  struct RuleEigenvalue {
    const char* name;
    double angle, decay;  // rad per step, factor per step
  };
  const RuleEigenvalue expected[] = {{"implicit-euler", std::atan(z), 1 / std::sqrt(1 + z * z)},
                                     {"xpbd", std::atan(z), 1 / std::sqrt(1 + z * z)},
                                     {"explicit-euler", std::atan(z), std::sqrt(1 + z * z)},
                                     {"symplectic-euler", 2 * std::asin(z / 2), 1},
                                     {"leapfrog", 2 * std::asin(z / 2), 1},
                                     {"implicit-midpoint", 2 * std::atan(z / 2), 1},
                                     {"trapezoidal", std::atan2(z, 1 - z * z / 2), std::sqrt(1 + std::pow(z, 4) / 4)}};
  for (const RuleEigenvalue& rule : expected) {
    SCOPED_TRACE(rule.name);
    const Eigen::Matrix2d step = discrete(rule.name).of_mode(m, h).topLeftCorner<2, 2>() + Eigen::Matrix2d::Identity();
    const std::complex<double> lambda = eigenvalues(step)[0];
    EXPECT_NEAR(std::abs(std::arg(lambda)) / rule.angle, 1, 10 * eps / z);  // rounding of 1 relative to an angle of z
    EXPECT_NEAR(std::abs(lambda), rule.decay, 10 * eps);
  }
}

TEST(ExactDiscrete, BulletsExplicitWorldIsSymplecticEulerOnTheSpring) {
  const Scene scene = shipped_scene("spring");
  const crosscheck::Run run = default_run(scene);
  const Truth truth = discrete_truth(discrete("symplectic-euler"), scene, run);
  EXPECT_LE(sup_distance(run_and_record("bullet/deformable-explicit", scene, run).trajectory, truth.trajectory),
            truth.error_bar);
  const Truth wrong = discrete_truth(discrete("leapfrog"), scene, run);
  EXPECT_GT(sup_distance(run_and_record("bullet/deformable-explicit", scene, run).trajectory, wrong.trajectory),
            1e6 * wrong.error_bar);
}

TEST(ExactDiscrete, XpbdHangsAMassOnADashpotTooHigh) {
  // For the dashpot, the free step divides the velocity by 1 + h c / m, including the part gained from gravity. In
  // equilibrium the spring therefore carries the weight divided by 1 + h c / m.
  const Scene scene = spring(0, 2);  // 0.5 kg on 50 N/m: exp(-c t / 2m) is 2e-17 after 20 s
  for (const double h : {5e-3, 1e-2}) {
    const crosscheck::Run run{h, 20, 1};
    const double carried = 0.5 * 9.81 / (1 + h * 2 / 0.5);
    const Truth truth = discrete_truth(discrete("xpbd"), scene, run);
    EXPECT_NEAR(truth.trajectory.x.back()(1, 1), -1 - carried / 50, truth.error_bar);
    EXPECT_NEAR(trajectory_of(stepper("xpbd"), scene, run).x.back()(1, 1), -1 - carried / 50, truth.error_bar);
  }
}

TEST(ExactDiscrete, PowersAreThoseOfPlainProducts) {
  const Mode modes[] = {{100, 0, 0, -9.81, 0, 0, 0, {}},
                        {100, 20, 0, 1, 0, 0, 0, {}},  // critical damping: the eigenvalues of rk4 coincide
                        {100, 3, 4, 1, 0, 0, 0, {}},
                        {0, 0, 0, -9.81, 0, 0, 0, {}},  // free fall: all three eigenvalues are 1
                        {0, 0.5, 0, 2, 0, 0, 0, {}}};
  for (const Mode& m : modes)
    for (const DiscreteStepper& rule : discrete_steppers()) {
      const Increment e = rule.of_mode(m, 0.01);
      Increment product = Increment::Zero();
      for (int n = 0; n <= 1000; ++n) {
        if (n < 5 || n % 111 == 0) {
          // Each product rounds all entries by some eps of the largest entry. That entry grows as n in free fall and
          // under a constant push.
          EXPECT_LT((increment_power(e, n) - product).norm(), 10 * eps * (n + 1) * (1 + product.norm()))
              << rule.name << n;
        }
        product = product + e + e * product;
      }
    }
}

TEST(ExactDiscrete, SaysWhereARuleHasNoClosedForm) {
  const crosscheck::Run run{1e-3, 1, 10};
  EXPECT_TRUE(begins(reason("rk4", shipped_scene("pendulum"), run), "the scene is not linear"));
  EXPECT_TRUE(begins(reason("rk4", shipped_scene("chain-link"), run), "the scene is not linear"));
  EXPECT_TRUE(begins(reason("rk4", shipped_scene("bounce"), run), "the scene is not linear"));
  EXPECT_TRUE(begins(reason("xpbd", shipped_scene("normal-modes"), run), "this rule sweeps the springs one by one"));
  EXPECT_TRUE(begins(reason("leapfrog", shipped_scene("circle"), run), "the scene is a first-order system"));
  EXPECT_TRUE(begins(reason("rk4", random_spring(2, false, true), run), "the pins move"));
  // Forward Euler's amplitude grows by (h omega)^2 / 2 per step, i.e. at a rate of 0.5 /s. From 0.1981 m, it reaches
  // the anchor at 1.0981 m after ln(5.54) / 0.5 s = 3.42 s.
  const Scene scene = shipped_scene("spring");
  EXPECT_TRUE(begins(reason("explicit-euler", scene, {0.01, 10, 100}), "at 3.5 s a spring may turn over"));
  EXPECT_EQ(reason("explicit-euler", scene, {0.01, 3.4, 34}), "");
  EXPECT_EQ(reason("implicit-euler", scene, {0.01, 10, 100}), "");
}

}  // namespace
}  // namespace crosscheck
