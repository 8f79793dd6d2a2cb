// Stability limits of whole scenes: spectra are compared with closed forms and with the Jacobian of the code, and runs
// are stable just below the predicted limit and fail just above it.

#include "experiments/stability/limit.h"
#include "experiments/stability/margin.h"
#include "experiments/stability/stability.h"
#include "mysim/eigenvalues.h"
#include "mysim/model/system.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/mysim/declared.h"
#include "tests/unit/mysim/networks.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Four masses below a pin on a vertical line of springs, with drag.
Scene vertical_chain(double gamma) {
  std::string text = gravity_text;
  for (int i = 0; i <= 4; ++i) text += fmt::format("[[particle]]\nposition = [0, {}, 0]\nmass = 0.2\n", -0.5 * i);
  for (int i = 0; i < 4; ++i)
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = 80\nrest = 0.5\n", i, i + 1);
  text += "[pins]\nparticles = [0]\n";
  if (gamma > 0) text += fmt::format("[drag]\ngamma = {}\n", gamma);
  return small_scene(text);
}

std::vector<double> frequencies(const Spectrum& s) {
  std::vector<double> all;
  for (const Vibration& v : s.modes) all.push_back(v.omega);
  return all;
}

TEST(Spectrum, OfAStretchedChainIsItsClosedForm) {
  const BaseState base = base_state_of(load_scene("normal-modes"));
  ASSERT_TRUE(base.at_rest);
  std::vector<double> expected;
  for (int i = 1; i <= 8; ++i) {
    const double sine = 2 * std::sin(i * M_PI / 18);
    expected.push_back(std::sqrt(100 / 0.1) * sine);  // longitudinal
    for (int side : {0, 1})
      (void)side, expected.push_back(std::sqrt(2.5 / 0.275 / 0.1) * sine);  // transverse: tension divided by length
  }
  std::sort(expected.begin(), expected.end());
  const auto found = frequencies(base.spectrum);
  ASSERT_EQ(found.size(), expected.size());
  // Accelerations at the equilibrium are at most 1e-11 of what the springs could exert: 2e-8 m/s^2. In the slowest mode
  // (11 / s^2), this displaces by 2e-9 m: 1e-7 of the stretch and of the tension, and half of that in frequencies.
  for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-7 * expected.back());
}

/// Eigenvalues of the Jacobian of the code, which is found by central differences of accelerations.
Eigen::VectorXcd rates_by_differences(const Scene& scene) {
  System f(scene.model);
  const Linearised l = linearised(scene.model, scene.start);
  const int n = l.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  constexpr double d = 1e-5;
  for (int j = 0; j < 2 * n; ++j) {
    Points side[2];
    for (const int s : {0, 1}) {
      State state = scene.start;
      Points& moved = j < n ? state.x : state.v;
      moved(l.free[j % n] % 3, l.free[j % n] / 3) += s == 0 ? d : -d;
      side[s].resize(3, state.x.cols());
      f.acceleration(state, side[s]);
    }
    for (int i = 0; i < n; ++i)
      a(n + i, j) = (side[0](l.free[i] % 3, l.free[i] / 3) - side[1](l.free[i] % 3, l.free[i] / 3)) / (2 * d);
  }
  return eigenvalues(a);
}

/// A net at rest whose drag rates differ and whose structural springs are damped, so that damping and stiffness have no
/// common modes.
Scene mixed_net() {
  Scene scene = small_scene(std::string("[grid]\nsize = [3, 3]\norigin = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, 1]\n"
                                        "mass = 0.9\n[grid.stiffness]\nstructural = 100\nshear = 60\nbend = 40\n"
                                        "[pins]\nparticles = [0, 2]\n") +
                            gravity_text);
  Eigen::VectorXd c(9);
  for (int i = 0; i < 9; ++i) c[i] = 0.1 + 0.05 * i;
  scene.model.terms.emplace_back(Drag{c});
  Dashpots dashpots;
  for (const Spring& s : scene.model.find<Springs>()->list)
    if (s.family == Family::structural) dashpots.list.push_back({s.a, s.b, 0.3});
  scene.model.terms.emplace_back(dashpots);
  return scene;
}

TEST(Spectrum, OfMixedDampingHasTheRatesOfTheCode) {
  const BaseState base = base_state_of(mixed_net());
  ASSERT_TRUE(base.at_rest);
  EXPECT_FALSE(base.spectrum.commuting);
  const Eigen::VectorXcd rates = rates_by_differences(base.scene);
  for (const std::complex<double> z : rates) {
    double nearest = INFINITY;
    for (const Vibration& v : base.spectrum.modes)
      nearest = std::min(nearest, std::hypot(v.omega - std::abs(z), v.gamma + 2 * z.real()));
    // Accelerations of thousands of m/s^2 are differenced over 1e-5 m; these differences include third derivatives.
    EXPECT_LT(nearest, 1e-4 * base.spectrum.omega) << z.real() << " + " << z.imag() << " i";
  }
}

TEST(Spectrum, LanczosFindsTheEndsOfTheDenseSpectrum) {
  const BaseState base = base_state_of(with_grid("cloth-hang", 13));
  ASSERT_TRUE(base.at_rest);
  ASSERT_FALSE(base.spectrum.complete);
  const Eigen::VectorXd dense = symmetric_eigenvalues(Eigen::MatrixXd(base.spectrum.system.k));
  const auto found = frequencies(base.spectrum);
  EXPECT_NEAR(found.back(), std::sqrt(dense.tail(1)[0]), 1e-6 * found.back());
  EXPECT_NEAR(found.front(), std::sqrt(dense[0]), 1e-4 * found.front());
}

/// Spectral radius of one step of the code, which is linearised about the state by central differences.
double step_radius(const Stepper& rule, const Scene& scene, double h) {
  const Linearised l = linearised(scene.model, scene.start);
  const int n = l.size();
  constexpr double d = 1e-6;
  Eigen::MatrixXd a(2 * n, 2 * n);
  const double unit = 1 / h;  // velocities are measured in displacements per step
  for (int j = 0; j < 2 * n; ++j) {
    State side[2] = {scene.start, scene.start};
    for (const int s : {0, 1}) {
      (j < n ? side[s].x : side[s].v)(l.free[j % n] % 3, l.free[j % n] / 3) += (s == 0 ? d : -d) * (j < n ? 1 : unit);
      System f(scene.model);
      Workspace w(side[s]);
      rule.step(f, side[s], h, w);
    }
    for (int i = 0; i < n; ++i) {
      const int axis = l.free[i] % 3, particle = l.free[i] / 3;
      a(i, j) = (side[0].x(axis, particle) - side[1].x(axis, particle)) / (2 * d);
      a(n + i, j) = (side[0].v(axis, particle) - side[1].v(axis, particle)) / (2 * d * unit);
    }
  }
  return eigenvalues(a).cwiseAbs().maxCoeff();
}

TEST(PredictedLimit, OfMixedDampingIsWhereTheStepMatrixTurnsUnstable) {
  const BaseState base = base_state_of(mixed_net());
  int finite = 0;
  for (const Stepper& rule : fixed_steppers()) {
    SCOPED_TRACE(rule.name);
    const PredictedLimit p = predicted_limit(rule, base.spectrum);
    EXPECT_EQ(p.missing, "");
    if (!std::isfinite(p.limit)) continue;
    ++finite;
    ASSERT_GT(p.limit, 0);
    // Differences are accurate to about 1e-9, and coincident eigenvalues to the square root of this.
    EXPECT_LE(step_radius(rule, base.scene, 0.98 * p.limit), 1 + 1e-4);
    EXPECT_GT(step_radius(rule, base.scene, 1.02 * p.limit), 1 + 1e-4);
  }
  EXPECT_EQ(finite, 7);
}

TEST(PredictedLimit, SaysWhyWhereThereIsNone) {
  Scene net = with_grid("cloth-hang", 8);
  Eigen::VectorXd c = net.model.find<Drag>()->c;
  c[20] *= 3;
  net.model.find<Drag>()->c = c;
  const BaseState base = base_state_of(net);
  EXPECT_TRUE(contains(predicted_limit(stepper("suzuki4"), base.spectrum).missing, "different modes"));
  EXPECT_EQ(predicted_limit(stepper("symplectic-euler"), base.spectrum).missing, "");
}

TEST(PredictedLimit, OfFastRatesAloneIsToldWhereTheyBind) {
  Scene net = with_grid("cloth-hang", 9);  // 237 free coordinates
  net.model.find<Drag>()->c[20] *= 3;
  const BaseState base = base_state_of(net);
  ASSERT_FALSE(base.spectrum.complete || base.spectrum.commuting);
  // These rules are limited by the mode with the least damping relative to its stiffness, which need not be among the
  // four fastest rates.
  for (const char* rule : {"explicit-euler", "trapezoidal", "dopri5"})
    EXPECT_TRUE(contains(predicted_limit(stepper(rule), base.spectrum).missing, "only the fastest rates")) << rule;
  const PredictedLimit p = predicted_limit(stepper("rk4"), base.spectrum);
  EXPECT_EQ(p.missing, "");
  EXPECT_NEAR(p.limit * base.spectrum.omega, 2.83, 0.12 * 2.83);
}

TEST(PredictedLimit, IsMissingWhereEigenvaluesAreNotFound) {
  Spectrum s = base_state_of(mixed_net()).spectrum;
  s.system.k.coeffRef(0, 0) = NAN;
  EXPECT_TRUE(contains(predicted_limit(stepper("symplectic-euler"), s).missing, "was not found"));
}

TEST(PredictedLimit, OfBulletIsItsRulesUnlessItSolvesDashpots) {
  const Method bullet = find_method("bullet/deformable-explicit");
  Scene net = mixed_net();
  EXPECT_TRUE(contains(predicted_limit(bullet, base_state_of(net).spectrum).missing, "dashpots implicitly"));
  EXPECT_TRUE(
      std::isinf(predicted_limit(find_method("bullet/deformable-implicit+tight"), base_state_of(net).spectrum).limit));
  std::erase_if(net.model.terms, [](const Term& t) { return std::holds_alternative<Dashpots>(t); });
  const Spectrum without = base_state_of(net).spectrum;
  EXPECT_EQ(predicted_limit(bullet, without).limit, predicted_limit(stepper("symplectic-euler"), without).limit);
}

TEST(PredictedLimit, BelongsToTheRuleThatAMethodFollows) {
  EXPECT_EQ(stepper_of(find_method("bullet/deformable-explicit"))->name, "symplectic-euler");
  EXPECT_EQ(stepper_of(find_method("odeint/rk4"))->name, "rk4");
  EXPECT_EQ(stepper_of(find_method("mysim/implicit-euler+linear"))->name, "implicit-euler");
  EXPECT_EQ(stepper_of(find_method("bullet/pbd")), nullptr);
  EXPECT_EQ(stepper_of(find_method("bullet/deformable-implicit")), nullptr);
}

TEST(LargestStep, IsBracketedFromBothSides) {
  for (const double limit : {1e-3, 0.3, 1.0, 2.5, 40.0}) {
    const MeasuredLimit m = largest_step([&](double h) { return h <= limit; }, 1, 1e-4, 100, 0.001);
    EXPECT_EQ(m.kind, MeasuredLimit::found);
    EXPECT_LE(m.held, limit);
    EXPECT_GT(m.failed, limit);
    EXPECT_LE(m.failed / m.held, 1.001);
  }
  EXPECT_EQ(largest_step([](double) { return true; }, 1, 1e-4, 100, 0.01).kind, MeasuredLimit::every_step);
  EXPECT_EQ(largest_step([](double) { return false; }, 1, 1e-4, 100, 0.01).kind, MeasuredLimit::no_step);
}

/// All fixed-step methods of mysim with a linear limit, and other methods that follow one of their rules.
std::vector<Method> methods_with_limits() {
  std::vector<Method> methods;
  for (Method& m : all_methods())
    if (const Stepper* rule = stepper_of(m);
        rule && !m.adaptive && std::isfinite(rule->limit(1, 0)) && !m.name.starts_with("bullet32"))
      methods.push_back(std::move(m));
  return methods;
}

TEST(MeasuredLimit, OnLinearScenesHoldsTwoPerCentBelowAndFailsTwoPerCentAbove) {
  int tried = 0;
  for (const Scene& scene : {load_scene("spring"), with_drag(load_scene("spring"), 2), load_scene("normal-modes"),
                             with_drag(load_scene("normal-modes"), 5), vertical_chain(0), vertical_chain(3)}) {
    const BaseState base = base_state_of(scene);
    ASSERT_TRUE(base.at_rest);
    for (const Method& method : methods_with_limits()) {
      SCOPED_TRACE(fmt::format("{} on {} {}", method.name, scene.name, scene.model.terms.size()));
      const PredictedLimit p = predicted_limit(*stepper_of(method), base.spectrum);
      if (p.limit == 0) continue;
      ++tried;
      EXPECT_TRUE(run_perturbed(method, base, 0.98 * p.limit, 2000, {p.mode}).held());
      const PerturbedRun above = run_perturbed(method, base, 1.02 * p.limit, 2000, {p.mode});
      EXPECT_FALSE(above.held()) << name_of(above.verdict) << ", growth " << above.growth;
    }
  }
  EXPECT_EQ(tried, 3 * 6 + 3 * 8);  // without drag explicit Euler and trapezoidal have no stable step
}

/// Growth due to rounding in single precision does not count.
TEST(MeasuredLimit, OfSinglePrecisionIsThePredictedOneToTwoPerCent) {
  const BaseState base = base_state_of(load_scene("chain-link"));
  const Method single = find_method("bullet32/deformable-explicit");
  const PredictedLimit p = predicted_limit(single, base.spectrum);
  ASSERT_GT(p.limit, 0);
  EXPECT_TRUE(run_perturbed(single, base, 0.98 * p.limit, 1000, {p.mode}).held());
  EXPECT_FALSE(run_perturbed(single, base, 1.02 * p.limit, 1000, {p.mode}).held());
}

TEST(MeasuredLimit, IsThePredictedOneToOnePerCent) {
  for (const Scene& scene : {with_drag(load_scene("spring"), 2), with_drag(load_scene("normal-modes"), 5)}) {
    const BaseState base = base_state_of(scene);
    for (const Method& method : methods_with_limits()) {
      if (!method.stepper) continue;  // methods without a stepper of mysim are tested above
      SCOPED_TRACE(fmt::format("{} on {}", method.name, scene.name));
      const PredictedLimit p = predicted_limit(*method.stepper, base.spectrum);
      const MeasuredLimit m = measured_limit(method, base, 1000, {p.mode}, 0.005);
      ASSERT_EQ(m.kind, MeasuredLimit::found);
      EXPECT_NEAR(m.limit() / p.limit, 1, 0.01);
    }
  }
}

TEST(MeasuredLimit, OfAKilogramOnASpringIsThatOfTheRuleWhereverTheSearchBegins) {
  const std::string text =
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1.1, 0, 0]\nmass = 1\n[[spring]]\nends "
      "= [0, 1]\nstiffness = 100\nrest = 1\n[pins]\nparticles = [0]\n";
  for (const double begin : {1e-3, 0.037, 0.3}) {
    const BaseState base = base_state_of(small_scene(text, 1, begin));
    for (const char* name : {"leapfrog", "symplectic-euler", "suzuki4", "rk4"}) {
      SCOPED_TRACE(fmt::format("{} from {} s", name, begin));
      const MeasuredLimit m = measured_limit(find_method(name), base, 4000, {}, 0.002);
      ASSERT_EQ(m.kind, MeasuredLimit::found);
      EXPECT_NEAR(m.limit() / (stepper(name).limit(10, 0)), 1, 0.01);
      // the search must not start at the theoretical limit, which it would then find exactly
      EXPECT_LT(m.held, stepper(name).limit(10, 0));
    }
  }
}

TEST(Equilibrium, ThatIsASaddleIsLeftForTheRestBesideIt) {
  // An upright cloth that hangs from two corners: the springs between the corners are compressed in the plane of the
  // cloth.
  const Scene cloth = small_scene(
      std::string("[grid]\nsize = [6, 7]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, -1, 0]\nmass = 0.25\n"
                  "[grid.stiffness]\nstructural = 200\nshear = 200\nbend = 200\n[pins]\nparticles = [0, 5]\n") +
      gravity_text);
  // a mass balanced on top of its spring
  const Scene upright = small_scene(
      std::string("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, 1, 0]\nmass = 1\n"
                  "[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 1\n[pins]\nparticles = [0]\n") +
      gravity_text);
  for (const Scene& scene : {cloth, upright}) {
    const BaseState base = base_state_of(scene);
    EXPECT_TRUE(base.saddle);
    ASSERT_TRUE(base.at_rest);
    EXPECT_TRUE(contains(saddle_note(base), "is an unstable saddle"));
    const Eigen::VectorXd squares = symmetric_eigenvalues(Eigen::MatrixXd(base.spectrum.system.k));
    EXPECT_GT(squares[0], -1e-8 * squares[squares.size() - 1]);
    // the measured limit agrees with theory at the neighbouring equilibrium
    const MeasuredLimit m = measured_limit(find_method("leapfrog"), base, 1000, {}, 0.005);
    ASSERT_EQ(m.kind, MeasuredLimit::found);
    EXPECT_NEAR(m.limit() * base.spectrum.omega, 2, 0.02);
  }
  EXPECT_FALSE(base_state_of(load_scene("cloth-hang")).saddle);
}

TEST(Outlook, TellsSmallMarginsAndCertainGrowth) {
  // Springs that are stretched far act across their lines, too, so that `far` has the smallest limit. The warning
  // begins within a tenth of this limit.
  const Scene net = with_grid("cloth-hang", 5);
  Scene free = net;
  std::erase_if(free.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  Scene far = free;
  for (Spring& s : far.model.find<Springs>()->list) s.rest *= 1e-6;
  const double limit = 2 / highest_frequency(far.model, far.start);
  const Method leapfrog = find_method("leapfrog");
  EXPECT_EQ(stability_warning(leapfrog, free, 0.85 * limit), "");
  EXPECT_TRUE(
      begins(stability_warning(leapfrog, free, 0.95 * limit), "small margin: the step is 95 % of what is stable"));
  const std::string growth = stability_warning(find_method("explicit-euler"), free, 0.1 * limit);
  EXPECT_TRUE(begins(growth, "no step of explicit-euler is stable here"));
  for (const char* name : {"implicit-euler", "xpbd", "dopri5", "bullet/pbd"})
    EXPECT_EQ(stability_warning(find_method(name), free, 10 * limit), "") << name;
}

TEST(MeasuredLimit, WithoutDragTwoRulesHaveNoStableStepAndGrowAsTheFormulaSays) {
  for (const char* name : {"spring", "normal-modes"}) {
    const BaseState base = base_state_of(load_scene(name));
    const int mode = static_cast<int>(base.spectrum.modes.size()) - 1;
    const double omega = base.spectrum.omega;
    for (const char* rule : {"explicit-euler", "trapezoidal"}) {
      SCOPED_TRACE(fmt::format("{} on {}", rule, name));
      const Method method = find_method(rule);
      EXPECT_EQ(predicted_limit(stepper(rule), base.spectrum).limit, 0);
      EXPECT_EQ(measured_limit(method, base, 2000, {mode}, 0.01).kind, MeasuredLimit::no_step);
      for (const double z : {0.1, 0.3}) {
        const double expected = method.stepper->order == 1 ? std::sqrt(1 + z * z) : std::sqrt(1 + z * z * z * z / 4);
        const PerturbedRun trial = run_perturbed(method, base, z / omega, 200, {mode});
        // Errors: rounding of 1e-16 m relative to a kick of 1.5e-8 of a spring, accumulated over two hundred steps; and
        // the nonlinearity of the kick.
        EXPECT_NEAR(std::log(trial.per_step) / std::log(expected), 1, 1e-2);
      }
    }
    EXPECT_EQ(measured_limit(find_method("leapfrog"), base, 1000, {mode}, 0.1).kind, MeasuredLimit::found);
  }
}

TEST(MeasuredLimit, ImplicitRulesHaveNone) {
  // With springs that pull against each other, one Gauss-Seidel pass settles next to the equilibrium; this is not
  // growth.
  for (const char* scene : {"spring", "normal-modes"}) {
    const BaseState base = base_state_of(load_scene(scene));
    for (const char* rule : {"implicit-euler", "implicit-midpoint", "xpbd", "implicit-euler+linear"})
      EXPECT_EQ(measured_limit(find_method(rule), base, 300, {}, 0.1).kind, MeasuredLimit::every_step)
          << rule << " on " << scene;
  }
}

TEST(MeasuredLimit, OfWhatAMethodCannotTakeIsItsReason) {
  const MeasuredLimit m = measured_limit(find_method("leapfrog"), base_state_of(load_scene("circle")), 100, {}, 0.1);
  EXPECT_EQ(m.kind, MeasuredLimit::unsupported);
  EXPECT_TRUE(begins(m.reason, "the scene is a first-order system"));
}

TEST(MeasuredLimit, EndsAtARefusalOnlyWhereThatComesFirst) {
  const BaseState base = base_state_of(load_scene("spring"));
  const double limit = predicted_limit(stepper("leapfrog"), base.spectrum).limit;
  for (const double refused : {0.7 * limit, 1.3 * limit}) {
    const MeasuredLimit m = measured_limit(refusing_above(refused), base, 300, {}, 0.1);
    EXPECT_EQ(m.kind, refused < limit ? MeasuredLimit::refused_above : MeasuredLimit::found);
    EXPECT_LT(m.held, std::min(refused, limit));
    EXPECT_GT(m.held, std::min(refused, limit) / 1.1);
    // If the search ends at the limit before it reaches refused steps, the reason mentions no refusal.
    EXPECT_EQ(m.reason.ends_with(" s has no answer: too long"), refused < limit) << m.reason;
  }
}

TEST(MeasuredLimit, OfAProgramThatDiesIsNone) {
  Method dying = find_method("leapfrog");
  for (const Verdict verdict : {Verdict::crash, Verdict::timeout}) {
    dying.engine = [verdict](const Scene&, const crosscheck::Run&, Observer&) {
      Outcome out;
      out.verdict = verdict;
      out.reason = "it lacks a library";
      return out;
    };
    const MeasuredLimit m = measured_limit(dying, base_state_of(load_scene("spring")), 300, {}, 0.1);
    EXPECT_EQ(m.kind, MeasuredLimit::unsupported) << "must not be reported as 'no stable step'";
    EXPECT_EQ(m.reason, "it lacks a library");
  }
}

TEST(MeasuredLimit, OfARotationIsSeenInTheFactorOfEachStep) {
  const BaseState base = base_state_of(load_scene("circle"));
  for (const char* rule : {"explicit-euler", "trapezoidal"})
    EXPECT_EQ(measured_limit(find_method(rule), base, 4000, {0}, 0.01).kind, MeasuredLimit::no_step) << rule;
  const PerturbedRun slow = run_perturbed(find_method("trapezoidal"), base, 1. / 16, 4000, {0});
  ASSERT_TRUE(slow.of_mode);
  // the growth is 1.9e-6 per step, up to the rounding of |x| in each of 4000 steps
  EXPECT_NEAR(slow.per_step - 1, std::sqrt(1 + std::pow(16., -4) / 4) - 1, 1e-12);
  const MeasuredLimit rk4 = measured_limit(find_method("rk4"), base, 1000, {0}, 0.002);
  EXPECT_EQ(rk4.kind, MeasuredLimit::found);
  EXPECT_NEAR(rk4.limit(), std::sqrt(8), 0.01 * std::sqrt(8));
}

TEST(Kicks, AreBesideTheShortestSpringThatHasALength) {
  // a particle on a spring, and another particle at the same position, attached by a spring of zero length
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.5, 0, 0]\nmass = 1\n"
      "[[particle]]\nposition = [0.5, 0, 0]\nmass = 1\n[[spring]]\nends = [0, 1]\nstiffness = 100\n"
      "[[spring]]\nends = [1, 2]\nstiffness = 100\nrest = 0\n[pins]\nparticles = [0]\n");
  const BaseState base = base_state_of(scene);
  EXPECT_DOUBLE_EQ(base.spacing, 0.5);
  EXPECT_GT((perturbed_scene(base, {}).start.x - base.scene.start.x).norm(), 0);
}

TEST(MeasuredLimit, OfASceneWithoutRestIsHeldAgainstTheTruthOnBothSides) {
  // Two masses on a slightly stretched spring fall on a ball. By the limit 2 / omega = 2 / sqrt(2 k / m), leapfrog is
  // stable up to 14 ms.
  Scene scene = small_scene(std::string("[[particle]]\nposition = [0, 1.1, 0]\nmass = 0.1\n[[particle]]\n"
                                        "position = [0.501, 1.1, 0]\nmass = 0.1\n[[spring]]\nends = [0, 1]\n"
                                        "stiffness = 1000\nrest = 0.5\n[sphere]\ncentre = [0, 0, 0]\nradius = 1\n"
                                        "margin = 0.02\nfriction = 0.3\n") +
                                gravity_text,
                            0.3, 1e-3, 10);
  scene.window = 0.3;
  TableSet tables;
  add_limit(scene, find_method("leapfrog"), {400, 0.01}, tables);
  const auto rows = rows_of<LimitRow>(*tables.table("stability"));
  ASSERT_EQ(rows.size(), 1u);
  const LimitRow& row = rows[0];
  EXPECT_EQ(row.state, LimitState::start);
  ASSERT_TRUE(row.error_below && row.error_above);
  EXPECT_LE(*row.step_below, *row.held);
  EXPECT_GE(*row.step_above, *row.failed);
  for (const double step : {*row.step_below, *row.step_above})
    EXPECT_NEAR(0.03 / step, std::round(0.03 / step), 1e-9) << "the step must divide the sampling interval";
  fmt::print("pair on a ball: {:.3g} of the motion below, {:.3g} above\n", *row.error_below / *row.motion,
             *row.error_above / *row.motion);
  EXPECT_GT(*row.error_below, *row.truth_bar);
  EXPECT_LT(*row.error_below, 0.1 * *row.motion);
  EXPECT_GT(*row.error_above, 0.1 * *row.motion);
  // for scenes with an equilibrium, theory suffices
  TableSet of_rest;
  add_limit(vertical_chain(0), find_method("leapfrog"), {400, 0.01}, of_rest);
  EXPECT_FALSE(rows_of<LimitRow>(*of_rest.table("stability"))[0].error_below);
}

}  // namespace
}  // namespace crosscheck
