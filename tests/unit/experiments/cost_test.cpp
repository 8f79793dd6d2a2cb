// Experiment `cost`: the cloth at other sizes, phases from given times, and kernels with a known amount of work. No
// test compares measured times.

#include <set>

#include "experiments/cost/cost.h"
#include "experiments/scenes/cloths.h"
#include "mysim/model/system.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Cost, TheSizedClothIsTheShippedRecipe) {
  for (const int n : {8, 20}) {
    SCOPED_TRACE(n);
    const Scene sized = sized_cloth(n), recipe = with_grid("cloth-hang", n);
    EXPECT_EQ(sized.model.particles.mass.matrix(), recipe.model.particles.mass.matrix());
    EXPECT_EQ(sized.model.particles.pins, recipe.model.particles.pins);
    const auto &a = sized.model.find<Springs>()->list, &b = recipe.model.find<Springs>()->list;
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].a, b[i].a);
      EXPECT_EQ(a[i].b, b[i].b);
      EXPECT_EQ(a[i].k, b[i].k);
      EXPECT_EQ(a[i].rest, b[i].rest);
    }
    // pins start at their fixed positions, other particles up to 5 cm from the plane
    for (const int pin : sized.model.particles.pins) EXPECT_NEAR(sized.start.x(1, pin), 0, 1e-15);
    EXPECT_NEAR(sized.start.x.row(1).cwiseAbs().maxCoeff(), 0.05, 0.01);
  }
}

TEST(Cost, TheStepKeepsItsDistanceFromTheLimitAtEverySize) {
  for (const int n : {8, 20, 40}) {
    const Scene cloth = sized_cloth(n);
    // The limit of symplectic Euler is near 2 / omega. Edges matter more if the cloth has few particles.
    EXPECT_NEAR(cloth.step * highest_frequency(cloth.model, cloth.start) / 2, 0.45, 0.03) << n;
  }
}

TEST(Cost, PhasesAreTheDifferencesOfTimings) {
  // times of springs, forces, a step without and with the sphere, the fused step, and another engine; their intervals
  // are +-0.1, +-0.2 or +-1
  const std::vector<Timing> times = {{1, 0.9, 1.1, 5}, {3, 2.8, 3.2, 5}, {4, 3.9, 4.1, 7},
                                     {6, 5.8, 6.2, 5}, {2, 1.9, 2.1, 5}, {8, 7, 9, 5}};
  const Table t = phases_table(8, {"general", "fused", "other"}, times);
  struct Row {
    const char *method, *phase;
    double median, low, high, share;
  };
  const Row expected[] = {{"general", "springs", 1, 0.9, 1.1, 1. / 6},
                          {"general", "other forces", 2, 1.7, 2.3, 2. / 6},
                          {"general", "integration and loop", 1, 0.7, 1.3, 1. / 6},
                          {"general", "contact", 2, 1.7, 2.3, 2. / 6},
                          {"general", "whole step", 6, 5.8, 6.2, 1},
                          {"fused", "whole step", 2, 1.9, 2.1, 1},
                          {"other", "whole step", 8, 7, 9, 1}};
  ASSERT_EQ(t.rows.size(), std::size(expected));
  for (size_t i = 0; i < t.rows.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(std::get<std::string>(t.at(i, "method")), expected[i].method);
    EXPECT_EQ(std::get<std::string>(t.at(i, "phase")), expected[i].phase);
    EXPECT_EQ(std::get<long>(t.at(i, "side")), 8);
    EXPECT_NEAR(std::get<double>(t.at(i, "cpu per step")), expected[i].median, 1e-12);
    EXPECT_NEAR(std::get<double>(t.at(i, "cpu low")), expected[i].low, 1e-12);
    EXPECT_NEAR(std::get<double>(t.at(i, "cpu high")), expected[i].high, 1e-12);
    EXPECT_NEAR(std::get<double>(t.at(i, "share")), expected[i].share, 1e-12);
  }
  EXPECT_TRUE(contains(std::get<std::string>(t.at(6, "how")), "cannot be measured"));
}

TEST(Cost, PhasesAreThoseOfTheMethodsThatAreAskedFor) {
  Request request;
  request.methods = find_methods("leapfrog,bullet/deformable-explicit");
  TableSet tables;
  cost_of_phases(request, 8, tables);
  const Table& t = *tables.table("phases-cost");
  ASSERT_EQ(t.rows.size(), 7u);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(std::get<std::string>(t.at(i, "method")), "mysim/leapfrog+plain");
  EXPECT_EQ(std::get<std::string>(t.at(5, "method")), "mysim/leapfrog");
  EXPECT_EQ(std::get<std::string>(t.at(6, "method")), "bullet/deformable-explicit");
  // Times of phases are differences between separate measurements. They are correct only if a step evaluates the forces
  // exactly once.
  const Scene scene = sized_cloth(8);
  const Outcome out = run_and_record("mysim/leapfrog+plain", scene, {scene.step, 10 * scene.step, 1}).outcome;
  EXPECT_EQ(out.evaluations, out.steps);
}

TEST(Cost, EveryMethodIsARowAndAdaptiveOnesAreNone) {
  Request request;
  request.methods = find_methods("leapfrog,rk4,dopri5,bullet/pbd");
  TableSet tables;
  cost_of_size(request, 8, tables);
  const Table& t = *tables.table("size-cost");
  ASSERT_EQ(t.rows.size(), 3u);
  EXPECT_EQ(std::get<double>(t.at(0, "evaluations per step")), 1);
  EXPECT_EQ(std::get<double>(t.at(1, "evaluations per step")), 4);
  EXPECT_EQ(std::get<long>(t.at(0, "particles")), 64);
  // each row and each column has 7 structural and 6 bend springs, and each of the 7 x 7 cells has two diagonals
  EXPECT_EQ(std::get<long>(t.at(0, "springs")), 2 * 8 * 7 + 2 * 8 * 6 + 2 * 7 * 7);
}

TEST(Cost, APeakBelowAnotherLoopIsDoubted) {
  EXPECT_FALSE(doubt_about_peak(50e9, 12e9));
  EXPECT_FALSE(doubt_about_peak(12e9, 12e9));
  EXPECT_TRUE(contains(doubt_about_peak(10e9, 12e9).value_or(""), "did 10 billion operations per second, fewer than"));
}

TEST(Cost, PointsAreDistinctAndTheQuickOnesAreAmongAll) {
  Request full, one_method;
  full.full = true;
  one_method.methods = find_methods("leapfrog");
  std::set<std::string> all, quick;
  for (const Point& p : cost_points(full)) {
    EXPECT_TRUE(all.insert(p.name).second) << p.name;
    EXPECT_TRUE(p.timed) << p.name;
  }
  const std::vector<Point> points = cost_points({}), others = cost_points(one_method);
  ASSERT_EQ(points.size(), others.size());
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(quick.insert(points[i].name).second && all.contains(points[i].name)) << points[i].name;
    // the content depends only on the methods and on --full
    EXPECT_NE(points[i].content, others[i].content);
    EXPECT_NE(points[i].content, cost_points(full)[i].content);
  }
  Request with_scene;
  with_scene.scenes = {sized_cloth(8)};
  EXPECT_EQ(cost_points(with_scene)[0].content, points[0].content);
  EXPECT_LT(quick.size(), all.size());
}

}  // namespace
}  // namespace crosscheck
