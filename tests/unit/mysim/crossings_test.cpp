// Self-intersections of a surface, connected components of a network, and coincident particles.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "mysim/model/pieces.h"
#include "mysim/run/crossings.h"
#include "mysim/run/engine.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr auto sheet = R"(question = "q"
parameters = "p"
[time]
duration = 1
samples = 10
step = 0.01
window = 1
tolerance = 1e-3
method = "leapfrog"
[grid]
size = [9, 7]
origin = [0, 0, 0]
u = [0.8, 0, 0]
v = [0, 0, 0.6]
mass = 0.1
[grid.stiffness]
structural = 10
)";

/// Counts edges that pierce triangles without sharing a particle with them, by solving for the intersection points.
int counted_pair_by_pair(const Points& x, const std::vector<std::array<int, 3>>& triangles) {
  std::set<std::pair<int, int>> edges, piercing;
  for (const auto& t : triangles)
    for (int side = 0; side < 3; ++side) edges.insert(std::minmax(t[side], t[(side + 1) % 3]));
  for (const auto& [p, q] : edges)
    for (const auto& [a, b, c] : triangles) {
      if (std::set<int>{a, b, c, p, q}.size() < 5) continue;
      Eigen::Matrix3d columns;
      columns << x.col(b) - x.col(a), x.col(c) - x.col(a), x.col(p) - x.col(q);
      const Vec3 at = columns.inverse() * (x.col(p) - x.col(a));
      if (at[0] > 0 && at[1] > 0 && at[0] + at[1] < 1 && at[2] > 0 && at[2] < 1) piercing.emplace(p, q);
    }
  return static_cast<int>(piercing.size());
}

TEST(Crossings, AreThoseOfEachEdgeWithEachTriangleInEveryUnitOfLength) {
  const Scene scene = parse_scene(sheet, "sheet.toml", "sheet");
  CrossingDetector detector(scene.triangles);
  Random random(7);
  int all = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Points x = scene.start.x;
    for (double& coordinate : x.reshaped()) coordinate += random.between(-0.01, 0.01) * trial;
    const int expected = counted_pair_by_pair(x, scene.triangles);
    all += expected;
    for (const double unit : {1., 0x1p-20, 0x1p20}) EXPECT_EQ(detector.piercing_edges(unit * x), expected) << trial;
  }
  EXPECT_GT(all, 100);
}

TEST(Crossings, AreNoneInSheetsThatAreFlatRolledOrFoldedApart) {
  const Scene scene = parse_scene(sheet, "sheet.toml", "sheet");
  CrossingDetector detector(scene.triangles);
  Points rolled = scene.start.x, folded = scene.start.x, through = scene.start.x;
  for (int i = 0; i < rolled.cols(); ++i) {
    const double u = rolled(0, i), radius = 0.05 + 0.02 * u;  // a spiral of two turns
    rolled(0, i) = radius * std::cos(16 * u), rolled(1, i) = radius * std::sin(16 * u);
    if (u > 0.41) folded(0, i) = through(0, i) = 0.8 - u, folded(1, i) = 0.02, through(1, i) = u > 0.6 ? -0.02 : 0.02;
  }
  EXPECT_EQ(detector.piercing_edges(scene.start.x), 0);
  EXPECT_EQ(detector.piercing_edges(rolled), 0);
  EXPECT_EQ(detector.piercing_edges(folded), 0);
  EXPECT_GT(detector.piercing_edges(through), 0);
  through(1, 5) = NAN;
  EXPECT_EQ(detector.piercing_edges(through), 0) << "non-finite positions have their own verdict";
}

TEST(Crossings, OfARunAreARemarkAndNoVerdict) {
  // The right half lies 2 cm above the left half and falls through it, because only the left edge is held.
  std::string text = std::string(sheet) +
                     "[pins]\nparticles = [0, 4, 9, 13, 18, 22, 27, 31, 36, 40, 45, 49, 54, 58]\n" +
                     "[gravity]\nacceleration = [0, -9.81, 0]\n[start]\npositions = [";
  for (int i = 0; i < 63; ++i) {
    const int u = i % 9;
    text += fmt::format("[{}, {}, {}], ", 0.1 * (u > 4 ? 8 - u : u), u > 4 ? 0.02 : 0., 0.1 * (i / 9));
  }
  const Scene scene = parse_scene(text + "]\n", "fold.toml", "fold");
  CrossingObserver crossings(scene, scene.samples);
  Outcome out = simulate(stepper("leapfrog"), ContactRule::coulomb, scene, default_run(scene), crossings);
  crossings.note(out);
  EXPECT_EQ(out.verdict, Verdict::ok);
  EXPECT_GT(crossings.most(), 0);
  EXPECT_GT(crossings.first(), 0);
  EXPECT_NE(out.remark.find("crosses itself"), std::string::npos);
}

TEST(CoincidentPairs, AreThoseOfAllPairs) {
  Random random(3);
  Points x(3, 200);
  for (double& coordinate : x.reshaped()) coordinate = std::floor(random.between(0, 5)) / 4;
  std::vector<std::pair<int, int>> expected;
  for (int a = 0; a < x.cols(); ++a)
    for (int b = a + 1; b < x.cols(); ++b)
      if (x.col(a) == x.col(b)) expected.emplace_back(a, b);
  ASSERT_GT(expected.size(), 50u);
  EXPECT_EQ(coincident_pairs(x, 0), expected);
  EXPECT_EQ(coincident_pairs(x, 1e-9), expected);
}

}  // namespace
}  // namespace crosscheck
