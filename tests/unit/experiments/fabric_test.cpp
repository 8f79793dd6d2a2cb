// Strips of cloth against the elastica: the two-point problem against published and limiting values, drops and
// frequencies over the grid, and what skip-one springs make of the same.

#include <numbers>

#include "experiments/fabric/strip.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

ClampedStrip strip_of(double gamma, double load = 0) { return {1, 1, gamma, load, 1}; }

TEST(Elastica, HasItsLimits) {
  // a stiff strip is a beam: w L^4 / 8 B and P L^3 / 3 B, with deviations of second order
  EXPECT_NEAR(Elastica(strip_of(1e-4)).tip().drop, 1e-4 / 8, 1e-12);
  EXPECT_NEAR(Elastica(strip_of(0, 1e-4)).tip().drop, 1e-4 / 3, 1e-11);
  // under a tip load B theta'^2 / 2 = P (sin theta_L - sin theta), so that sqrt(2 P L^2 / B) is the integral of
  // dtheta / sqrt(sin theta_L - sin theta) from 0 to theta_L; with theta = theta_L - u^2 it has no singularity
  const Elastica loaded(strip_of(0, 2));
  const double end = loaded.tip().angle, top = std::sqrt(end);
  double integral = 0, drop = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) * top / n;
    const double ds = 2 * u / std::sqrt(std::sin(end) - std::sin(end - u * u)) * top / n;
    integral += ds;
    drop += std::sin(end - u * u) * ds;
  }
  EXPECT_NEAR(integral, std::sqrt(2 * 2.), 1e-7);  // the midpoint rule's error, (top / n)^2 of the second derivative
  // moments about the clamp: B theta'(0) = P x(L), seen in the angle of the first thousandth
  EXPECT_NEAR(loaded.at(1e-3).angle / 1e-3, 2 * loaded.tip().x, 2e-3);
  // the same substitution (K. E. Bisshopp and D. C. Drucker, Quart. Appl. Math. 3, 1945, with elliptic integrals)
  EXPECT_NEAR(loaded.tip().drop, drop / std::sqrt(2 * 2.), 1e-7);
}

TEST(Elastica, DropsDeeperTheHeavierAndKeepsItsLength) {
  double before = 0;
  for (const double gamma : {0.1, 1., 5., 20., 50., 100.}) {
    const Elastica elastica(strip_of(gamma));
    const Elastica::Place tip = elastica.tip();
    EXPECT_GT(tip.drop, before);
    EXPECT_LT(tip.angle, std::numbers::pi / 2);
    double length = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto a = elastica.at(i * 1e-3), b = elastica.at((i + 1) * 1e-3);
      length += std::hypot(b.x - a.x, b.drop - a.drop);
    }
    // chords of an arc of a thousandth at curvatures of up to some gamma^(1/3): shorter by their square over 24
    EXPECT_NEAR(length, 1, std::pow(gamma, 2. / 3) * 2e-7);
    before = tip.drop;
  }
}

TEST(Elastica, CutAtALoadIsTheSameWithoutIt) {
  ClampedStrip cut = strip_of(5);
  cut.load = 1e-14, cut.load_at = 0.37;
  EXPECT_NEAR(Elastica(cut).tip().drop, Elastica(strip_of(5)).tip().drop, 1e-12);
}

double deviation(const StripNet& net) {
  const auto rest = rest_near(strip_scene(net), along_elastica(net));
  EXPECT_TRUE(rest);
  const ClampedStrip strip = continuum_of(net);
  return rest ? drop_of(net, *rest) / (Elastica(strip).tip().drop / strip.length) - 1 : NAN;
}

TEST(Fabric, ACantileverHangsAsTheElasticaToTheSecondOrder) {
  for (const auto& [gamma, load] : {std::pair{0.1, 0.}, {1., 0.}, {5., 0.}, {20., 0.}, {50., 0.}, {0.1, 5.}}) {
    SCOPED_TRACE(fmt::format("w L^3 / B = {}, P L^2 / B = {}", gamma, load));
    const double coarse = deviation({32, gamma, load}), fine = deviation({64, gamma, load});
    fmt::print("gamma {:4} load {}: {:.2e} {:.2e} order {:.3f}\n", gamma, load, coarse, fine, std::log2(coarse / fine));
    EXPECT_LT(std::abs(fine), 5e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
  }
}

TEST(Fabric, AStripVibratesAsAClampedBeam) {
  const StripNet net{64, 5};
  const std::vector<double> found = frequencies_of(net);
  for (int mode = 0; mode < 2; ++mode)
    EXPECT_NEAR(found[mode] / vibration_of_clamped_strip(continuum_of(net), strip_density, mode), 1, 2e-3);
  // beta^2 = 3.5160, 22.0345
  EXPECT_NEAR(vibration_of_clamped_strip({1, 1, 0}, 1, 1) / vibration_of_clamped_strip({1, 1, 0}, 1, 0),
              22.0345 / 3.5160, 1e-3);
}

TEST(Fabric, SkipOneSpringsAreAnotherStripOnEveryGrid) {
  // four times as many cells at the same k: the same angle in all is that of quarter angles in each, whose fourth
  // powers count: the strip falls nearly as a chain
  StripNet net{16, 5};
  net.skip_one = 2000;
  const auto drop = [&](int cells) {
    StripNet one{cells, 5};
    const Points guess = along_elastica(one);
    one.skip_one = net.skip_one;
    const auto rest = rest_near(strip_scene(one), guess);
    EXPECT_TRUE(rest);
    return rest ? drop_of(one, *rest) : NAN;
  };
  EXPECT_GT(drop(32), 1.1 * drop(8));
}

}  // namespace
}  // namespace crosscheck
