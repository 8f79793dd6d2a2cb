// Strips of cloth compared with the elastica: the boundary value problem is compared with published and limiting
// values; drops and frequencies are tested under grid refinement, and so are skip-one springs.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <numbers>

#include "experiments/fabric/disc.h"
#include "experiments/fabric/rest.h"
#include "experiments/fabric/strip.h"
#include "experiments/stability/spectrum.h"
#include "mysim/model/energy.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

ClampedStrip strip_of(double gamma, double load = 0) { return {1, 1, gamma, load, 1}; }

TEST(Elastica, HasItsLimits) {
  // a stiff strip is a beam with drops of w L^4 / 8 B and P L^3 / 3 B; deviations are of second order
  EXPECT_NEAR(Elastica(strip_of(1e-4)).tip().drop, 1e-4 / 8, 1e-12);
  EXPECT_NEAR(Elastica(strip_of(0, 1e-4)).tip().drop, 1e-4 / 3, 1e-11);
  // Under a tip load, B theta'^2 / 2 = P (sin theta_L - sin theta), so sqrt(2 P L^2 / B) is the integral of dtheta /
  // sqrt(sin theta_L - sin theta) from 0 to theta_L. Substituting theta = theta_L - u^2 removes the singularity.
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
  EXPECT_NEAR(integral, std::sqrt(2 * 2.), 1e-7);  // midpoint rule's error: (top / n)^2 times the second derivative
  // moments about the clamp: B theta'(0) = P x(L), where theta' is estimated from the angle over the first thousandth
  EXPECT_NEAR(loaded.at(1e-3).angle / 1e-3, 2 * loaded.tip().x, 2e-3);
  // the drop is the integral of sin theta, with the same substitution (K. E. Bisshopp and D. C. Drucker, Quart. Appl.
  // Math. 3, 1945, with elliptic integrals)
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
    // A chord is shorter than its arc of length s = 1e-3 by a relative (kappa s)^2 / 24. The curvature kappa is at most
    // about gamma^(1/3).
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

TEST(HangingStrip, IsACatenaryInTheLimit) {
  const HangingStrip loose(2, 1.4, 3, 0);
  // a point with height h at arc length s lies on a catenary with c = (s^2 - h^2) / 2 h for every s
  const double h = loose.at(0.5).height, c = (0.25 - h * h) / (2 * h);
  EXPECT_NEAR(loose.at(1).x, 0.7, 1e-12);
  EXPECT_NEAR(loose.at(-1).x, -0.7, 1e-12);
  EXPECT_NEAR(loose.sag(), c * (std::cosh(0.7 / c) - 1), 1e-12);
  // With low rigidity, the sag changes in proportion to the rigidity, except for boundary layers of length (B /
  // H)^(1/2) at the hinges. These cover a twentieth of the half strip, and shrink with the square root of the rigidity.
  const HangingStrip limp(2, 1.4, 3, 0.006), limper(2, 1.4, 3, 0.003);
  EXPECT_NEAR((limp.sag() - loose.sag()) / (limper.sag() - loose.sag()), 2, 0.25);
  EXPECT_NEAR(limp.at(1).x, 0.7, 1e-9);
  // values interpolated between integration steps agree with values at the steps
  EXPECT_NEAR((limp.at(0.50005).height - limp.at(0.49995).height) / 1e-4,
              (limp.at(0.5005).height - limp.at(0.4995).height) / 1e-3, 1e-6);
}

TEST(Fabric, AStripBetweenHingesHangsAsTheContinuumToTheSecondOrder) {
  for (const double gamma : {0., 60.}) {
    SCOPED_TRACE(fmt::format("w L^3 / B = {}", gamma));
    const auto deviation = [&](int cells) {
      const HangingNet net{cells, gamma};
      const Scene scene = strip_scene(net);
      const auto rest = rest_near(scene, scene.start.x);
      EXPECT_TRUE(rest);
      return rest ? sag_of(net, *rest) / (continuum_of(net).sag() / strip_length) - 1 : NAN;
    };
    const double coarse = deviation(32), fine = deviation(64);
    fmt::print("gamma {}: {:.2e} {:.2e} order {:.3f}\n", gamma, coarse, fine, std::log2(coarse / fine));
    EXPECT_LT(std::abs(fine), 5e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
  }
}

TEST(DrapedDisc, BendsAsAPlateOfGivenDeflection) {
  // a flat sheet has no energy, tilted or not
  const DrapedDisc disc{16, 2e-5};
  const auto energy_of_heights = [](const DrapedDisc& d, auto height) {
    const Scene scene = disc_scene(d);
    State s = scene.start;
    for (int i = 0; i < s.x.cols(); ++i)
      s.x(1, i) = height(std::hypot(s.x(0, i), s.x(2, i)), std::atan2(s.x(2, i), s.x(0, i)));
    return potential_energy(*scene.model.find<Bending>(), scene.model.particles, s);
  };
  EXPECT_LT(energy_of_heights(disc, [](double r, double t) { return r * std::cos(t + 1); }),
            1e-22 * energy_of_heights(disc, [](double r, double) { return r * r; }));
  // For r^3 cos 3t, x_rr = 6 r cos 3t = -(x_r / r + x_tt / r^2), and (x_t / r)_r = -6 r sin 3t. On a ring of radius r,
  // each of these contributes 36 pi r^3 B / 2, and the twist (x_t / r)_r twice that. The x_rr part extends to half a
  // spacing before the rim, which carries no moment, and the twist starts half a spacing inside the edge of the disc.
  const auto deviation = [&](int rings) {
    const DrapedDisc d{rings, 2e-5};
    const double half = d.spacing() / 2;
    const auto up_to = [](double r) { return std::pow(r, 4) / 4; };
    const double truth = d.rigidity / 2 * 36 * std::numbers::pi *
                         (up_to(d.specimen - half) + up_to(d.specimen) - 2 * up_to(d.disc) +
                          2 * (up_to(d.specimen) - up_to(d.disc - half)));
    return energy_of_heights(d, [](double r, double t) { return std::pow(r, 3) * std::cos(3 * t); }) / truth - 1;
  };
  fmt::print("energy of r^3 cos 3t: {:.2e} {:.2e}\n", deviation(16), deviation(32));
  EXPECT_LT(std::abs(deviation(32)), 1e-3);
  EXPECT_NEAR(std::log2(deviation(16) / deviation(32)), 2, 0.15);
}

TEST(DrapedDisc, ItsForcesAreTheSlopeOfItsEnergy) {
  const DrapedDisc disc{8, 2e-5};
  const Scene scene = disc_scene(disc);
  State s = scene.start;
  s.x = wavy(disc, 0, 3);
  Forces forces{Points::Zero(3, s.x.cols())};
  const auto& bending = *scene.model.find<Bending>();
  add_force(bending, scene.model.particles, s, forces);
  for (const int i : {disc.particle(2, 0), disc.particle(5, 11), disc.particle(9, 79)})
    for (int axis = 0; axis < 3; ++axis) {
      // the energy is quadratic, so that the central difference has rounding errors only
      const double at = s.x(axis, i), step = 1e-3;
      s.x(axis, i) = at + step;
      const double above = potential_energy(bending, scene.model.particles, s);
      s.x(axis, i) = at - step;
      const double below = potential_energy(bending, scene.model.particles, s);
      s.x(axis, i) = at;
      EXPECT_NEAR(forces.f(axis, i), -(above - below) / (2 * step), 1e-12 * above / step);
    }
}

TEST(DrapedDisc, IsIsotropicInItsPlane) {
  // for a uniform strain along axes at any angle, the energy per area is C11 (a^2 + b^2) / 2 + C12 a b, with C12 = C11
  // / 3
  const DrapedDisc disc{8, 2e-5};
  const Scene scene = disc_scene(disc);
  const double a = 1e-6, b = -0.4e-6, c11 = 3 * disc.shear;
  const int n = disc.spokes();
  const double area = n * std::sin(2 * std::numbers::pi / n) / 2 *
                      (std::pow(disc.specimen, 2) - std::pow(disc.disc + disc.spacing() / 2, 2));
  for (const double angle : {0., 0.3, 0.7}) {
    State s = scene.start;
    const Eigen::Rotation2Dd turn(angle);
    for (int i = 0; i < s.x.cols(); ++i) {
      Eigen::Vector2d at = turn * Eigen::Vector2d(s.x(0, i), s.x(2, i));
      at = turn.inverse() * Eigen::Vector2d((1 + a) * at.x(), (1 + b) * at.y());
      s.x(0, i) = at.x(), s.x(2, i) = at.y();
    }
    const double energy = potential_energy(*scene.model.find<Springs>(), scene.model.particles, s);
    // With spokes at angles of 2 pi / 80, the cells are trapezia, and the springs of the first ring count half a cell
    // too much.
    EXPECT_NEAR(energy / (area * (c11 * (a * a + b * b) / 2 + c11 / 3 * a * b)), 1, 0.03);
  }
}

/// Deflection of the rim of a plate of Poisson's ratio 0 that is clamped at r = a and free at r = b, under a load q per
/// area: w = q r^4 / 64 B + A + C ln r + D r^2 + E r^2 ln r. Boundary conditions: w = w' = 0 at a; w'' = 0 and (w'' +
/// w' / r)' = 0 at b (S. Timoshenko and S. Woinowsky-Krieger, chapter 3).
double rim_of_plate(double a, double b, double q, double rigidity) {
  const double unit = q / (64 * rigidity);
  Eigen::Matrix4d m;
  m << 1, std::log(a), a * a, a * a * std::log(a),  //
      0, 1 / a, 2 * a, 2 * a * std::log(a) + a,     //
      0, -1 / (b * b), 2, 2 * std::log(b) + 3,      //
      0, 0, 0, 4 / b;                               //
  const Eigen::Vector4d right(-unit * std::pow(a, 4), -4 * unit * std::pow(a, 3), -12 * unit * b * b, -32 * unit * b);
  const Eigen::Vector4d c = m.fullPivLu().solve(right);
  return unit * std::pow(b, 4) + c[0] + c[1] * std::log(b) + c[2] * b * b + c[3] * b * b * std::log(b);
}

TEST(DrapedDisc, SagsAsAPlateUnderALightLoad) {
  const auto deviation = [](int rings) {
    const DrapedDisc disc{rings, 2e-5};
    const Scene scene = disc_scene(disc);
    const Linearised l = linearised(scene.model, scene.start);
    Points gravity = Points::Zero(3, scene.start.x.cols());
    gravity.row(1).setConstant(1e-6);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(l.k);
    const Points u = l.offsets(solver.solve(l.weighted(gravity)), static_cast<int>(gravity.cols()));
    return u(1, disc.particle(rings + 1, 5)) /
               rim_of_plate(disc.disc, disc.specimen, 1e-6 * disc.density, disc.rigidity) -
           1;
  };
  const double coarse = deviation(8), fine = deviation(16);
  fmt::print("rim of a plate: {:.2e} {:.2e} order {:.3f}\n", coarse, fine, std::log2(coarse / fine));
  EXPECT_LT(std::abs(fine), 5e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
}

TEST(DrapedDisc, ItsCoefficientIsThatOfKnownShadows) {
  const DrapedDisc disc{8, 2e-5};
  Points x = disc_scene(disc).start.x;
  // the error comes from sampling a round edge by rows of height 2 R / 2000
  EXPECT_NEAR(drape_coefficient(disc, x), 100, 2e-3);
  // folds the cloth over its disc: a radius r beyond 0.09 m becomes 0.09 m + 0.6 (r - 0.09 m), so the shadow has a
  // radius of 0.126 m
  for (int i = 2; i <= disc.rings + 1; ++i)
    for (int j = 0; j < disc.spokes(); ++j) {
      const double shrunk = (0.09 + 0.6 * (disc.radius(i) - 0.09)) / disc.radius(i);
      x(0, disc.particle(i, j)) *= shrunk, x(2, disc.particle(i, j)) *= shrunk;
    }
  EXPECT_NEAR(drape_coefficient(disc, x), 100 * (0.126 * 0.126 - 0.0081) / (0.0225 - 0.0081), 5e-3);
  for (int j = 0; j < disc.spokes(); ++j)
    x.col(disc.particle(9, j)) *= 1 + 0.02 * std::cos(6 * 2 * std::numbers::pi * j / disc.spokes());
  EXPECT_EQ(nodes_of(disc, x), 6);
}

TEST(DrapedDisc, FallsIntoFoldsToTheSecondOrderInTheNet) {
  DrapedDisc disc{8, 2e-5};
  std::vector<double> coefficients;
  Points guess = wavy(disc, 5, 1);
  for (;;) {
    const auto rest = rest_near(disc_scene(disc), guess);
    ASSERT_TRUE(rest);
    EXPECT_EQ(nodes_of(disc, *rest), 5);
    coefficients.push_back(drape_coefficient(disc, *rest));
    if (disc.rings == 16) break;
    DrapedDisc finer = disc;
    finer.rings = 16;
    guess = on_net(disc, *rest, finer), disc = finer;
  }
  EXPECT_NEAR(coefficients[0], coefficients[1], 2);
  EXPECT_NEAR(coefficients[1], 72, 1);  // 72.05 with 32 rings
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
  // Four times as many cells with the same k divide the total angle into cells with a quarter of the angle. The energy
  // depends on the fourth power of these angles, so that the strip behaves nearly like a chain.
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
