// Energies and the ledger: exact integrals, a balance that closes to the order of the stepper, contact losses, the
// divergence monitor, and energy conservation by the implicit midpoint rule.

#include <numbers>

#include "mysim/model/system.h"
#include "mysim/run/observers.h"
#include "tests/unit/helpers.h"

namespace crosscheck {

namespace {

using namespace testing_tools;

TEST(Integral, IsExactForCubics) {
  auto f = [](double t) { return 2 - 3 * t + 4 * t * t - 5 * t * t * t; };
  auto whole = [](double t) { return t * (2 + t * (-1.5 + t * (4.0 / 3 - 1.25 * t))); };
  Integral integral;
  const double h = 0.1;
  integral.add(f(0), 0);
  for (int i = 1; i <= 50; ++i) {
    integral.add(f(h * i), h);
    if (i == 1) continue;  // two values do not determine a cubic
    // some roundings of each term; the largest term is 1.25 t^4
    EXPECT_NEAR(integral.value(), whole(h * i), 4 * i * eps * std::max(1.0, 5 * std::pow(h * i, 4)));
  }
}

TEST(Integral, HasOrderFourOnSmoothCurves) {
  auto error = [](int n) {
    Integral integral;
    const double h = 2.0 / n;
    double worst = 0;
    for (int i = 0; i <= n; ++i) {
      integral.add(std::exp(h * i), i ? h : 0);
      if (i >= 3) worst = std::max(worst, std::abs(integral.value() - std::expm1(h * i)));
    }
    return worst;
  };
  EXPECT_NEAR(slope(error(40), error(80)), 4, 0.15);  // the next error term is smaller by a factor of h = 0.05
}

/// Measured order of the energy balance, from a step suited to the stepper and half this step.
double order_of_balance(const Stepper& s, const Scene& scene) {
  // The steps divide the ramp, because the third derivative of the pins' motion jumps at its end.
  const double h = s.order == 1 ? 1.25e-4 : s.order == 2 ? 2.5e-4 : 6.25e-4;
  const double coarse = imbalance(s, scene, {h, 0.5, 10}), fine = imbalance(s, scene, {h / 2, 0.5, 10});
  EXPECT_GT(fine, 1e-13) << "the imbalance is at round-off, so the slope would be noise";
  return slope(coarse, fine);
}
/// Measurable order: the balance's integrals have order 4.
int shown(const Stepper& s) { return std::min(s.order, 4); }

TEST(Ledger, ClosesToTheOrderOfTheStepperUnderDragWindAndMovedPins) {
  for (const Stepper& s : fixed_steppers()) {
    SCOPED_TRACE(s.name);
    // The next error term is smaller by a factor of h times the highest frequency, at most 0.1. For rk4, whose damping
    // has order 5, this term is large.
    EXPECT_NEAR(order_of_balance(s, small_cloth()), shown(s), 0.25);
  }
}

TEST(Ledger, ClosesToTheOrderOfTheStepperUnderDashpotsAndAir) {
  for (const Stepper& s : fixed_steppers()) {
    SCOPED_TRACE(s.name);
    const double order = order_of_balance(s, small_cloth_in_air());
    fmt::print("balance in air, {:18} order {:.3f}\n", s.name, order);
    EXPECT_NEAR(order, shown(s), 0.25);  // as above
  }
}

TEST(Ledger, OfAnAdaptiveRunFollowsItsTolerance) {
  const Scene scene = small_cloth_in_air();
  for (const Stepper& s : steppers()) {
    if (!s.adaptive) continue;
    double before = INFINITY;
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const double residue = imbalance(s, scene, {1e-3, 1, 20, tolerance});
      // ideally the imbalance falls to a hundredth; the ledger's integrals at 1e-3 s add a smaller error
      EXPECT_LT(residue, before / 10);
      before = residue;
    }
  }
}

TEST(Ledger, EveryEntryIsNeeded) {
  const Scene scene = small_cloth();
  Ledger ledger(scene.model, ContactLoss::reported);
  simulate(stepper("rk4"), ContactRule::coulomb, scene, {1e-3, 1, 20}, ledger);
  const double residue = imbalance(stepper("rk4"), scene, {1e-3, 1, 20});
  const LedgerRow& end = ledger.rows().back();
  for (const double entry : {end.drag, end.wind, end.pins}) EXPECT_GT(std::abs(entry), 1e4 * residue);
  EXPECT_EQ(end.contact, 0);
}

TEST(Ledger, ClosesToFirstOrderInContact) {
  // A ball that is dropped on a sphere beside its top lands, loses its normal speed, slides with friction and leaves,
  // under drag.
  const Scene scene = small_scene(std::string("[[particle]]\nposition = [0.3, 1.2, 0]\nmass = 1\n[sphere]\n"
                                              "centre = [0, 0, 0]\nradius = 1\nfriction = 0.1\n[drag]\ngamma = 1\n") +
                                  gravity_text);
  for (const Stepper& s : steppers())
    for (const double h : {1e-3, 1e-4}) {
      SCOPED_TRACE(fmt::format("{} h = {}", s.name, h));
      // The bound is 2 m g d, where d is the distance of one step at the top speed of 5 m/s: m g d for the landing
      // step, and m g d for the lag of an Euler rule.
      EXPECT_LT(imbalance(s, scene, {h, 1, 50}), 2 * 9.81 * 5 * h);
    }
}

TEST(Ledger, ContactLossIsWhatTheRuleTook) {
  const Scene scene = small_scene(std::string("[[particle]]\nposition = [0, 1.2, 0]\nmass = 2\n[sphere]\n"
                                              "centre = [0, 0, 0]\nradius = 1\n") +
                                  gravity_text);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    Ledger ledger(scene.model, ContactLoss::reported);
    const double h = 1e-4;  // s
    simulate(s, ContactRule::coulomb, scene, {h, 1, 10}, ledger);
    // The ball falls 0.2 m and stays: it loses 0.2 m g, with an error of up to m g times the path of the last step (at
    // 2 m/s). The lag of Euler rules in flight and the kick of each resting step add m g (g t h / 2) in the run of 1 s.
    EXPECT_NEAR(ledger.rows().back().contact, 2 * 9.81 * 0.2, 2 * 9.81 * (2 + 9.81 / 2) * h);
  }
}

/// A particle of the given mass (kg) on or above a ball of radius 1 m at the origin.
Scene on_a_ball(double mass, const Vec3& x, const Vec3& v, double friction, double restitution = 0,
                const std::string& more = "") {
  return small_scene(
      fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, {:.17g}]\nmass = {}\n"
                  "velocity = [{}, {}, {}]\n{}[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\n"
                  "friction = {}\nrestitution = {}\n{}",
                  x.x(), x.y(), x.z(), mass, v.x(), v.y(), v.z(), gravity_text, friction, restitution, more));
}

std::vector<LedgerRow> ledger_of(const Stepper& s, const Scene& scene, const crosscheck::Run& run,
                                 ContactRule rule = ContactRule::coulomb) {
  Ledger ledger(scene.model, ContactLoss::reported);
  EXPECT_EQ(simulate(s, rule, scene, run, ledger).verdict, Verdict::ok);
  return ledger.rows();
}

TEST(Ledger, WhatRestsOnABallLosesNothing) {
  const crosscheck::Run run{0.01, 2, 20};
  const double steps = 200, weight = 9.81;  // N, of one kilogram
  const double slope = 20 * std::numbers::pi / 180;
  struct Rest {
    const char* what;
    Scene scene;
    double allowed;  // J
  };
  // bound: impulses m g h times displacements, which are rounded by some ulps of the radius, divided by the step
  const double rounding = 8 * eps * steps * weight;
  const Rest rests[] = {
      {"on the top", on_a_ball(1, {0, 1, 0}, {0, 0, 0}, 0.3), rounding},
      {"with restitution", on_a_ball(1, {0, 1, 0}, {0, 0, 0}, 0, 0.5), rounding},
      // The friction rule uses the normal at the end of the step, which is turned by g h^2 / R. Therefore a part of the
      // displacement g h^2 remains, and the particle creeps in every step.
      {"held by friction on a slope", on_a_ball(1, {std::sin(slope), std::cos(slope), 0}, {0, 0, 0}, 1),
       steps * weight * std::pow(2 * 9.81e-4, 3)},
      {"between two balls",
       on_a_ball(1, {0.6, 0.8, 0}, {0, 0, 0}, 0, 0, "[[sphere]]\ncentre = [1.2, 0, 0]\nradius = 1\n"), rounding},
  };
  for (const Stepper& s : steppers())
    for (const Rest& rest : rests) {
      SCOPED_TRACE(fmt::format("{} {}", s.name, rest.what));
      for (const LedgerRow& row : ledger_of(s, rest.scene, run)) EXPECT_NEAR(row.contact, 0, rest.allowed);
    }
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    // the sticky sphere takes no energy from a resting particle either
    EXPECT_NEAR(ledger_of(s, rests[0].scene, run, ContactRule::sticky).back().contact, 0, rounding);
    // The balance of a resting particle stays constant, except for the kick of one step.
    if (!s.adaptive) {
      const auto rows = ledger_of(s, rests[0].scene, run);
      EXPECT_NEAR(rows.back().balance(), rows.front().balance(), weight * 9.81 * 1e-4);
    }
  }
}

TEST(Ledger, FrictionlessContactTakesNothing) {
  const Scene scene = on_a_ball(1, {0, 1, 0}, {1, 0, 0}, 0);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    // The tolerance covers the rounding of normal impulses over a path of 1 m, from the top until separation.
    EXPECT_NEAR(ledger_of(s, scene, {1e-3, 1, 10}).back().contact, 0, 1000 * 8 * eps * 9.81);
  }
}

/// Energy (J) that friction takes from a block of 1.5 kg at 2 m/s on the top of a ball of 1 km, mu = 0.3, until it
/// stops. With u = theta'^2 the motion is du/dtheta = 2 (g/R) (sin theta - mu cos theta) + 2 mu u
/// (reference/truth/exact/contact.cpp).
double lost_by_the_block() {
  const double mu = 0.3, w = 9.81 / 1000, u0 = 4e-6;
  const double a = w * (4 * mu * mu - 2) / (1 + 4 * mu * mu), b = -6 * mu * w / (1 + 4 * mu * mu), c = u0 - a;
  double low = 0, high = 1e-3;  // rad; the block stops at 0.68 m
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (c * std::exp(2 * mu * middle) + a * std::cos(middle) + b * std::sin(middle) > 0 ? low : high) = middle;
  }
  return 1.5 * (4 / 2. + 9.81 * 1000 * 2 * std::pow(std::sin(low / 2), 2));
}

TEST(Ledger, FrictionOfASlidingBlockIsItsEnergyToTheOrderOfTheRule) {
  Scene scene = on_a_ball(1.5, {0, 1000, 0}, {2, 0, 0}, 0.3);
  scene.model.find<Spheres>()->list[0].radius = 1000;
  const double exact = lost_by_the_block();
  EXPECT_NEAR(exact, 3.003, 5e-4);
  for (const Stepper& s : steppers()) {
    SCOPED_TRACE(s.name);
    auto error = [&](double h) { return ledger_of(s, scene, {h, 1.5, 10}).back().contact - exact; };
    const double coarse = error(2e-3), fine = error(1e-3);
    fmt::print("sliding block, {:18} {:.3g} J at 2 ms, {:.3g} J at 1 ms\n", s.name, coarse, fine);
    const bool new_velocity = s.name == "symplectic-euler" || s.name == "implicit-euler" || s.name == "xpbd";
    // In these rules friction m g mu acts along h v' instead of h (v + v') / 2. In total it takes m g mu h v / 2 less
    // energy, with the initial v = 2 m/s. All others err by the path of the last step, (mu g h)^2 / 2 per kilogram, and
    // by the ball's curvature, which changes the height by (v h)^2 / 2 R in each step, where v^2 is on average a third
    // of its initial value.
    const double lag = new_velocity ? 1.5 * 9.81 * 0.3 * 2 / 2 * 1e-3 : 0;
    const double rest = 1.5 * (std::pow(0.3 * 9.81 * 1e-3, 2) + 9.81 * 0.68 * 2 / 3 / 1000 * 1e-3);
    EXPECT_NEAR(fine, -lag, 2 * rest);
    EXPECT_NEAR(coarse, -2 * lag, 8 * rest);
    if (new_velocity) {
      EXPECT_NEAR(slope(std::abs(coarse), std::abs(fine)), 1, 0.02);
    }
  }
}

TEST(Ledger, ImpactsTakeWhatRestitutionLeaves) {
  // after a fall of 0.2 m, the first bounce loses m g 0.2 (1 - e^2), wherever the impact lies within the step
  for (const double e : {0.0, 0.3, 0.7, 1.0})
    for (const Stepper& s : steppers()) {
      SCOPED_TRACE(fmt::format("{} e = {}", s.name, e));
      const Scene scene = on_a_ball(1, {0, 1.2, 0}, {0, 0, 0}, 0, e);
      auto error = [&](double h) {
        return ledger_of(s, scene, {h, 0.25, 10}).back().contact - 9.81 * 0.2 * (1 - e * e);
      };
      // The bound consists of the lag of Euler rules in flight, m g (g t h / 2), and of a rebound that starts within a
      // step, m g v h.
      for (const double h : {1e-3, 1e-4}) EXPECT_NEAR(error(h), 0, 9.81 * (9.81 * 0.25 / 2 + 2 * e) * h + 1e-12);
    }
}

TEST(Ledger, LossesThatAnEngineDoesNotReportAreInferredAndMarked) {
  const std::string ball = "[[particle]]\nposition = [0, 1.2, 0]\nmass = 2\n" + std::string(gravity_text);
  const Scene free = small_scene(ball), onto = small_scene(ball + "[sphere]\ncentre = [0, 0, 0]\nradius = 1\n");
  EXPECT_FALSE(Ledger(free.model, ContactLoss::inferred).contact_inferred());  // nothing to infer
  EXPECT_FALSE(Ledger(onto.model, ContactLoss::reported).contact_inferred());
  Ledger inferred(onto.model, ContactLoss::inferred), reported(onto.model, ContactLoss::reported);
  ASSERT_TRUE(inferred.contact_inferred());
  simulate(stepper("leapfrog"), ContactRule::coulomb, onto, {1e-4, 1, 10}, reported);
  // simulates an engine that does not call contact()
  struct Mute : Observer {
    explicit Mute(Ledger& l) : ledger(l) {}
    bool every_step() const override { return true; }
    Verdict observe(const State& s, bool sample) override { return ledger.observe(s, sample); }
    Ledger& ledger;
  } mute(inferred);
  simulate(stepper("leapfrog"), ContactRule::coulomb, onto, {1e-4, 1, 10}, mute);
  for (size_t i = 0; i < inferred.rows().size(); ++i) {
    EXPECT_NEAR(inferred.rows()[i].balance(), inferred.rows()[0].balance(), 16 * eps * 40);    // exact, up to 40 J
    EXPECT_NEAR(inferred.rows()[i].contact, reported.rows()[i].contact, 2 * 9.81 * 2 * 1e-4);  // path of a step
  }
}

TEST(Energy, OfAKnownState) {
  const Scene s =
      small_scene(std::string("[[particle]]\nposition = [0, 0, 0]\nmass = 5\n[[particle]]\nposition = [3, 4, 0]\n"
                              "mass = 2\nvelocity = [0, 0, 3]\n[[spring]]\nends = [0, 1]\nstiffness = 10\n"
                              "rest = 4\n[pins]\nparticles = [0]\n") +
                  gravity_text);
  const Energy e = energy_of(s.model, s.start);
  EXPECT_DOUBLE_EQ(e.kinetic, 9);                   // 2 kg at 3 m/s
  EXPECT_DOUBLE_EQ(e.elastic, 5);                   // 10 N/m by 1 m
  EXPECT_DOUBLE_EQ(e.gravitational, 2 * 9.81 * 4);  // pins have no energy
  EXPECT_DOUBLE_EQ(e.total(), e.kinetic + e.elastic + e.gravitational);
}

TEST(DivergenceMonitor, NanIsANan) {
  const Scene s = small_scene("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n");
  for (const double bad : {NAN, INFINITY}) {
    DivergenceMonitor monitor(s.model);
    State state = s.start;
    EXPECT_EQ(monitor.observe(state, true), Verdict::ok);
    state.v(1, 0) = bad;
    EXPECT_EQ(monitor.observe(state, true), Verdict::nan);
  }
}

TEST(DivergenceMonitor, NoGoodRunIsCondemned) {
  for (const auto& name : shipped_scene_names())
    for (const auto method : {"rk4", "leapfrog"}) {
      const Scene scene = shipped_scene(std::string(name));
      if (!takes(stepper(method), scene)) continue;
      SCOPED_TRACE(fmt::format("{} {}", name, method));
      DivergenceMonitor monitor(scene.model);
      const double duration = std::min(scene.duration, 0.3);
      // Uses a step within the limit of both rules, because the scene's own step may be longer.
      const double omega = highest_frequency(scene.model, scene.start);
      const double step = omega > 0 ? std::min(scene.step, 1.5 / omega) : scene.step;
      const Outcome out = simulate(stepper(method), ContactRule::coulomb, scene, {step, duration, 30}, monitor);
      EXPECT_EQ(out.verdict, Verdict::ok);
    }
}

TEST(DivergenceMonitor, ASceneAtRestIsNotCondemnedForItsRounding) {
  // A spring whose rest length equals its length up to rounding moves by 1e-15 m, with energies of 1e-29 J.
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    std::string text;
    const Vec3 ends[] = {random.vector(), random.vector()};
    for (const Vec3& x : ends)
      text += fmt::format("[[particle]]\nposition = [{:.17g}, {:.17g}, {:.17g}]\nmass = 1\n", x.x(), x.y(), x.z());
    const Scene scene = small_scene(
        text + fmt::format("[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = {:.15g}\n", (ends[0] - ends[1]).norm()));
    for (const Stepper& s : steppers()) {
      SCOPED_TRACE(fmt::format("seed {} {}", seed, s.name));
      DivergenceMonitor monitor(scene.model);
      EXPECT_EQ(simulate(s, ContactRule::coulomb, scene, {1e-3, 1, 10}, monitor).verdict, Verdict::ok);
    }
  }
}

TEST(DivergenceMonitor, BlowUpsAreFoundWhetherOrNotTheWindBlowsAndPinsMove) {
  const Scene cloth = small_cloth();
  Scene plain = cloth;
  plain.model.particles.move.reset();
  std::erase_if(plain.model.terms, [](const Term& t) { return std::holds_alternative<Wind>(t); });
  for (const Scene& scene : {cloth, plain})
    for (const Stepper& s : fixed_steppers()) {
      SCOPED_TRACE(s.name);
      DivergenceMonitor monitor(scene.model);
      // omega_max is about sqrt(8 k n / m) = 200 rad/s: h omega = 10 is unstable for every explicit rule
      const Outcome out = simulate(s, ContactRule::coulomb, scene, {0.05, 5, 100}, monitor);
      if (std::isinf(s.limit(200, 2))) {
        // Rules that solve the whole step are stable. One Gauss-Seidel pass leaves residuals in springs, whose energy
        // may look like a blow-up, but no particle moves farther than the fall plus the size of the cloth.
        if (s.evaluations == 0) {
          EXPECT_EQ(out.verdict, Verdict::ok) << out.reason;
        }
        const Trajectory t = trajectory_of(s, scene, {0.05, 5, 100});
        for (const Points& x : t.x) EXPECT_LT(x.cwiseAbs().maxCoeff(), 3);
        continue;
      }
      // The verdict may be stretch: a spring may exceed its allowed length before two differences reveal its speed.
      EXPECT_NE(out.verdict, Verdict::ok);
      EXPECT_LT(out.end, 2);
      EXPECT_FALSE(out.reason.empty());
    }
}

using namespace testing_tools;

double largest_energy_error(const Stepper& s, const Scene& scene, const Run& run) {
  const Trajectory t = trajectory_of(s, scene, run);
  auto energy = [&](int i) { return energy_of(scene.model, {t.t[i], t.x[i], t.v[i]}).total(); };
  double worst = 0;
  for (int i = 0; i < t.frames(); ++i) worst = std::max(worst, std::abs(energy(i) - energy(0)));
  return worst;
}

TEST(ImplicitMidpoint, KeepsTheEnergyOfOneSpringAtAnyStep) {
  const Scene scene = shipped_scene("spring");
  for (const double h : {1e-3, 1e-2, 0.1, 1.0}) {
    const double error = largest_energy_error(stepper("implicit-midpoint"), scene, {h, 5, 5});
    fmt::print("spring, h = {}: energy error {:.2g} J\n", h, error);
    // The residual force of a solve (at most 1e-10 of the largest force) does work along the path of 2 m/s times 5 s.
    // The largest force is the inertia m v / (h/2) or the spring's k x = 30 N.
    EXPECT_LT(error, 1e-10 * (2 * 2 / h + 30) * 2 * 5) << h;
  }
  // in contrast, leapfrog has the same order but does not conserve the energy: its error is a relative (h omega)^2 / 8
  // or more
  EXPECT_GT(largest_energy_error(stepper("leapfrog"), scene, {1e-2, 5, 100}), 1e-3);
}

TEST(ImplicitMidpoint, KeepsTheEnergyOfACollinearChain) {
  // Three masses on a line between two pins; all springs stay stretched and never turn, so the system is linear.
  std::string text;
  const double at[] = {0, 0.62, 1.13, 1.71, 2.4};
  for (const double x : at) text += fmt::format("[[particle]]\nposition = [{}, 0, 0]\nmass = 0.5\n", x);
  for (int i = 0; i < 4; ++i)
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = 0.3\n", i, i + 1, 100 + 30 * i);
  const Scene scene = small_scene(text + "[pins]\nparticles = [0, 4]\n");
  for (const double h : {1e-3, 1e-2, 0.1}) {
    const double error = largest_energy_error(stepper("implicit-midpoint"), scene, {h, 5, 50});
    fmt::print("collinear chain, h = {}: energy error {:.2g} J\n", h, error);
    // bound as above, with 0.5 kg at up to 1 m/s, springs of up to 100 N, and three masses
    EXPECT_LT(error, 3 * 1e-10 * (1 / h + 100) * 5) << h;
  }
}

TEST(ImplicitMidpoint, EnergyOfASwingingChainIsBoundedToOrderTwo) {
  const Scene scene = without_drag(shipped_scene("chain"));
  double before = 0;
  for (const double h : {2e-3, 1e-3, 5e-4}) {
    const double error = largest_energy_error(stepper("implicit-midpoint"), scene, {h, 3, 300});
    fmt::print("swinging chain, h = {}: energy error {:.3g} J\n", h, error);
    // samples may miss the maximum, at another phase for each step; the measured slopes were 2.0 to 2.1
    if (before > 0) {
      EXPECT_NEAR(slope(before, error), 2, 0.3);
    }
    before = error;
  }
  EXPECT_GT(before, 1e-7);  // the energy is not conserved exactly, because rotating springs are not linear
}

}  // namespace
}  // namespace crosscheck
