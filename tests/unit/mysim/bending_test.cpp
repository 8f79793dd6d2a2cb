// Bending: the energy of a bent sheet compared with that of a plate, equivalent springs, the tangent, implicit and
// position-based rules, and stencils from the grid of a scene file.

#include <Eigen/Eigenvalues>

#include "mysim/model/energy.h"
#include "mysim/model/moduli.h"
#include "mysim/model/system.h"
#include "mysim/run/engine.h"
#include "tests/unit/mysim/networks.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr double B = 3e-4;  // N m
constexpr int nu = 7, nv = 5;
constexpr double p = 0.02, q = 0.03;  // m, spacings

std::string sheet_text(const std::string& of_grid, const std::string& more = "") {
  return fmt::format(
             "[grid]\nsize = [{}, {}]\norigin = [0, 0, 0]\nu = [{}, 0, 0]\nv = [0, {}, 0]\nmass = 0.01\n{}\n"
             "[grid.stiffness]\nstructural = 50\nshear = 50\n",
             nu, nv, (nu - 1) * p, (nv - 1) * q, of_grid) +
         more;
}
Scene sheet(const std::string& more = "") { return small_scene(sheet_text(fmt::format("bending = {}", B), more)); }

double bending_energy(const Scene& scene, const Points& x) {
  State state = scene.start;
  state.x = x;
  return potential_energy(*scene.model.find<Bending>(), scene.model.particles, state);
}

/// The sheet raised to z = a s^2 / 2 + b r^2 / 2 + c s r, with s along u and r along v.
Points raised(const Scene& scene, double a, double b, double c) {
  Points x = scene.start.x;
  for (auto at : x.colwise()) at.z() = a / 2 * at.x() * at.x() + b / 2 * at.y() * at.y() + c * at.x() * at.y();
  return x;
}

TEST(Bending, OfUniformCurvatureHasTheEnergyOfAPlate) {
  const Scene scene = sheet();
  // Stencils are exact on parabolas. The stencils along u cover the sheet except half a spacing at both ends.
  const double along_u = (nu - 2) * (nv - 1) * p * q, along_v = (nu - 1) * (nv - 2) * p * q,
               cells = (nu - 1) * (nv - 1) * p * q;
  for (const auto& [a, b, c] : {std::array{2., 0., 0.}, {0., 3., 0.}, {0., 0., 1.5}, {2., -3., 1.5}}) {
    const double expected = B / 2 * (along_u * a * a + along_v * b * b + cells * 2 * c * c);
    EXPECT_NEAR(bending_energy(scene, raised(scene, a, b, c)), expected, 1e-12 * expected);
  }
}

TEST(Bending, IsTheSameInEveryDirection) {
  // a^2 + b^2 + 2 c^2 is the same for a cylinder at any angle. Edges lack stencils, so the energy of each kind of
  // stencil is divided by the area that its stencils cover, before the kinds are added.
  const Scene scene = sheet();
  const double along_u = (nu - 2) * (nv - 1), along_v = (nu - 1) * (nv - 2), cells = (nu - 1) * (nv - 1);
  for (const double angle : {0.3, 0.8, 1.2}) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const auto part = [&](double a, double b, double c) {
      return bending_energy(scene, raised(scene, a, b, c)) / (p * q);
    };
    const double per_area =
        part(cosine * cosine, 0, 0) / along_u + part(0, sine * sine, 0) / along_v + part(0, 0, sine * cosine) / cells;
    EXPECT_NEAR(per_area, B / 2, 1e-12 * B);
  }
}

TEST(Bending, OfACylinderIsThatOfTheArcToTheSecondOrder) {
  // a sheet that is rolled to radius R without stretching, in any direction, stores B / (2 R^2) per area
  constexpr double radius = 0.05;
  std::vector<double> off;
  for (const int n : {16, 32, 64}) {
    const Scene scene = small_scene(fmt::format(
        "[grid]\nsize = [{0}, 2]\norigin = [0, 0, 0]\nu = [0.1, 0, 0]\nv = [0, 0.01, 0]\nmass = 1\nbending = {1}\n"
        "[grid.stiffness]\nstructural = 1\n",
        n, B));
    Points x = scene.start.x;
    for (auto at : x.colwise())
      at = Vec3(radius * std::sin(at.x() / radius), at.y(), radius * std::cos(at.x() / radius)).eval();
    const double area = 0.1 * 0.01 * (n - 2) / (n - 1);
    off.push_back(1 - bending_energy(scene, x) / (B / (2 * radius * radius) * area));
  }
  // (2 - 2 cos(d / R))^2 / (d / R)^4 = 1 - (d / R)^2 / 6 + ...
  EXPECT_NEAR(off[0], std::pow(0.1 / 15 / radius, 2) / 6, 1e-2 * off[0]);
  EXPECT_NEAR(std::log2(off[1] / off[2]), 2 * std::log2(63. / 31), 1e-3);
}

TEST(Bending, LeavesAFlatSheetAndRigidMotionAlone) {
  const Scene scene = sheet();
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    const Network net{scene.model,
                      {0, (random_turn(random) * scene.start.x).colwise() + random.vector(), scene.start.v}};
    // Rounding: c is a difference of coordinates up to 3 m; k is at most 2 B / p q or B q / p^3 = 1.2 N/m, and weights
    // are at most 2.
    EXPECT_LT(force_of(*net.model.find<Bending>(), net).cwiseAbs().maxCoeff(), 1.2 * 2 * 12 * 8 * eps * 3);
  }
}

TEST(Bending, IsSpringsWithoutRestLength) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Network net = busy_network(seed);
    const Bending& bending = *net.model.find<Bending>();
    Springs springs;
    for (const auto& s : bending.list)
      for (int i = 0; i < s.size; ++i)
        for (int j = i + 1; j < s.size; ++j)
          springs.list.push_back({s.particle[i], s.particle[j], -s.k * s.weight[i] * s.weight[j], 0, Family::single});
    // rounding: sums of about thirty products of at most 4 x 5 N/m and 4 m
    EXPECT_LT((force_of(bending, net) - force_of(springs, net)).cwiseAbs().maxCoeff(), 30 * 20 * 4 * eps);
    EXPECT_NEAR(potential_energy(bending, net.model.particles, net.state),
                potential_energy(springs, net.model.particles, net.state), 30 * 20 * 16 * eps);
  }
}

TEST(Bending, TangentIsTheSlopeOfTheForceAndTakesNoEnergy) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Network net = busy_network(seed);
    const Bending& bending = *net.model.find<Bending>();
    Tangent tangent;
    add_tangent(bending, net.model.particles, net.state, Curvature::exact, tangent);
    const int n = net.model.particles.size();
    Eigen::MatrixXd matrix(3 * n, 3 * n);
    for (int i = 0; i < 3 * n; ++i) {
      Points d = Points::Zero(3, n), out = Points::Zero(3, n);
      d(i % 3, i / 3) = 1;
      tangent.add_product(1, 0, d, out);
      Network moved = net;
      moved.state.x += d;  // by a metre, because the force is linear
      EXPECT_LT((out + force_of(bending, moved) - force_of(bending, net)).cwiseAbs().maxCoeff(), 30 * 20 * 5 * eps);
      matrix.col(i) = out.reshaped();
    }
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
    EXPECT_LT((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 30 * 20 * eps);
    EXPECT_GT(values.minCoeff(), -100 * eps * values.maxCoeff());
    EXPECT_GT(values.maxCoeff(), 1);
  }
}

TEST(Bending, FastestVibrationIsThatOfTheSheet) {
  // For the wave that alternates from particle to particle, x_uu = -4 / p^2 x and x_uv^2 = (4 / p q)^2 x^2, hence omega
  // = (4 / p^2 + 4 / q^2) sqrt(B / rho). Unstretched springs of a flat sheet do not resist this wave.
  Scene scene = small_scene(fmt::format(
      "[grid]\nsize = [40, 30]\norigin = [0, 0, 0]\nu = [0.39, 0, 0]\nv = [0, 0.29, 0]\nmass = 0.024\nbending = {}\n"
      "[grid.stiffness]\nstructural = 1e-3\n",
      B));
  const double rho = 0.024 / (40 * 30) / 1e-4, omega = 8 / 1e-4 * std::sqrt(B / rho);
  const double found = highest_frequency(scene.model, scene.start);
  EXPECT_GT(highest_frequency_bound(scene.model, scene.start), (1 - 1e-3) * found);
  // Power iteration converges from below. At the edges bending is halved but mass is not, which lowers the frequency.
  EXPECT_LT(found, omega * (1 + 1e-3));
  EXPECT_GT(found, omega * 0.97);
}

TEST(Bending, ImplicitStepSolvesItsEquations) {
  // at this size, a cloth with springs only would be solved by multigrid
  Scene scene = small_scene(fmt::format(
      "[grid]\nsize = [24, 24]\norigin = [0, 0, 0]\nu = [0.5, 0, 0]\nv = [0, 0, 0.5]\nmass = 0.05\nbending = {}\n"
      "[grid.stiffness]\nstructural = 50\nshear = 30\n[pins]\nparticles = [0, 23]\n[gravity]\n"
      "acceleration = [0, -9.81, 0]\n",
      100 * B));
  System f(scene.model);
  State s = scene.start;
  Workspace w(s);
  constexpr double h = 0.01;
  for (int i = 0; i < 3; ++i) {
    const State before = s;
    implicit_euler(f, s, h, w);
    Points a(3, s.x.cols());
    f.acceleration(s, a);
    // The equations are solved until the residual is 1e-12 of the largest force (which accelerates by g), or the
    // rounding of the forces, eps k x / m, with k up to 250 N/m, positions x of 0.7 m and a mass of 9e-5 kg.
    EXPECT_LT(((s.v - before.v) / h - a).cwiseAbs().maxCoeff(), 250 * 8 * 4 * eps * 0.7 / (0.05 / 576));
  }
}

TEST(Bending, AnXpbdStepOfOneStencilIsImplicitEulers) {
  // A single stencil without springs is one linear constraint, so one pass solves the equations.
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Network net = random_network(seed);
    Random random(seed);
    net.model.terms = {Gravity{{0, -9.81, 0}}, Bending{{{4, {5, 0, 2, 3}, {1, -1.5, -0.5, 1}, 200}}, 0},
                       Drag{Eigen::VectorXd::Constant(6, 0.3)}};
    pin(net, {2}, {});
    net.state.v.col(2).setZero();
    System f(net.model);
    State by_pass = net.state, by_newton = net.state;
    Workspace w(net.state);
    xpbd(f, by_pass, 0.02, w);
    implicit_euler(f, by_newton, 0.02, w);
    EXPECT_LT((by_pass.x - by_newton.x).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((by_pass.v - by_newton.v).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(Bending, RegularClothsWithItTakeTheGeneralPath) {
  const Scene scene = small_scene(fmt::format(
      "[grid]\nsize = [20, 20]\norigin = [0, 0, 0]\nu = [0.5, 0, 0]\nv = [0, 0, 0.5]\nmass = 0.05\nbending = {}\n"
      "[grid.stiffness]\nstructural = 50\nshear = 30\nbend = 5\n[pins]\nparticles = [0, 19]\n[gravity]\n"
      "acceleration = [0, -9.81, 0]\n",
      B));
  Recorder general, reproducible;
  const crosscheck::Run run{1e-3, 0.1, 2};
  simulate(stepper("leapfrog"), ContactRule::coulomb, scene, run, general, {ExecutionPath::general});
  const Outcome out =
      simulate(stepper("leapfrog"), ContactRule::coulomb, scene, run, reproducible, {ExecutionPath::single_precision});
  EXPECT_EQ(general.trajectory.x.back(), reproducible.trajectory.x.back());
  EXPECT_TRUE(contains(out.remark, "computed in double precision"));
  EXPECT_TRUE(contains(out.remark, "bending"));
}

TEST(Bending, FaultsNameTheLineTheKeyAndWhatWasExpected) {
  EXPECT_TRUE(contains(message_of(scene_text(sheet_text("bending = 0"))),
                       "bad.toml:16: grid.bending: expected a number above zero, got 0"));
  EXPECT_TRUE(contains(message_of(scene_text("[grid]\nsize = [3, 3]\norigin = [0, 0, 0]\nu = [1, 0, 0]\n"
                                             "v = [0.1, 1, 0]\nmass = 1\nbending = 1\n[grid.stiffness]\n"
                                             "structural = 1\n")),
                       "bad.toml:16: grid.bending: expected no bending unless u and v are at right angles"));
  EXPECT_TRUE(contains(message_of(scene_text("[grid]\nsize = [3, 3, 2]\norigin = [0, 0, 0]\nu = [1, 0, 0]\n"
                                             "v = [0, 1, 0]\nw = [0, 0, 1]\nmass = 1\nbending = 1\n"
                                             "[grid.stiffness]\nstructural = 1\n")),
                       "bad.toml:17: grid.bending: expected no bending with a size of three numbers"));
}

TEST(Bending, IsInTheFingerprint) {
  const Scene scene = sheet();
  Scene other = scene;
  other.model.find<Bending>()->list[3].k *= 1 + 1e-15;
  EXPECT_NE(hash_of(other), scene.hash);
  other = scene;
  other.model.find<Bending>()->list[3].weight[1] = -3;
  EXPECT_NE(hash_of(other), scene.hash);
}

TEST(BendingLength, IsTheCubeRootOfRigidityOverWeight) {
  const auto found = [](const Scene& scene) { return *bending_length_of(scene.model, scene.start); };
  const BendingLength hanging = found(sheet(gravity_text));
  const double weight = 0.01 * 9.81 / ((nu - 1) * p * (nv - 1) * q);
  EXPECT_NEAR(hanging.length, std::cbrt(B / weight), 1e-12 * hanging.length);
  EXPECT_NEAR(hanging.spacing, q, 1e-12 * q);
  EXPECT_TRUE(contains(sentence_of(hanging), "B = 0.0003 N m"));
  EXPECT_EQ(coarse_grid_warning({1, 0.05, 0.02}), "");
  EXPECT_TRUE(contains(coarse_grid_warning({1, 0.03, 0.02}), "finer than two grid spacings of 0.02 m"));
  EXPECT_TRUE(std::isinf(found(sheet()).length));
  EXPECT_EQ(sentence_of(found(sheet())), "B = 0.0003 N m, Poisson's ratio 0");
}

}  // namespace
}  // namespace crosscheck
