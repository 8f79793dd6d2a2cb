// Blocks: springs of each family counted by formula, neighbours at their distance, a closed surface that faces
// outwards.
#include <map>

#include "mysim/grid.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr std::array<int, 3> sizes[] = {{2, 2, 2}, {2, 3, 4}, {5, 3, 2}, {4, 4, 4}, {3, 2, 7}};
const Vec3 sides[] = {{2, 0, 0}, {0.3, 1.5, 0}, {0.1, -0.2, 1.2}};  // a slanted box

Scene block(const std::array<int, 3>& n) {
  return small_scene(
      fmt::format("[grid]\nsize = [{}, {}, {}]\norigin = [1, 2, 3]\nu = [2, 0, 0]\nv = [0.3, 1.5, 0]\n"
                  "w = [0.1, -0.2, 1.2]\nmass = 1.5\n[grid.stiffness]\nstructural = 30\nshear = 20\nbend = 10\n",
                  n[0], n[1], n[2]));
}

TEST(Block, HasTheCountedSpringsAndMass) {
  for (const auto& n : sizes) {
    SCOPED_TRACE(fmt::format("{} x {} x {}", n[0], n[1], n[2]));
    const Scene s = block(n);
    const int all = n[0] * n[1] * n[2];
    std::map<Family, int> count;
    std::map<std::pair<int, int>, int> seen;
    for (const Spring& spring : s.model.find<Springs>()->list) {
      ++count[spring.family];
      EXPECT_EQ(++seen[std::minmax(spring.a, spring.b)], 1) << "the same pair twice";
    }
    int structural = 0, shear = 0, bend = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int next = n[(axis + 1) % 3], across = all / n[axis] / next;
      structural += all / n[axis] * (n[axis] - 1);
      bend += all / n[axis] * (n[axis] - 2);
      shear += 2 * (n[axis] - 1) * (next - 1) * across;  // both diagonals of each face of each cell, once
    }
    EXPECT_EQ(count[Family::structural], structural);
    EXPECT_EQ(count[Family::shear], shear);
    EXPECT_EQ(count[Family::bend], bend);
    EXPECT_EQ(s.model.particles.size(), all);
    EXPECT_NEAR(s.model.particles.mass.sum(), 1.5, all * eps * 1.5);  // one rounding per addition
    const Vec3 far = Vec3(1, 2, 3) + sides[0] + sides[1] + sides[2];
    EXPECT_LT((s.start.x.col(all - 1) - far).norm(), 32 * eps);  // some ulps of 4 m
  }
}

TEST(Block, SpringsJoinTheRightNeighboursAtTheirDistance) {
  const std::array<int, 3> n = {4, 3, 5};
  const Scene s = block(n);
  for (const Spring& spring : s.model.find<Springs>()->list) {
    Vec3 d = Vec3::Zero();
    int steps[3], a = spring.a, b = spring.b, taken = 0, longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      steps[axis] = a % n[axis] - b % n[axis];
      a /= n[axis], b /= n[axis];
      d += double(steps[axis]) / (n[axis] - 1) * sides[axis];
      taken += std::abs(steps[axis]), longest = std::max(longest, std::abs(steps[axis]));
    }
    const bool right = (spring.family == Family::structural && taken == 1) ||
                       (spring.family == Family::shear && taken == 2 && longest == 1) ||
                       (spring.family == Family::bend && taken == 2 && longest == 2);
    EXPECT_TRUE(right) << spring.a << " " << spring.b;
    EXPECT_EQ(spring.k, spring.family == Family::structural ? 30 : spring.family == Family::shear ? 20 : 10);
    EXPECT_NEAR(spring.rest, d.norm(), 32 * eps);  // differences of coordinates up to 4 m
  }
}

TEST(Block, SurfaceIsClosedAndFacesOutwards) {
  for (const auto& n : sizes) {
    SCOPED_TRACE(fmt::format("{} x {} x {}", n[0], n[1], n[2]));
    const Scene s = block(n);
    Vec3 area = Vec3::Zero();
    double volume = 0;
    std::map<std::pair<int, int>, int> edges;
    for (const auto& [a, b, c] : s.triangles) {
      const Vec3 x = s.start.x.col(a), y = s.start.x.col(b), z = s.start.x.col(c);
      area += 0.5 * (y - x).cross(z - x);
      volume += x.dot(y.cross(z)) / 6;
      for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        EXPECT_EQ(++edges[edge], 1) << "two triangles on the same side of an edge";
    }
    // every edge belongs to two triangles that run along it in opposite senses
    for (const auto& [edge, count] : edges) EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    const double expected = sides[0].cross(sides[1]).dot(sides[2]);
    EXPECT_EQ(static_cast<int>(s.triangles.size()),
              4 * ((n[0] - 1) * (n[1] - 1) + (n[1] - 1) * (n[2] - 1) + (n[2] - 1) * (n[0] - 1)));
    // up to 150 triangles at coordinates up to 5 m: areas are sums of products of those, volumes of triples
    EXPECT_LT(area.norm(), 150 * 25 * eps);
    EXPECT_NEAR(volume, expected, 150 * 125 * eps);  // positive: outwards, by the divergence theorem
  }
}

}  // namespace
}  // namespace crosscheck
