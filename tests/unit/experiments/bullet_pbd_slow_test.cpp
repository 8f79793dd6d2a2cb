// Bullet's position-based world: the stiffness of its links, the force law to which its networks converge, drag, and
// additional forces.

#include <numbers>

#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/stiffness.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TableSet stiffness() { return computed(find_experiment("stiffness").points({})); }
double number(const Table& table, size_t row, const std::string& column) {
  const Cell& cell = table.at(row, column);
  return std::holds_alternative<long>(cell) ? static_cast<double>(std::get<long>(cell)) : std::get<double>(cell);
}

TEST(BulletPbdStiffness, OfOneLinkIsTheFormulas) {
  const TableSet result = stiffness();
  const Table& table = *result.table("stiffness");
  int count = 0;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    const double share = number(table, row, "kLST"), deviation = number(table, row, "deviation");
    SCOPED_TRACE(
        fmt::format("kLST {}, h {}, n {}", share, number(table, row, "step"), number(table, row, "iterations")));
    count += share == 0.1 || share == 0.5;
    EXPECT_LT(std::abs(deviation), 2e-3);  // required bound
    // The last Gauss-Seidel pass starts at the strain e = 1e-4 / (1 - kLST), at which the link law is stiffer than
    // Hooke's law by the fraction e / 2.
    EXPECT_NEAR(deviation, 0.5e-4 / (1 - share), 0.02 * 0.5e-4 / (1 - share));
  }
  EXPECT_EQ(count, 18);  // 2 shares, 3 steps, 3 iterations
}

TEST(BulletPbdStiffness, OfANetworkIsTheFormulasOnlyWhereTheStepIsSmall) {
  const TableSet result = stiffness();
  const Table& table = *result.table("stiffness-network");
  for (const double n : {1., 10.}) {
    double largest = 0, smallest = INFINITY, at_largest = 0, at_smallest = 0, before = 0, last_slope = 0;
    for (size_t row = 0; row < table.rows.size(); ++row) {
      if (number(table, row, "iterations") != n) continue;
      const double K = number(table, row, "k h^2/mu"), deviation = number(table, row, "deviation");
      if (before != 0) {
        EXPECT_LT(deviation, 0.5 * before) << K;  // decreases with every halving of the step
      }
      last_slope = before / deviation, before = deviation;
      if (K > largest) largest = K, at_largest = deviation;
      if (K < smallest) smallest = K, at_smallest = deviation;
    }
    EXPECT_GT(at_largest, 0.1);
    EXPECT_LT(at_smallest, 0.01);
    EXPECT_GT(at_smallest, 1e-4);     // but above round-off
    EXPECT_NEAR(last_slope, 4, 0.2);  // first order in k h^2/mu, which is a quarter at half the step
  }
}

TEST(EffectiveStiffness, ComesBackWithSubStepsAndNotWithIterations) {
  const std::vector<EffectiveStiffnessRow> rows =
      rows_of<EffectiveStiffnessRow>(*stiffness().table("stiffness-effective"));
  const auto at = [&](const std::string& net, const std::string& method, double step, long n) {
    for (const EffectiveStiffnessRow& row : rows)
      if (row.net == net && row.method == method && row.step == step && row.iterations == n) return row;
    ADD_FAILURE() << net << " " << method << " " << step << " " << n;
    return EffectiveStiffnessRow{};
  };
  for (const std::string net : {"chain of 8", "cloth of 6 x 6"}) {
    SCOPED_TRACE(net);
    const double game = 1. / 60;
    for (const std::string method : {"bullet/pbd", "mysim/xpbd"}) {
      // With one pass per step, the net is softer than requested; half the step makes it stiffer.
      const double long_step = at(net, method, game, 1).by_sag.value(),
                   half = at(net, method, game / 2, 1).by_sag.value();
      EXPECT_LT(long_step, 0.8);
      EXPECT_LT(long_step, half);
      EXPECT_LT(half, 1);
      EXPECT_NEAR(at(net, method, 1. / 480, 1).by_sag.value(), 1, 0.03);
    }
    // Sixteen sub-steps are equivalent to a sixteenth of the step: k h^2 / mu falls by a factor of 256, and so does the
    // missing stiffness.
    const double one = 1 - at(net, "mysim/xpbd", game, 1).by_sag.value(),
                 sixteen = 1 - at(net, "mysim/xpbd", game, 16).by_sag.value();
    EXPECT_LT(sixteen, one / 50);
    EXPECT_GT(at(net, "bullet/pbd", game, 1).by_sag.value() * 1.1, at(net, "bullet/pbd", game, 16).by_sag.value())
        << "iterations do not help because they share a link's stiffness";
    // The implicit world solves all springs at once: its equilibrium is the scene's, up to the tolerance of the
    // relaxation that computes it (1e-5).
    EXPECT_NEAR(at(net, "bullet/deformable-implicit", game, 1).by_sag.value(), 1, 2e-5);
  }
  // Closed forms exist for the sag of the chain, m g / k n (n + 1) / 2, and its frequency, 2 sqrt(k/m) sin(pi / (4 n +
  // 2)).
  const EffectiveStiffnessRow chain = at("chain of 8", "mysim/xpbd", 1. / 60, 1);
  EXPECT_NEAR(chain.expected_sag, 0.05 * 0.05 / 200 * 36, 1e-5 * chain.expected_sag);
  const double omega = 2 * std::sqrt(200 / 0.05) * std::sin(std::numbers::pi / 34);
  // the turning points are shifted by higher modes of the fall
  EXPECT_NEAR(chain.expected_period, 2 * std::numbers::pi / omega, 2e-3 * chain.expected_period);
}

/// A soft cloth of 16 x 16, released upright: its springs stretch by about a sixth.
Scene soft_cloth() {
  return small_scene(std::string("[grid]\nsize = [16, 16]\norigin = [0, 0, 0]\nu = [0.95, 0, 0]\nv = [0, -0.95, 0]\n"
                                 "mass = 5\n[grid.stiffness]\nstructural = 200\nshear = 200\nbend = 20\n[pins]\n"
                                 "particles = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]\n"
                                 "[drag]\ngamma = 2\n") +
                         gravity_text,
                     1, 1e-3, 30);
}

Trajectory with_law(Scene scene, SpringLaw law, const std::string& method, double step) {
  scene.model.find<Springs>()->law = law;
  const MethodRun a = run_and_record(method, scene, {step, scene.duration, scene.samples});
  EXPECT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
  return a.trajectory;
}

TEST(BulletPbdNetwork, ConvergesToTheLinkLawAndNotToHookes) {
  const Scene scene = soft_cloth();
  const Trajectory link = with_law(scene, SpringLaw::bullet_link, "rk4", 2.5e-4),
                   hooke = with_law(scene, SpringLaw::hooke, "rk4", 2.5e-4);
  std::vector<double> from_link, from_hooke;
  for (const double h : {1e-3, 5e-4, 2.5e-4}) {
    const Trajectory pbd = with_law(scene, SpringLaw::hooke, "bullet/pbd", h);
    from_link.push_back(sup_rms(pbd, link)), from_hooke.push_back(sup_rms(pbd, hooke));
  }
  fmt::print("soft cloth: {:.3g} to {:.3g} m from the link law, {:.3g} to {:.3g} m from Hooke's\n", from_link.front(),
             from_link.back(), from_hooke.front(), from_hooke.back());
  // First order: half the step gives half the error. At the largest step, the square of k h^2/mu = 0.02 contributes,
  // too.
  for (size_t i = 1; i < from_link.size(); ++i) EXPECT_NEAR(slope(from_link[i - 1], from_link[i]), 1, 0.1);
  EXPECT_LE(from_link.back(), from_link.front() / 4);  // required bound
  EXPECT_GT(from_hooke.back(), from_hooke.front() / 2);
  EXPECT_GT(from_hooke.back(), 5 * from_link.back());
}

TEST(BulletPbdDrag, OfAFreeParticleIsExact) {
  for (const double gamma : {0.5, 4., 60.})
    for (const double h : {1. / 60, 1e-3}) {
      SCOPED_TRACE(fmt::format("gamma {}, h {}", gamma, h));
      const Scene scene = small_scene(fmt::format(
          "[[particle]]\nposition = [0, 0, 0]\nmass = 0.3\nvelocity = [1, -2, 0.5]\n[drag]\ngamma = {}\n", gamma));
      const int steps = 60;
      const Trajectory path = run_and_record("bullet/pbd", scene, {h, steps * h, steps}).trajectory;
      // Velocities are differences of positions divided by h. Each step therefore rounds them by an ulp of the path
      // length, divided by h.
      const double rounding = steps * eps * path.x.back().norm() / h;
      for (int i = 0; i <= steps; ++i)
        EXPECT_LE((path.v[i] - std::exp(-gamma * i * h) * scene.start.v).norm(), rounding) << i;
    }
}

TEST(BulletPbdDashpot, ConvergesToTheDampedOscillatorAtFirstOrder) {
  // strains are 1e-4, for which the link law agrees with Hooke's law to 5e-5
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1.0001, 0]\nmass = 1\n[[spring]]\n"
      "ends = [0, 1]\nstiffness = 100\nrest = 1\ndashpot = 3\n[pins]\nparticles = [0]\n");
  const auto truth = truth_of(scene, {1e-3, 1, 20});
  ASSERT_TRUE(truth && truth->tier == Tier::exact);
  std::vector<double> error;
  for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4})
    error.push_back(sup_rms(run_and_record("bullet/pbd", scene, {h, 1, 20}).trajectory, truth->trajectory));
  for (size_t i = 1; i < error.size(); ++i) EXPECT_NEAR(slope(error[i - 1], error[i]), 1, 0.1) << i;
  EXPECT_LT(error.back(), 2e-6);  // a fiftieth of the amplitude
}

TEST(BulletPbdForces, AddedToNodesConvergeToTheScenesSolution) {
  Scene gusts = small_cloth(), air = small_cloth_in_air();
  std::erase_if(air.model.terms, [](const Term& t) { return std::holds_alternative<Dashpots>(t); });
  Scene dashpots = small_cloth_in_air();
  std::erase_if(dashpots.model.terms, [](const Term& t) { return std::holds_alternative<Aerodynamics>(t); });
  for (const auto& [what, scene] : {std::pair{"gusts", gusts}, {"air", air}, {"dashpots", dashpots}}) {
    const Trajectory truth = with_law(scene, SpringLaw::bullet_link, "rk4", 5e-4);
    std::vector<double> error;
    for (const double h : {1e-3, 5e-4, 2.5e-4})
      error.push_back(sup_rms(with_law(scene, SpringLaw::bullet_link, "bullet/pbd", h), truth));
    fmt::print("{}: {:.3g}, {:.3g}, {:.3g} m\n", what, error[0], error[1], error[2]);
    // First order. The bound is two-sided, so that it also detects an error that does not depend on the step.
    EXPECT_NEAR(slope(error[1], error[2]), 1, 0.15) << what;
    EXPECT_LT(error[2], 2e-3) << what;
  }
}

}  // namespace
}  // namespace crosscheck
