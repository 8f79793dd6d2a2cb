
#include "experiments/energy/long_run.h"
#include "experiments/scenes/scenes.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

ResidualStatistics long_run(const std::string& method, const Scene& scene, double step, int steps) {
  const Method m = find_method(method);
  ThinnedLedger ledger(scene.model, m.contact, 5);
  const Outcome out = run_method(m, scene, {step, step * steps, 20}, {&ledger});
  EXPECT_EQ(out.verdict, Verdict::ok) << method << out.reason;
  return residual_statistics(ledger.rows());
}

TEST(ThinnedLedger, SeesEveryStepAndKeepsFewRows) {
  const Scene scene = small_cloth_in_air();
  Ledger all(scene.model, ContactLoss::reported);
  ThinnedLedger few(scene.model, ContactLoss::reported, 100);
  const crosscheck::Run run{1e-3, 1, 10};
  run_method(find_method("leapfrog"), scene, run, {&all, &few});
  EXPECT_LT(few.rows().size(), 80u);
  EXPECT_EQ(few.rows()[1].t, 1e-3);  // rows of the first states are kept
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

TEST(ResidualStatistics, TellsDriftFromOscillation) {
  std::vector<LedgerRow> drifting, swinging;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.1 * i, kinetic = 2;
    drifting.push_back({t, {kinetic, -3e-3 * t, 0}, 0, 0, 0, 0, 0});
    swinging.push_back({t, {kinetic, 0.5 * std::sin(2 * t), 0}, 0, 0, 0, 0, 0});
  }
  const ResidualStatistics a = residual_statistics(drifting), b = residual_statistics(swinging);
  EXPECT_NEAR(a.drift, -3e-3, 1e-12);  // slope of a straight line, up to the rounding of energies of 2 J
  EXPECT_LT(a.oscillation, 1e-6);      // bound: square root of the rounding error of r^2
  EXPECT_NEAR(a.growth, 1, 1e-12);
  EXPECT_NEAR(a.equivalent_drag, 0.3 / (2 * 2 * 100), 1e-12);    // 0.3 J over 100 s, at 2 K = 4 J
  EXPECT_LT(std::abs(b.drift), 0.5 * 6 / (2 * 100 * 100.) * 2);  // slope fitted to a sine: at most 6 A / (omega T^2)
  EXPECT_NEAR(b.oscillation, 0.5 / std::sqrt(2), 0.01);
  EXPECT_LT(b.growth, 0.01);
  EXPECT_NEAR(b.worst, 0.5, 0.01);
}

TEST(NumericalDamping, IsWhatTheStabilityFunctionSays) {
  EXPECT_DOUBLE_EQ(*damping_by_theory(find_method("implicit-euler"), 0.1, 10), std::log(2) / 0.1);
  EXPECT_EQ(*damping_by_theory(find_method("leapfrog"), 0.1, 10), 0);
  EXPECT_LT(*damping_by_theory(find_method("explicit-euler"), 0.01, 10), 0);  // it adds energy
  EXPECT_FALSE(damping_by_theory(find_method("dopri5"), 0.1, 10));            // no fixed step
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
        // bound on the slope of a line fitted to ln(E) over the run, if ln(E) oscillates with an amplitude of at most h
        // omega
        EXPECT_LT(std::abs(*found.rate), 6 * 10 * h / (400 * h));
        continue;
      }
      ++damped;
      // Allows for rounding errors of 1e-13 relative to 1 mm, and for solvers that stop at 1e-10 of the forces. The
      // link of the position-based world is stiffer than Hooke's law by half the strain of 1e-3.
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
      const ResidualStatistics r = long_run(method, scene, 2e-3, 20000);
      // A random walk would have the exponent 0.5, and a drift the exponent 1. The bound is a tenth of 0.5 and not 0,
      // because the maxima of two vibrations rarely coincide.
      EXPECT_LT(r.growth, 0.05);
      // With twice the slowest frequency (the pendulum's swing) as Omega, the bound 6 A / (Omega T) for a sine is 3 %
      // of A; twice that is allowed.
      EXPECT_LT(std::abs(r.drift) * 40, 0.06 * r.worst);
    }
    for (const auto method : {"trapezoidal", "rk4"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, method));
      // The error is proportional to time. A superposed oscillation may reach a tenth of the drift in the first tenth
      // of the run, which changes the growth by log10(1.1).
      EXPECT_NEAR(long_run(method, scene, 2e-3, 20000).growth, 1, 0.045);
    }
  }
}

TEST(LongEnergy, ImplicitMidpointKeepsItWhereForcesAreLinear) {
  for (const auto name : {"spring", "normal-modes"})
    for (const double h : {1e-3, 1e-2}) {
      const Scene scene = load_scene(name);
      const int steps = 5000;
      const ResidualStatistics exact = long_run("implicit-midpoint", scene, h, steps);
      fmt::print("{} h = {}: residual {:.2g} of the energy per step\n", name, h,
                 exact.worst / exact.energy_scale / steps);
      EXPECT_LT(exact.worst, 1e-12 * exact.energy_scale * steps);
      // a rule of the same order that is not exact has a larger residual
      EXPECT_GT(long_run("leapfrog", scene, h, steps).worst, 100 * exact.worst);
    }
}

/// A run of the small swinging cloth, with one state and one ledger row per step, and the cloth's constants.
struct Swinging : Observer {
  static constexpr double h = 1e-3, mass = 0.25 / 25, g = 9.81;
  static constexpr int first_free = 5, particles = 25;  // the upper edge is pinned
  explicit Swinging(const Method& method) {
    ThinnedLedger ledger(scene.model, method.contact, 1);
    const Outcome out = run_method(method, scene, {h, 0.2, 10}, {&ledger, this});
    EXPECT_TRUE(out.verdict == Verdict::ok || out.verdict == Verdict::energy);
    rows = ledger.rows();
    EXPECT_EQ(rows.size(), path.size());
    EXPECT_GT(path.size(), 10u);
  }
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    path.push_back(state);
    return Verdict::ok;
  }
  Scene scene = small_cloth();
  std::vector<LedgerRow> rows;
  std::vector<State> path;
};

TEST(LongEnergy, KineticAndGravityOfTheLedgerAreTheSumsOverTheSteps) {
  // sums the changes of both energies over the steps, in independent expressions: m (v1 - v0) . (v1 + v0) / 2 for half
  // m (v1^2 - v0^2), and m g . (x1 - x0)
  for (const Method& method : all_methods()) {
    if (!method.name.starts_with("mysim/") && !method.name.starts_with("bullet/")) continue;
    SCOPED_TRACE(method.name);
    const Swinging s(method);
    double kinetic = 0, gravity = 0, worst = 0;
    for (size_t i = 1; i < s.path.size(); ++i) {
      const State &now_at = s.path[i], &before = s.path[i - 1];
      for (int p = s.first_free; p < s.particles; ++p) {
        kinetic += s.mass * (now_at.v - before.v).col(p).dot((now_at.v + before.v).col(p)) / 2;
        gravity += s.mass * s.g * (now_at.x - before.x)(1, p);
      }
      const Energy &now = s.rows[i].energy, &start = s.rows[0].energy;
      const double scale = now.kinetic + s.g * 0.25;  // J: 0.25 kg that falls by up to a metre
      worst = std::max({worst, std::abs(now.kinetic - start.kinetic - kinetic) / scale,
                        std::abs(now.gravitational - start.gravitational - gravity) / scale});
    }
    EXPECT_LT(worst, 200 * 4 * eps);  // some ulps of `scale` in each step
    EXPECT_GT(std::abs(gravity), 1e-3);
  }
}

TEST(LongEnergy, WorkOfAStepIsForceTimesWayAsEachRuleMoves) {
  // x1 - x0 = h (old v0 + next v1), so that gravity's work is m g times this. If the rule uses the force at the start
  // of the step, m (v1 - v0) = h F(x0, v0), and the kinetic energy changes by h F . (v0 + v1) / 2.
  struct Rule {
    const char* method;
    double old, next;
    bool force_at_start;
  };
  for (const Rule& rule : {Rule{"explicit-euler", 1, 0, true}, Rule{"symplectic-euler", 0, 1, true},
                           Rule{"bullet/deformable-explicit", 0, 1, true}, Rule{"leapfrog", 0.5, 0.5, false},
                           Rule{"implicit-midpoint", 0.5, 0.5, false}, Rule{"implicit-euler", 0, 1, false}}) {
    SCOPED_TRACE(rule.method);
    const Swinging s(find_method(rule.method));
    System f(s.scene.model);
    double off_gravity = 0, off_kinetic = 0;
    for (size_t i = 1; i < s.path.size(); ++i) {
      State before = s.path[i - 1];
      Points a(3, s.particles);
      f.acceleration(before, a);
      double gravity = 0, kinetic = 0;
      for (int p = s.first_free; p < s.particles; ++p) {
        const Vec3 v0 = s.path[i - 1].v.col(p), v1 = s.path[i].v.col(p);
        gravity += s.mass * s.g * s.h * (rule.old * v0 + rule.next * v1)[1];
        kinetic += s.mass * s.h * a.col(p).dot(v0 + v1) / 2;
      }
      const Energy &now = s.rows[i].energy, &last = s.rows[i - 1].energy;
      off_gravity = std::max(off_gravity, std::abs(now.gravitational - last.gravitational - gravity));
      off_kinetic = std::max(off_kinetic, std::abs(now.kinetic - last.kinetic - kinetic));
    }
    // Rounding errors are some ulps of 2.5 J in each row. If a rule uses another force than that at the start, the
    // formula with the force at the start has a relative error of h / period.
    EXPECT_LT(off_gravity, 8 * eps * s.g * 0.25);
    EXPECT_EQ(off_kinetic < 8 * eps * s.g * 0.25, rule.force_at_start);
  }
}

TEST(LongEnergy, OfBulletsExplicitWorldIsSymplecticEulers) {
  for (const auto name : {"spring", "pendulum", "chain", "normal-modes"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name);
    std::vector<std::vector<LedgerRow>> rows;
    for (const auto method : {"symplectic-euler", "bullet/deformable-explicit"}) {
      const Method m = find_method(method);
      ThinnedLedger ledger(scene.model, m.contact, 10);
      ASSERT_EQ(run_method(m, scene, {scene.step, 500 * scene.step, 10}, {&ledger}).verdict, Verdict::ok);
      EXPECT_FALSE(ledger.contact_inferred());
      rows.push_back(ledger.rows());
    }
    ASSERT_EQ(rows[0].size(), rows[1].size());
    const ResidualStatistics ours = residual_statistics(rows[0]);
    for (size_t i = 0; i < rows[0].size(); ++i)
      EXPECT_NEAR(rows[0][i].balance(), rows[1][i].balance(), 1e-12 * ours.energy_scale * 500);
    EXPECT_GT(ours.worst, 1e-4 * ours.energy_scale);  // the residual of the first-order rule exceeds the difference
  }
}

}  // namespace
}  // namespace crosscheck
