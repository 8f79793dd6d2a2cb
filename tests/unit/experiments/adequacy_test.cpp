// Ablations of models on small scenes, grids with another resolution, and the smallest adequate model.

#include "experiments/adequacy/ablation.h"
#include "experiments/adequacy/resolution.h"
#include "experiments/measures.h"
#include "experiments/scenes/cloths.h"
#include "experiments/scenes/scenes.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::string spring_text(const std::string& more) {
  return "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1, 0]\nmass = 1\n"
         "[[spring]]\nends = [0, 1]\nstiffness = 100\nrest = 1\n[pins]\nparticles = [0]\n" +
         std::string(gravity_text) + more;
}

TEST(Ingredients, AFileWithoutThemIsTheSceneWithoutThem) {
  for (const auto& name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    for (const Ingredient& i : ingredients_of(scene)) {
      if (i.keys.empty()) continue;
      SCOPED_TRACE(fmt::format("{} without {}", name, i.name));
      TomlDocument file(scene.source, "edited");
      for (const std::string& key : i.keys) file.erase(key);
      const Scene written = parse_scene(file.text(), "edited");
      EXPECT_EQ(written.hash, without(scene, i).hash);
      EXPECT_NE(written.hash, scene.hash);
    }
  }
}

TEST(Ablations, NothingCanBeLeftOutOfTheAssignmentsScenes) {
  for (const auto name : {"circle", "pendulum", "chain"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name);
    const ReferenceSolution y = reference_solution_of(scene, scene.tolerance);
    EXPECT_LE(y.floor, scene.tolerance / 5);
    const std::vector<AblatedModel> models = ablations_of(scene, y, scene.tolerance);
    EXPECT_EQ(models.size(), 1 + ingredients_of(scene).size());  // single removals only: all errors are too large
    for (const AblatedModel& r : models)
      if (!r.out.empty() && r.error) {
        EXPECT_GT(*r.error, scene.tolerance) << r.name;
      }
    EXPECT_TRUE(least_model(models, scene.tolerance).out.empty());
  }
}

TEST(Ablations, LeavesOutWhatDoesNotMatterAndOnlyThat) {
  // A weak wind changes x by about 1e-6 m in a second, and a weak drag by 1e-3 m.
  const Scene scene = small_scene(spring_text("[drag]\ngamma = 0.01\n[wind]\nacceleration = [0, 1e-5, 0]\n"));
  const ReferenceSolution y = reference_solution_of(scene, 1e-4);
  const std::vector<AblatedModel> models = ablations_of(scene, y, 0.02);
  EXPECT_EQ(least_model(models, 1e-6 * 1e-3).name, "full");
  EXPECT_EQ(least_model(models, 1e-4).out, std::vector<std::string>{"wind"});
  EXPECT_EQ(least_model(models, 0.01).out, (std::vector<std::string>{"wind", "drag"}));
  const AblatedModel& least = least_model(models, 0.01);
  EXPECT_EQ(least.name, "without wind, drag");
  EXPECT_FALSE(least.single);
  EXPECT_EQ(least.cost(), models.front().cost());  // both have one spring and the same number of evaluations
}

TEST(Ablations, SaysWhyItHasNoReference) {
  // The double pendulum of soft springs has no reference solution over a minute.
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n[[particle]]\n"
      "position = [1, 1, 0]\nmass = 1\n[[spring]]\nends = [0, 1]\nstiffness = 50\n[[spring]]\nends = [1, 2]\n"
      "stiffness = 50\n[pins]\nparticles = [0]\n" +
          std::string(gravity_text),
      60, 1e-2, 10);
  try {
    reference_solution_of(scene, 1e-3);
    FAIL();
  } catch (const Unsupported& why) {
    EXPECT_STREQ(why.what(), "no reference solution is known for it");
  }
}

TEST(UnseenStart, IsSmoothSeededAndLeavesPinsAlone) {
  const Scene scene = small_cloth();
  const Scene a = unseen_start(scene, 0.3, 1), again = unseen_start(scene, 0.3, 1), b = unseen_start(scene, 0.3, 2);
  EXPECT_EQ(a.hash, again.hash);
  EXPECT_NE(a.hash, b.hash);
  EXPECT_NE(a.hash, scene.hash);
  EXPECT_EQ(a.start.x, scene.start.x);
  EXPECT_NEAR((a.start.v - scene.start.v).norm() / std::sqrt(25.), 0.3, 1e-12);
  for (const int pin : scene.model.particles.pins) EXPECT_TRUE(a.start.v.col(pin).isApprox(scene.start.v.col(pin)));
  const Scene circle = load_scene("circle"), moved = unseen_start(circle, 0.3, 1);
  EXPECT_NEAR((moved.start.x - circle.start.x).norm(), 0.1, 1e-12);
}

TEST(Grids, ResamplingIsExactOnBilinearSurfaces) {
  for (const auto& [nu, nv] : {std::pair{2, 2}, {5, 8}, {17, 3}, {32, 32}}) {
    const auto surface = [](double u, double v) { return Vec3(1 + 2 * u - v, u * v, 3 * v - 5 * u * v); };
    Points x(3, nu * nv);
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) x.col(i + nu * j) = surface(double(i) / (nu - 1), double(j) / (nv - 1));
    const Points at = at_material_points(x, nu, nv, 11);
    for (int q = 0; q < 11; ++q)
      for (int p = 0; p < 11; ++p)
        EXPECT_LT((at.col(p + 11 * q) - surface(p / 10., q / 10.)).norm(), 20 * eps) << nu << " x " << nv;
  }
}

TEST(Grids, AnotherResolutionIsTheSameCloth) {
  for (const auto name : {"cloth-hang", "cloth-swing", "flag"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name);
    const Grid grid = *cloth_grid_of(scene);
    for (const int n : {8, 15}) {
      const Scene other = with_resolution(scene, n);
      const Grid g = *cloth_grid_of(other);
      EXPECT_EQ(std::max(g.nu, g.nv), n);
      EXPECT_NEAR(double(g.nu - 1) / (g.nv - 1), double(grid.nu - 1) / (grid.nv - 1), 0.2);
      EXPECT_NEAR(other.model.particles.mass.sum(), scene.model.particles.mass.sum(), 1e-12);
      // the bounding boxes are equal, and the pins are on the same part of the material
      EXPECT_TRUE(other.start.x.rowwise().minCoeff().isApprox(scene.start.x.rowwise().minCoeff(), 1e-12));
      const auto span = [](const Scene& s) {
        const Points& home = s.model.particles.pin_home;
        return (home.rowwise().maxCoeff() - home.rowwise().minCoeff()).eval();
      };
      EXPECT_LT((span(other) - span(scene)).norm(), 1e-12);
      EXPECT_EQ(other.model.particles.pins.size() == 2, scene.model.particles.pins.size() == 2);
    }
    EXPECT_EQ(with_resolution(scene, std::max(grid.nu, grid.nv)).hash, scene.hash);
  }
  EXPECT_FALSE(cloth_grid_of(load_scene("jelly")));
  EXPECT_FALSE(cloth_grid_of(load_scene("cloth-inextensible")));
  EXPECT_THROW(with_resolution(load_scene("chain"), 8), Unsupported);
}

TEST(PowerLaw, FindsAnExponentAndItsError) {
  std::vector<std::pair<double, double>> points;
  for (const double x : {2., 3., 5., 9.}) points.emplace_back(x, 3 * std::pow(x, -1.7));
  const auto exact = power_law(points);
  ASSERT_TRUE(exact);
  EXPECT_NEAR(exact->exponent, -1.7, 1e-12);
  EXPECT_LT(exact->deviation, 1e-6);
  points[1].second *= 1.1;
  EXPECT_GT(power_law(points)->deviation, 0.01);
  points.resize(2);
  EXPECT_FALSE(power_law(points));
}

TEST(Rest, OfASpringIsWhereItsForceIsTheWeight) {
  const auto rest = rest_of(small_scene(spring_text("[drag]\ngamma = 0.1\n")));
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->x(1, 1), -1 - 9.81 / 100, 1e-5 * 9.81 / 100 * 2);
  EXPECT_FALSE(rest_of(small_scene(spring_text("[sphere]\ncentre = [0, -9, 0]\nradius = 1\n"))));
  EXPECT_FALSE(rest_of(load_scene("circle")));
}

TEST(Bending, SkipOneSpringsStiffenAsTheFourthPowerOfTheCells) {
  std::vector<std::pair<double, double>> points;
  for (const BendSprings& b : bending_stiffness({8, 10, 13})) points.emplace_back(b.cells, b.stiffness);
  const auto law = power_law(points);
  ASSERT_TRUE(law);
  // The first cell is clamped, so that only n - 2 cells bend. With so few cells, this changes the exponent by several
  // tenths.
  EXPECT_NEAR(law->exponent, 4, 0.7);
}

}  // namespace
}  // namespace crosscheck
