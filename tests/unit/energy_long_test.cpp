// Energy over long runs: what the ledger of many steps says, what rules damp by theory, which parts are exact.
#include "experiments/long_ledger.h"
#include "experiments/numerical_damping.h"
#include "experiments/scenes.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

LongRun long_run(const std::string& method, const Scene& scene, double step, int steps) {
  const Method m = find_method(method);
  LongLedger ledger(scene.model, m.contact, 5);
  const Outcome out = run_method(m, scene, {step, step * steps, 20}, {&ledger});
  EXPECT_EQ(out.verdict, Verdict::ok) << method << out.reason;
  return summary_of(ledger.rows());
}

TEST(LongLedger, SeesEveryStepAndKeepsFewRows) {
  const Scene scene = small_cloth_in_air();
  Ledger all(scene.model, ContactLoss::reported);
  LongLedger few(scene.model, ContactLoss::reported, 100);
  const crosscheck::Run run{1e-3, 1, 10};
  run_method(find_method("leapfrog"), scene, run, {&all, &few});
  EXPECT_LT(few.rows().size(), 80u);
  EXPECT_EQ(few.rows()[1].t, 1e-3);  // the first states are there
  size_t met = 0;
  for (const LedgerRow& row : all.rows())
    for (const LedgerRow& other : few.rows())
      if (row.t == other.t) {
        ++met;
        EXPECT_EQ(row.balance(), other.balance());
        EXPECT_EQ(row.dashpots, other.dashpots);
      }
  EXPECT_EQ(met, all.rows().size());
  const LedgerRow& end = all.rows().back();
  EXPECT_GT(end.drag, 0);
  EXPECT_GT(end.dashpots, 0);
  EXPECT_EQ(end.dissipated(), end.drag + end.dashpots);
}

TEST(LongRun, TellsDriftFromOscillation) {
  std::vector<LedgerRow> drifting, swinging;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.1 * i, kinetic = 2;
    drifting.push_back({t, {kinetic, -3e-3 * t, 0}, 0, 0, 0, 0, 0});
    swinging.push_back({t, {kinetic, 0.5 * std::sin(2 * t), 0}, 0, 0, 0, 0, 0});
  }
  const LongRun a = summary_of(drifting), b = summary_of(swinging);
  EXPECT_NEAR(a.drift, -3e-3, 1e-12);  // a straight line, but for rounding of 2 J
  EXPECT_LT(a.oscillation, 1e-6);      // the root of the rounding of r^2
  EXPECT_NEAR(a.growth, 1, 1e-12);
  EXPECT_NEAR(a.equivalent_drag, 0.3 / (2 * 2 * 100), 1e-12);    // 0.3 J of 2 K over 100 s
  EXPECT_LT(std::abs(b.drift), 0.5 * 6 / (2 * 100 * 100.) * 2);  // a sine's slope is at most 6 A / (omega T^2)
  EXPECT_NEAR(b.oscillation, 0.5 / std::sqrt(2), 0.01);
  EXPECT_LT(b.growth, 0.01);
  EXPECT_NEAR(b.worst, 0.5, 0.01);
}

TEST(NumericalDamping, IsWhatTheStabilityFunctionSays) {
  EXPECT_DOUBLE_EQ(*damping_by_theory(find_method("implicit-euler"), 0.1, 10), std::log(2) / 0.1);
  EXPECT_EQ(*damping_by_theory(find_method("leapfrog"), 0.1, 10), 0);
  EXPECT_LT(*damping_by_theory(find_method("explicit-euler"), 0.01, 10), 0);  // it makes energy
  EXPECT_FALSE(damping_by_theory(find_method("dopri5"), 0.1, 10));            // has no step
  int damped = 0;
  for (const auto name : {"explicit-euler", "trapezoidal", "rk4", "symplectic-euler", "leapfrog", "suzuki4",
                          "implicit-euler", "implicit-euler+linear", "implicit-midpoint", "xpbd",
                          "bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd"})
    for (const double h : {0.01, 0.05}) {
      SCOPED_TRACE(fmt::format("{} h = {}", name, h));
      const Method method = find_method(name);
      const auto found = measured_damping(method, h, 400);
      const auto theory = damping_by_theory(method, h, 10);
      ASSERT_TRUE(found.rate && theory);
      if (*theory == 0) {
        // the slope through an oscillation of ln(E) by at most h omega, over the run
        EXPECT_LT(std::abs(*found.rate), 6 * 10 * h / (400 * h));
        continue;
      }
      ++damped;
      // rounding of 1e-13 of 1 mm and solves to 1e-10 of the forces; the link of the position-based world is stiffer
      // than Hooke's by half the strain, of 1e-3
      const bool linked = std::string(name) == "bullet/pbd";
      EXPECT_NEAR(*found.rate, *theory, (linked ? 5e-4 : 1e-7) * std::abs(*theory) + 1e-10);
    }
  EXPECT_EQ(damped, 2 * 8);
}

TEST(LongEnergy, SymplecticRulesDoNotDrift) {
  for (const auto name : {"spring", "pendulum"}) {
    const Scene scene = load_scene(name);
    for (const auto method : {"symplectic-euler", "leapfrog", "suzuki4", "bullet/deformable-explicit"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, method));
      const LongRun r = long_run(method, scene, 2e-3, 20000);
      EXPECT_LT(r.growth, 0.05);  // a maximum that is met again is met a little better
      EXPECT_LT(std::abs(r.drift) * 40, 0.1 * r.worst);
    }
    for (const auto method : {"trapezoidal", "rk4"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, method));
      EXPECT_NEAR(long_run(method, scene, 2e-3, 20000).growth, 1, 0.05);  // in proportion to time
    }
  }
}

TEST(LongEnergy, ImplicitMidpointKeepsItWhereForcesAreLinear) {
  for (const auto name : {"spring", "normal-modes"})
    for (const double h : {1e-3, 1e-2}) {
      const Scene scene = load_scene(name);
      const int steps = 5000;
      const LongRun exact = long_run("implicit-midpoint", scene, h, steps);
      fmt::print("{} h = {}: residual {:.2g} of the energy per step\n", name, h,
                 exact.worst / exact.turned_over / steps);
      EXPECT_LT(exact.worst, 1e-12 * exact.turned_over * steps);
      // the other side: a rule of the same order that is not exact
      EXPECT_GT(long_run("leapfrog", scene, h, steps).worst, 100 * exact.worst);
    }
}

TEST(LongEnergy, KineticAndGravityWorkAreExactInEveryScheme) {
  // half m (v1^2 - v0^2) = m (v1 - v0) . (v1 + v0) / 2, and m g . (x1 - x0), whatever the rule did in between
  struct Discrete : Observer {
    explicit Discrete(const Scene& s) : scene(s) {}
    bool every_step() const override { return true; }
    Verdict observe(const State& s, bool) override {
      const Energy now = energy_of(scene.model, s);
      if (before.x.cols() > 0) {
        double kinetic = 0, gravity = 0;
        for (int i = 0; i < s.x.cols(); ++i) {
          if (scene.model.particles.pinned[i]) continue;
          const double m = scene.model.particles.mass[i];
          kinetic += m * (s.v.col(i) - before.v.col(i)).dot(s.v.col(i) + before.v.col(i)) / 2;
          gravity -= m * scene.model.find<Gravity>()->acceleration.dot(s.x.col(i) - before.x.col(i));
        }
        const double scale = energy.kinetic + now.kinetic + 9.81 * 0.25;  // J: 0.25 kg that fall by up to a metre
        worst = std::max({worst, std::abs(now.kinetic - energy.kinetic - kinetic) / scale,
                          std::abs(now.gravitational - energy.gravitational - gravity) / scale});
        change = std::max(change, std::abs(gravity) / scale);
      }
      before = s, energy = now;
      return Verdict::ok;
    }
    const Scene& scene;
    State before{};
    Energy energy;
    double worst = 0, change = 0;
  };
  const Scene scene = small_cloth();
  for (const Method& method : all_methods()) {
    if (!method.name.starts_with("mysim/") && !method.name.starts_with("bullet/")) continue;
    SCOPED_TRACE(method.name);
    Discrete look(scene);
    const Outcome out = run_method(method, scene, {1e-3, 0.2, 10}, {&look});
    EXPECT_TRUE(out.verdict == Verdict::ok || out.verdict == Verdict::energy);
    EXPECT_LT(look.worst, 1e-12);
    EXPECT_GT(look.change, 1e-6);  // something fell
  }
}

TEST(LongEnergy, OfBulletsExplicitWorldIsSymplecticEulers) {
  for (const auto name : {"spring", "pendulum", "chain", "normal-modes"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name);
    std::vector<std::vector<LedgerRow>> rows;
    for (const auto method : {"symplectic-euler", "bullet/deformable-explicit"}) {
      const Method m = find_method(method);
      LongLedger ledger(scene.model, m.contact, 10);
      ASSERT_EQ(run_method(m, scene, {scene.step, 500 * scene.step, 10}, {&ledger}).verdict, Verdict::ok);
      EXPECT_FALSE(ledger.contact_inferred());
      rows.push_back(ledger.rows());
    }
    ASSERT_EQ(rows[0].size(), rows[1].size());
    const LongRun ours = summary_of(rows[0]);
    for (size_t i = 0; i < rows[0].size(); ++i)
      EXPECT_NEAR(rows[0][i].balance(), rows[1][i].balance(), 1e-12 * ours.turned_over * 500);
    EXPECT_GT(ours.worst, 1e-4 * ours.turned_over);  // the residual of a first-order rule, well above that
  }
}

}  // namespace
}  // namespace crosscheck
