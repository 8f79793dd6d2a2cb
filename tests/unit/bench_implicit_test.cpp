// Implicit steps of the bench: both ways are the same step.
#include "experiments/bench/factorised_step.h"
#include "experiments/bench/implicit_step.h"
#include "experiments/bench/paths.h"
#include "experiments/bench/sheet.h"
#include "experiments/cells.h"
#include "mysim/implicit/newton.h"
#include "tests/unit/bench_pieces.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

using BenchImplicit = BenchMicro;

TEST_F(BenchImplicit, BothWaysEndWhereTheOtherDoes) {
  Rows rows;
  Progress progress(2);
  implicit_step({{24}, {60, 240}, hasty}, rows, progress);
  const Table& table = *rows.table("bench-implicit-step-cost");
  expect_finite(table);
  ASSERT_EQ(table.rows.size(), 2 * paths().size());
  for (size_t i = 0; i < table.rows.size(); ++i) {
    // solved to 1e-12 of the forces by one, to round-off by the other; what gives way most is as soft as inertia alone
    EXPECT_LE(*number_at(table, i, "farthest particle"), 1e-10 * *number_at(table, i, "largest move"));
    EXPECT_GT(*number_at(table, i, "largest move"), 1e-3);
    EXPECT_GT(*number_at(table, i, "iterations"), 1);
    EXPECT_LE(*number_at(table, i, "ratio low"), *number_at(table, i, "ratio"));
    EXPECT_LE(*number_at(table, i, "ratio"), *number_at(table, i, "ratio high"));
  }
}

TEST(FactorisedStep, RefusesDragThatIsNoRate) {
  Scene scene = sheet(9);
  scene.model.particles.mass[3] *= 2;
  EXPECT_THROW(FactorisedStep(scene, 0.01), std::invalid_argument);
}

TEST(FactorisedStep, IsTheLinearImplicitStepOfAnyScene) {
  // starts at random, on a net that is no sheet
  Scene scene = sheet(9);
  Random random(3);
  scene.model.find<Springs>()->list.resize(150);
  for (int i = 0; i < 81; ++i) {
    if (scene.model.particles.pinned[i]) continue;
    scene.start.x.col(i) += 0.02 * random.vector();
    scene.start.v.col(i) = random.vector();
  }
  for (const double h : {0.001, 0.02}) {
    System f(scene.model);
    ImplicitStep own(f, true);
    const Points mine = own.solve_linear(scene.start, h).x;
    const Points theirs = FactorisedStep(scene, h).step(scene.start.x, scene.start.v);
    EXPECT_LE(largest_column(mine - theirs), 1e-10 * largest_column(mine - scene.start.x));
  }
}

}  // namespace
}  // namespace crosscheck
