// Every known disagreement is there: its scene, its failing variant, the matched one, and a sentence with numbers.

#include <numbers>
#include <set>

#include "experiments/disagreements/disagreements.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Which variant fails, which one shows that a matched Bullet does not (-1: none), and by how much, at any time up to
/// `until`, the first must be off and the other may be: in the table's unit.
struct Expected {
  std::string name;
  int failing, matched;
  double apart, together, until;
};
const Expected expected[] = {
    {"pbd-friction", 2, 1, 0.2, 2e-3, INFINITY},        // of 0.29 m
    {"pbd-stiffness", 1, 4, 3, 0.3, INFINITY},          // of 5.9 mm
    {"link-law", 1, -1, 0.2, 0, INFINITY},              // of 1 m to and fro
    {"implicit-freeze", 2, 1, 0.01, 1e-3, INFINITY},    // m, in the first sample, where it is stopped
    {"indefinite-hessian", 2, 1, 20, 1e-3, INFINITY},   // as much again as the 20 J at the start
    {"rest-lengths", 1, -1, 0.1, 0, INFINITY},          // the 0.1 m by which it starts pushed together
    {"wind-at-rest", 1, 2, 1, 0.2, INFINITY},           // of 2.4 m/s
    {"speed-clamp", 1, 2, 20, 0.1, INFINITY},           // of 80 m
    {"distance-field", 1, 2, 1, 0.1, INFINITY},         // mm: a^2 / 4R is 15.6 and 0.1
    {"contact-direction", 3, 4, 4, 1.5, INFINITY},      // mrad: a / 2R is 9.8 at 20 mm and 0.6 at 1.25 mm
    {"contact-hop", 1, -1, 0.01, 0, 0.6},               // mm: (v h)^2 / 2R = 0.03 at 1.5 m/s
    {"single-precision", 2, 1, 1e-7, 1e-13, INFINITY},  // m: one rounding of 1.5 m; round-off of 3000 steps
};

double apart(const Series& a, const Series& b, double until = INFINITY) {
  double most = 0;
  for (size_t i = 0; i < std::min(a.points.size(), b.points.size()) && a.points[i].first < until; ++i)
    most = std::max(most, std::abs(a.points[i].second - b.points[i].second));
  return most;
}

TEST(Disagreements, EachIsThereAndSaysSo) {
  const std::vector<Disagreement> all = disagreements();
  ASSERT_EQ(all.size(), std::size(expected));
  for (size_t d = 0; d < all.size(); ++d) {
    const Expected& e = expected[d];
    SCOPED_TRACE(e.name);
    ASSERT_EQ(all[d].name, e.name);
    for (const std::string& text : {all[d].what, all[d].cause, all[d].quantity, all[d].unit, all[d].world})
      EXPECT_FALSE(text.empty());
    const Scene scene = scene_of(all[d]);
    const std::vector<Series> series = run_variants(all[d], scene);
    ASSERT_EQ(series.size(), all[d].variants.size());
    for (const Series& s : series) {
      EXPECT_NE(s.outcome.verdict, Verdict::unsupported) << s.variant.method << ": " << s.outcome.reason;
      EXPECT_GE(s.points.size(), 2u) << s.variant.method;
    }
    EXPECT_EQ(series[0].outcome.verdict, Verdict::ok);  // the scene's own definition
    fmt::print("{:20} off by {:.3g} {}", e.name, apart(series[0], series[e.failing], e.until), all[d].unit);
    EXPECT_GT(apart(series[0], series[e.failing], e.until), e.apart);
    if (e.matched >= 0) {
      fmt::print(", matched by {:.3g}", apart(series[0], series[e.matched]));
      EXPECT_LT(apart(series[0], series[e.matched]), e.together);
      EXPECT_EQ(series[e.matched].outcome.verdict, Verdict::ok);
    }
    const std::string effect = all[d].effect(series);
    fmt::print("\n  {}\n", effect);
    EXPECT_FALSE(effect.empty());
    for (const auto no_number : {"nan", "inf"}) EXPECT_EQ(effect.find(no_number), std::string::npos) << effect;
  }
}

TEST(Disagreements, LinkLawInMysimIsThePositionBasedWorlds) {
  for (const Disagreement& d : disagreements())
    if (d.name == "link-law") {
      const std::vector<Series> all = run_variants(d, scene_of(d));
      EXPECT_LT(apart(all[1], all[2]), 0.1 * apart(all[0], all[1]));
    }
}

/// The direction of a field of distances to a ball that is read from a grid, trilinear within a voxel: its gradient.
Vec3 gradient_of_the_grid(const Vec3& x, double radius, double voxel) {
  const Eigen::Array3d at = (x / voxel).array(), low = at.floor(), part = at - low;
  Vec3 gradient = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Array3d up(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const double distance = (voxel * (low + up)).matrix().norm() - radius;
    const Eigen::Array3d weight = up * part + (1 - up) * (1 - part);
    for (int axis = 0; axis < 3; ++axis)
      gradient[axis] += (up[axis] > 0 ? 1 : -1) * distance * weight[(axis + 1) % 3] * weight[(axis + 2) % 3];
  }
  return gradient.normalized();
}

TEST(Disagreements, DirectionOfContactIsTheGradientOfTheGridInAVoxel) {
  const Scene scene = read_scene(file_of_disagreement("contact-direction"));
  std::vector<double> angles;
  for (double degrees = 2.22; degrees < 45; degrees += 3.1) angles.push_back(degrees * std::numbers::pi / 180);
  for (const double voxel : {0.005, 0.02}) {
    const auto errors = direction_errors(fmt::format("bullet/deformable-explicit+voxel={:g}", voxel), scene, angles);
    double largest = 0;
    for (const DirectionError& e : errors) {
      SCOPED_TRACE(fmt::format("{:.3g} degrees, voxel {:g} m", e.angle * 180 / std::numbers::pi, voxel));
      // no angle has its place within 0.3 mm of a face between voxels; the particle begins on the surface and stays
      // within a tenth of a millimetre of it
      const Vec3 n = gradient_of_the_grid(1.02 * Vec3(std::sin(e.angle), std::cos(e.angle), 0), 1, voxel);
      const double in_plane = std::atan2(n.x(), n.y()) - e.angle, sideways = std::asin(n.z());
      fmt::print("{:.4f} rad, voxel {:g} m: in plane {:+.2e}, by the grid {:+.2e}; sideways {:+.2e}, {:+.2e}\n",
                 e.angle, voxel, e.in_plane, in_plane, e.sideways, sideways);
      // its way turns the gradient by d / R = 6e-5 of what it is at most
      EXPECT_NEAR(e.in_plane, in_plane, 1e-4);
      EXPECT_NEAR(e.sideways, sideways, 1e-4);
      largest = std::max(largest, std::abs(e.in_plane));
    }
    EXPECT_GT(largest, 0.2 * voxel);
    EXPECT_LT(largest, 0.5 * voxel);  // a / 2R
  }
  for (const DirectionError& e : direction_errors("mysim/leapfrog", scene, angles)) {
    EXPECT_NEAR(e.in_plane, 0, 1e-4);
    EXPECT_NEAR(e.sideways, 0, 1e-12);
  }
}

TEST(Disagreements, EverySceneFileIsInTheTableAndEveryRowHasOne) {
  std::set<std::string> files, rows;
  for (const auto& entry : std::filesystem::directory_iterator(CROSSCHECK_SOURCE "/experiments/scenes/disagreements")) {
    EXPECT_EQ(entry.path().extension(), ".toml");
    files.insert(entry.path().stem());
  }
  for (const Disagreement& d : disagreements()) EXPECT_TRUE(rows.insert(d.name).second) << d.name;
  EXPECT_EQ(files, rows);
}

TEST(Disagreements, ExperimentWritesACurveForEachAndOneSummary) {
  const TableSet result = computed(find_experiment("disagreements").points({}));
  const Table* summary = result.table("disagreements");
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->rows.size(), disagreements().size());
  for (const Disagreement& d : disagreements()) {
    const Table* curves = result.table(d.name + "-disagreement");
    ASSERT_TRUE(curves) << d.name;
    std::set<std::string> labels;
    for (size_t row = 0; row < curves->rows.size(); ++row)
      labels.insert(std::get<std::string>(curves->at(row, "curve")));
    EXPECT_EQ(labels.size(), d.variants.size());
  }
}

}  // namespace
}  // namespace crosscheck
