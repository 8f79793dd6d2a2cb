// The bench: its scene is what it says, its tables have their rows, its ratios are those of its times.

#include <cstdlib>
#include <set>

#include "experiments/bench/implicit_step.h"
#include "experiments/bench/peers.h"
#include "experiments/bench/spring_cost.h"
#include "experiments/bench/threads.h"
#include "experiments/metrics.h"
#include "experiments/scenes/cloths.h"
#include "experiments/scenes/scenes.h"
#include "experiments/tables/bench.h"
#include "experiments/tables/table.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/implicit/newton.h"
#include "mysim/model/system.h"
#include "tests/unit/experiments/bench_helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {

// The bench: its scene is what it says, its tables have their rows, its ratios are those of its times, and what it
// compares computes the same. How fast anything is is never tested.

namespace {

using namespace testing_tools;

const TimedRunOptions hasty_turns{3, 1e-4};

TEST(BenchCloth, IsTheOneThatPeersWereMeasuredOn) {
  for (const auto& [n, springs] : {std::pair{32, 5826u}, {64, 23938u}, {128, 97026u}}) {
    const Scene scene = hanging_cloth(n);
    EXPECT_EQ(scene.model.find<Springs>()->list.size(), springs);
    EXPECT_EQ(scene.model.particles.size(), n * n);
    EXPECT_NEAR(scene.model.particles.mass.sum(), 0.25, 1e-12);
    EXPECT_EQ(scene.model.particles.pins, (std::vector<int>{0, n - 1}));
    EXPECT_NEAR(*uniform_drag_rate(scene.model), 5, 1e-12);
    EXPECT_EQ(scene.duration, 1);
    std::map<Family, std::set<double>> stiffness;
    for (const Spring& s : scene.model.find<Springs>()->list) stiffness[s.family].insert(s.k);
    EXPECT_EQ(stiffness, (std::map<Family, std::set<double>>{
                             {Family::structural, {400}}, {Family::shear, {200}}, {Family::bend, {20}}}));
    EXPECT_NEAR(scene.start.x.row(0).maxCoeff() - scene.start.x.row(0).minCoeff(), 1, 1e-12);
    EXPECT_EQ(scene.start.x.row(1).cwiseAbs().maxCoeff(), 0);
  }
}

TEST(BenchCloth, ItsStepIsBelowEveryExplicitLimit) {
  for (const Scene& scene : {hanging_cloth(24), hanging_cloth_of_two_stiffnesses(24), hanging_cloth_of_links(24)})
    EXPECT_LT(scene.step, 2 / highest_frequency(scene.model, scene.start));
  std::set<double> stiffnesses;
  const Scene two = hanging_cloth_of_two_stiffnesses(24);
  for (const Spring& s : two.model.find<Springs>()->list) stiffnesses.insert(s.k);
  EXPECT_EQ(stiffnesses, (std::set<double>{20, 400}));
}

TEST(BenchInstructions, AreAsBeforeAfterwards) {
  const auto value = [] {
    const char* text = std::getenv("CROSSCHECK_INSTRUCTIONS");
    return std::string(text ? text : "none");
  };
  ASSERT_EQ(value(), "none");
  {
    const ScopedInstructionSet outer(simd::supported_instruction_sets().back());
    {
      const ScopedInstructionSet inner(simd::InstructionSet::baseline);
      EXPECT_EQ(simd::active_instruction_set(), simd::InstructionSet::baseline);
    }
    EXPECT_EQ(simd::active_instruction_set(), simd::supported_instruction_sets().back());
  }
  EXPECT_EQ(value(), "none");
}

using BenchKernels = MicrobenchmarkTest;
using BenchScenes = MicrobenchmarkTest;

TEST_F(BenchKernels, EachOneForEachInstructionSet) {
  const Table table = kernels_table(40, hasty, LockPatience());  // wide enough for single precision
  expect_finite(table);
  // two loops that are compiled once; for each instruction set the general kernel and three fused steps, two on the
  // baseline
  EXPECT_EQ(table.rows.size(), 2 + 4 * simd::supported_instruction_sets().size() - 1);
  std::set<std::string> rows;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    rows.insert(text_at(table, i, "kernel") + text_at(table, i, "instructions") + text_at(table, i, "precision"));
    EXPECT_EQ(*number_at(table, i, "springs"),
              static_cast<double>(hanging_cloth(40).model.find<Springs>()->list.size()));
    EXPECT_LE(*number_at(table, i, "low"), *number_at(table, i, "time per spring"));
    EXPECT_LE(*number_at(table, i, "time per spring"), *number_at(table, i, "high"));
    EXPECT_LE(*number_at(table, i, "ratio low"), *number_at(table, i, "times the naive loop"));
    // of three rounds low and high are the least and the most; a quotient of a round lies between theirs
    EXPECT_LE(*number_at(table, i, "times the naive loop"),
              *number_at(table, 0, "high") / *number_at(table, i, "low") * (1 + 1e-12));
    EXPECT_GE(*number_at(table, i, "times the naive loop"),
              *number_at(table, 0, "low") / *number_at(table, i, "high") * (1 - 1e-12));
    EXPECT_NEAR(*number_at(table, i, "rate") * *number_at(table, i, "time per spring"), 33, 1e-9);
    EXPECT_GT(*number_at(table, i, "share of peak"), 0);
  }
  EXPECT_EQ(rows.size(), table.rows.size());
  EXPECT_EQ(text_at(table, 0, "kernel"), "naive loop");
  EXPECT_EQ(*number_at(table, 0, "times the naive loop"), 1);
}

TEST_F(BenchKernels, OnNarrowClothsWithoutTheFusedStep) {
  EXPECT_EQ(kernels_table(8, hasty, LockPatience()).rows.size(), 2 + simd::supported_instruction_sets().size());
}

TEST_F(BenchScenes, EveryOneWithSprings) {
  std::vector<Scene> scenes;
  size_t with_springs = 0;
  for (const auto& name : shipped_scenes()) {
    scenes.push_back(load_scene(std::string(name)));
    const auto* springs = scenes.back().model.find<Springs>();
    with_springs += springs && !springs->list.empty();
  }
  const Table table = scenes_table(scenes, hasty, LockPatience());
  expect_finite(table);
  EXPECT_EQ(distinct(table, "scene").size(), with_springs);
  bool fused = false;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_GE(*number_at(table, i, "springs"), 1);
    EXPECT_LE(*number_at(table, i, "ratio low"), *number_at(table, i, "ratio high"));
    fused |= text_at(table, i, "kernel").starts_with("sweep");
  }
  EXPECT_TRUE(fused);
}

class BenchEqualError : public testing::Test {
 protected:
  TableSet rows_of(std::vector<Peer> peers) const {
    TableSet tables;
    Progress progress(1);
    equal_error({scene_, std::move(peers), hasty_turns}, LockPatience(), tables, progress);
    return tables;
  }
  std::shared_ptr<const Scene> scene_ = std::make_shared<const Scene>(hanging_cloth(20));
};

TEST_F(BenchEqualError, ARowForEachRunAndPathWithTheRatioOfItsTimes) {
  const TableSet tables = rows_of({{"odeint/rk4", {1, 0.5}}, {"bullet/pbd", {1}, true}, {"odeint/dopri5", {1e-5}}});
  const Table &table = *tables.table("bench-equal-error-cost"), &own = *tables.table("bench-own-runs-cost");
  expect_finite(table);
  expect_finite(own);
  EXPECT_EQ(table.columns, columns_of<EqualErrorRow>());
  ASSERT_EQ(table.rows.size(), 4 * code_paths().size());
  for (size_t i = 0; i < table.rows.size(); ++i) {
    SCOPED_TRACE(i);
    const CodePath path = code_paths()[i % 2];
    EXPECT_EQ(text_at(table, i, "path of mysim"), path.name);
    EXPECT_EQ(text_at(table, i, "instructions"), name_of(path.instructions));
    EXPECT_EQ(text_at(table, i, "model"), text_at(table, i, "peer") == "bullet/pbd" ? "other model" : "same");
    EXPECT_EQ(text_at(table, i, "verdict"), "ok");
    EXPECT_FALSE(text_at(table, i, "build").empty());
    const double error = *number_at(table, i, "error"), error_bar = *number_at(table, i, "truth bar");
    ASSERT_GT(error, 2 * error_bar);
    EXPECT_LE(*number_at(table, i, "error of mysim"), error - 2 * error_bar);
    bool found = false;
    for (size_t j = 0; j < own.rows.size(); ++j) {
      if (text_at(own, j, "method") != text_at(table, i, "mysim") || text_at(own, j, "path of mysim") != path.name ||
          number_at(own, j, "step") != number_at(table, i, "step of mysim"))
        continue;
      found = true;
      // of three rounds low and high are the least and the most; a quotient of a round lies between theirs
      const double ratio = *number_at(table, i, "ratio");
      EXPECT_LE(ratio, *number_at(table, i, "cpu high") / *number_at(own, j, "cpu low") * (1 + 1e-9));
      EXPECT_GE(ratio, *number_at(table, i, "cpu low") / *number_at(own, j, "cpu high") * (1 - 1e-9));
      EXPECT_EQ(number_at(own, j, "cpu"), number_at(table, i, "cpu of mysim"));
    }
    EXPECT_TRUE(found);
    EXPECT_LE(*number_at(table, i, "ratio low"), *number_at(table, i, "ratio"));
    EXPECT_LE(*number_at(table, i, "ratio"), *number_at(table, i, "ratio high"));
  }
}

TEST_F(BenchEqualError, APeersRunThatFailsIsARow) {
  const TableSet tables = rows_of({{"odeint/rk4", {3}}});
  const Table& table = *tables.table("bench-equal-error-cost");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_NE(text_at(table, 0, "verdict"), "ok");
  EXPECT_EQ(text_at(table, 0, "remark"), "the peer's run failed");
  EXPECT_FALSE(number_at(table, 0, "ratio"));
}

/// The errors of one peer, from its first setting to its last.
std::vector<double> errors_of(const TableSet& tables, const std::string& peer) {
  const Table& table = *tables.table("bench-equal-error-cost");
  std::vector<double> errors;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (text_at(table, i, "peer") == peer && text_at(table, i, "path of mysim") == "best")
      errors.push_back(number_at(table, i, "error", INFINITY));
  return errors;
}

/// Of a peer under error control at two tolerances.
void expect_tolerance_followed(const std::vector<double>& errors) {
  ASSERT_GE(errors.size(), 2u);
  EXPECT_LT(errors[0], 1e-4);
  EXPECT_LT(errors[1], errors[0] / 10);
}

TEST_F(BenchEqualError, OthersComeToMysimsTruthAsTheirOrdersSay) {
  // all of them on equations written apart, or in Bullet: truth and peers have no code in common
  const TableSet tables = rows_of(
      {{"odeint/rk4", {0.5, 0.25}}, {"odeint/dopri5", {1e-6, 1e-8}}, {"bullet/deformable-explicit", {0.2, 0.1}}});
  const auto rk4 = errors_of(tables, "odeint/rk4"), euler = errors_of(tables, "bullet/deformable-explicit");
  EXPECT_NEAR(std::log2(rk4[0] / rk4[1]), 4, 0.4);
  EXPECT_NEAR(std::log2(euler[0] / euler[1]), 1, 0.3);
  expect_tolerance_followed(errors_of(tables, "odeint/dopri5"));
}

TEST_F(BenchEqualError, SundialsComesToMysimsTruthAsItsToleranceSays) {
  NEEDS_SUNDIALS;
  const TableSet tables = rows_of({{"sundials/arkode+order=4", {1e-6, 1e-8}}});
  expect_tolerance_followed(errors_of(tables, "sundials/arkode+order=4"));
}

TEST(BenchLinks, PositionBasedOnesComeToTheirOwnLawsTruth) {
  TableSet tables;
  Progress progress(1);
  equal_error(
      {std::make_shared<const Scene>(hanging_cloth_of_links(20)), {{"bullet/pbd", {0.125, 0.0625}}}, hasty_turns},
      LockPatience(), tables, progress);
  EXPECT_TRUE(tables.notes.empty());
  const Table& table = *tables.table("bench-equal-error-cost");
  for (size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(text_at(table, i, "model"), "same");
    EXPECT_TRUE(number_at(table, i, "ratio"));
  }
  const auto errors = errors_of(tables, "bullet/pbd");
  EXPECT_NEAR(slope(errors[0], errors[1]), 1, 0.3);  // of first order, as backward Euler
}

TEST(BenchThreads, OneIsAtWorkWhereASheetIsSmallAndTheRatioIsThatOfTheTimes) {
  TableSet tables;
  Progress progress(1);
  two_threads({{64, 96}, hasty_turns}, LockPatience(), tables, progress);
  const Table* table = tables.table("bench-threads-cost");
  if (!table) GTEST_SKIP() << "this machine has one core for it: " << tables.notes.at(0);
  expect_finite(*table);
  ASSERT_EQ(table->rows.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(*number_at(*table, i, "threads at work"), i == 0 ? 1 : 2);
    EXPECT_GT(*number_at(*table, i, "share of the cores"), 0);
    // clocks of the machine and of the process are read one after the other
    EXPECT_LT(*number_at(*table, i, "share of the cores"), 1.1);
    EXPECT_LE(*number_at(*table, i, "ratio"),
              *number_at(*table, i, "high of one") / *number_at(*table, i, "low of two") * (1 + 1e-9));
    EXPECT_GE(*number_at(*table, i, "ratio"),
              *number_at(*table, i, "low of one") / *number_at(*table, i, "high of two") * (1 - 1e-9));
  }
}

TEST(BenchSameStep, BothEnginesComeToTheSamePlaces) {
  TableSet tables;
  Progress progress(1);
  same_step({20, 0.05, hasty_turns}, LockPatience(), tables, progress);
  const Table& table = *tables.table("bench-same-step-cost");
  expect_finite(table);
  ASSERT_EQ(table.rows.size(), 4u);
  for (size_t i = 0; i < table.rows.size(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = i < 2 ? hanging_cloth(20) : hanging_cloth_of_two_stiffnesses(20);
    EXPECT_EQ(text_at(table, i, "scene"), scene.name);
    EXPECT_EQ(text_at(table, i, "force of Bullet").starts_with("force class of our own"), i < 2);
    const double growth = perturbation_growth(find_method("mysim/symplectic-euler"), scene, scene.step, 0.05);
    const auto bound = round_off_bound(scene, 1, growth);
    ASSERT_TRUE(bound);
    EXPECT_LT(*number_at(table, i, "farthest particle"), *bound);
    EXPECT_LE(*number_at(table, i, "ratio"),
              *number_at(table, i, "high of Bullet") / *number_at(table, i, "low of mysim") * (1 + 1e-9));
    EXPECT_GE(*number_at(table, i, "ratio"),
              *number_at(table, i, "low of Bullet") / *number_at(table, i, "high of mysim") * (1 - 1e-9));
  }
}

using namespace testing_tools;

using BenchImplicit = MicrobenchmarkTest;

TEST_F(BenchImplicit, BothWaysEndWhereTheOtherDoes) {
  TableSet tables;
  Progress progress(2);
  implicit_step({{24}, {60, 240}, hasty}, LockPatience(), tables, progress);
  const Table& table = *tables.table("bench-implicit-step-cost");
  expect_finite(table);
  ASSERT_EQ(table.rows.size(), 2 * code_paths().size());
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
  Scene scene = hanging_cloth(9);
  scene.model.particles.mass[3] *= 2;
  EXPECT_THROW(FactorisedStep(scene, 0.01), std::invalid_argument);
}

TEST(FactorisedStep, IsTheLinearImplicitStepOfAnyScene) {
  // starts at random, on springs that are no cloth grid
  Scene scene = hanging_cloth(9);
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
