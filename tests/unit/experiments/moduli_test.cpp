// Moduli of nets: the formula based on their springs, compared with the energy of strained nets.
#include <gtest/gtest.h>

#include <map>

#include "experiments/advise/advice.h"
#include "experiments/advise/fit.h"
#include "experiments/scenes/scenes.h"
#include "experiments/stiffness/pulled_sheet.h"
#include "mysim/base/errors.h"
#include "mysim/model/moduli.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

// Springs are not linear: strains of 1e-4 cause a relative error of 1e-8 in energies averaged over both signs of the
// strain. Differences between energies are about 1e-8 k d^2, and are rounded to 1e-16 of the energy of all springs,
// which is 1e3 times as large.
constexpr double enough = 1e-5;

std::string cloth(const std::string& size, const std::string& u, const std::string& v, const std::string& stiffness,
                  const std::string& more = "") {
  return "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = 1e-3\nwindow = 1\n"
         "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = " +
         size + "\norigin = [0, 0, 0]\nu = " + u + "\nv = " + v + "\nmass = 0.1\n[grid.stiffness]\n" + stiffness + more;
}

Moduli moduli_of_text(const std::string& text) {
  const Scene scene = parse_scene(text, "net");
  const NetModuli net = moduli_of(scene.model, scene.start);
  if (!net.moduli) throw std::runtime_error(net.why_not);
  return *net.moduli;
}

TEST(Moduli, OfTwentyRandomNetsTheyAreThoseOfStrainedEnergies) {
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const NetSprings net{random.between(20, 2000), random.between(20, 2000), i % 4 == 3 ? 0 : random.between(20, 2000),
                         random.between(0.01, 0.2)};
    const double d = 5 * net.spacing;
    const Moduli m = moduli_of_text(cloth("[6, 6]", fmt::format("[{}, 0, 0]", d), fmt::format("[0, 0, {}]", d),
                                          fmt::format("structural = {}\nshear = {}\n{}", net.structural, net.shear,
                                                      net.bend > 0 ? fmt::format("bend = {}\n", net.bend) : "")));
    EXPECT_EQ(m.dimension, 2);
    const StrainedNets strained(net);
    const Eigen::Matrix3d c = strained.stiffness(0);
    EXPECT_NEAR(m.c11, c(0, 0), enough * m.c11);
    EXPECT_NEAR(m.c22, c(1, 1), enough * m.c11);
    EXPECT_NEAR(m.c12, c(0, 1), enough * m.c11);
    EXPECT_NEAR(m.c66, c(2, 2), enough * m.c11);
    // closed forms for a square net
    EXPECT_NEAR(m.c11, net.structural + net.shear + 4 * net.bend, 1e-9 * m.c11);
    EXPECT_NEAR(m.c12, net.shear, 1e-9 * m.c11);
    for (const double angle : {0., 0.3, 0.7})
      EXPECT_NEAR(m.young_at(angle), strained.young(angle), enough * m.c11) << angle;
    EXPECT_NEAR(m.young_at(0), m.young(), 1e-12 * m.c11);
  }
}

TEST(Moduli, OfACubeTheyAreThoseOfStrainedEnergies) {
  const NetSprings net{300, 70, 40, 0.1, 3};
  const Moduli m = moduli_of_text(
      cloth("[6, 6, 6]", "[0.5, 0, 0]", "[0, 0.5, 0]\nw = [0, 0, 0.5]", "structural = 300\nshear = 70\nbend = 40\n"));
  EXPECT_EQ(m.dimension, 3);
  const Eigen::Matrix3d c = StrainedNets(net).stiffness(0);
  EXPECT_NEAR(m.c11, c(0, 0), enough * m.c11);
  EXPECT_NEAR(m.c12, c(0, 1), enough * m.c11);
  EXPECT_NEAR(m.c66, c(2, 2), enough * m.c11);
}

/// A square net with one diagonal of stiffness k per cell, all in the same direction.
Scene net_with_one_diagonal(int n, double spacing, double k) {
  std::string text;
  for (int i = 0; i < n * n; ++i)
    text += fmt::format("[[particle]]\nposition = [{}, {}, 0]\nmass = 0.01\n", spacing * (i % n), spacing * (i / n));
  const auto join = [&](int a, int b) {
    text += fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\n", a, b, k);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (j + 1 < n) join(n * i + j, n * i + j + 1);
      if (i + 1 < n) join(n * i + j, n * i + j + n);
      if (j + 1 < n && i + 1 < n) join(n * i + j, n * i + j + n + 1);
    }
  return small_scene(text);
}

TEST(Moduli, OneDiagonalCouplesStretchAndShear) {
  for (const double k : {100., 3e-4}) {
    const Scene scene = net_with_one_diagonal(5, 0.1, k);
    const Moduli m = *moduli_of(scene.model, scene.start).moduli;
    // Edges contribute k to C11 and C22. A diagonal of length 2^(1/2) d along (1, 1) contributes k / 2 to each modulus.
    EXPECT_NEAR(m.c11, 1.5 * k, 1e-9 * k);
    EXPECT_NEAR(m.c22, 1.5 * k, 1e-9 * k);
    for (const double modulus : {m.c12, m.c66, m.c16, m.c26}) EXPECT_NEAR(modulus, k / 2, 1e-9 * k);
    const double eighth = std::atan(1.0);
    EXPECT_NEAR(m.young_at(0), k, 1e-9 * k);
    EXPECT_NEAR(m.young_at(eighth), 2 * k, 1e-9 * k);
    EXPECT_NEAR(m.young_at(3 * eighth), 0.4 * k, 1e-9 * k);
    EXPECT_FALSE(m.cubic);
    EXPECT_NEAR(m.anisotropy(), 0.2, 1e-4);
    EXPECT_EQ(sentences_of(m)[1].find(": isotropic"), std::string::npos);
  }
  // a rotated net has the same moduli along its axes
  Scene turned = net_with_one_diagonal(5, 0.1, 100);
  turned.start.x = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix() * turned.start.x.eval();
  EXPECT_NEAR(moduli_of(turned.model, turned.start).moduli->young_range().first, 40, 1e-2);
}

TEST(Moduli, AreKnownOfShippedScenesOrWhyNot) {
  for (const auto& [name, said] : std::map<std::string, std::string>{
           {"cloth-inextensible", "hard distances"}, {"projectile", "no springs"}, {"spring", "not at rest"}}) {
    const Scene scene = load_scene(name);
    const NetModuli net = moduli_of(scene.model, scene.start);
    EXPECT_FALSE(net.moduli) << name;
    EXPECT_NE(net.why_not.find(said), std::string::npos) << name << ": " << net.why_not;
  }
  Scene stretched = load_scene("cloth-hang");
  stretched.start.x *= 1.1;
  EXPECT_EQ(moduli_of(stretched.model, stretched.start).why_not, "its springs are not at rest at the start");
  Scene uneven = load_scene("cloth-hang");
  uneven.model.find<Springs>()->list[0].k *= 2;
  EXPECT_EQ(moduli_of(uneven.model, uneven.start).why_not, "its springs differ from place to place");
  Scene twice = load_scene("cloth-hang");  // has an extra particle without springs at the position of another particle
  const long n = twice.start.x.cols();
  twice.start.x.conservativeResize(3, n + 1);
  twice.start.x.col(n) = twice.start.x.col(210);
  EXPECT_NEAR(moduli_of(twice.model, twice.start).moduli->c11, 1200, 1e-6);
  EXPECT_FALSE(
      skip_one_warning(*moduli_of(load_scene("cloth-hang").model, load_scene("cloth-hang").start).moduli).empty());
}

TEST(Moduli, OfALineIsForceOverStrain) {
  const Scene chain = load_scene("chain");
  const Moduli m = *moduli_of(chain.model, chain.start).moduli;
  const Spring link = chain.model.find<Springs>()->list[0];
  EXPECT_EQ(m.dimension, 1);
  EXPECT_NEAR(m.c11, link.k * link.rest, 1e-9 * m.c11);
}

TEST(Moduli, WishedOnesBecomeStiffnesses) {
  const FitResult fitted =
      fit_to_wishes(cloth("[6, 6]", "[0.5, 0, 0]", "[0, 0, 0.5]", "structural = \"fit\"\nshear = \"fit\"\nbend = 20\n",
                          "[wish]\nc11 = 1000\nanisotropy = 1\n"),
                    "wished");
  const Moduli m = *moduli_of(fitted.scene.model, fitted.scene.start).moduli;
  EXPECT_NEAR(m.c11, 1000, 2);  // wishes are met within 0.2 %
  EXPECT_NEAR(m.anisotropy(), 1, 0.002);
  EXPECT_NEAR(m.poisson(), 1. / 3, 0.001);
  ASSERT_EQ(fitted.unknowns.size(), 2u);
  EXPECT_EQ(fitted.unknowns[0].name, "shear stiffness");
  EXPECT_EQ(fitted.unknowns[1].name, "structural stiffness");
  // moduli of a block are pressures
  const FitResult block = fit_to_wishes(cloth("[4, 4, 4]", "[0.3, 0, 0]", "[0, 0.3, 0]\nw = [0, 0, 0.3]",
                                              "structural = \"fit\"\nshear = \"fit\"\n", "[wish]\nc11 = 9000\n"),
                                        "block");
  EXPECT_EQ(block.wishes.at(0).unit, "Pa");
  EXPECT_THROW(fit_to_wishes(cloth("[2, 2]", "[0.1, 0, 0]", "[0, 0, 0.1]", "structural = \"fit\"\nshear = 10\n",
                                   "[wish]\nc11 = 1000\n"),
                             "too small"),
               CannotGuarantee);
}

}  // namespace
}  // namespace crosscheck
