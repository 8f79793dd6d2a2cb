// The bench: scenes, rows, and ratios in addition to times. Tests never check speeds.

#include <cstdlib>
#include <set>

#include "experiments/bench/implicit_step.h"
#include "experiments/bench/measurements.h"
#include "experiments/metrics.h"
#include "experiments/scenes/cloths.h"
#include "experiments/scenes/scenes.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/implicit/newton.h"
#include "mysim/model/system.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {

namespace {

using namespace testing_tools;

const TimedRunOptions hasty_turns{3, 1e-4};
const MicrobenchmarkOptions hasty{3, 1e-4};

class Measured {
 public:
  template <class Options>
  Measured(void (*measure)(Options, BenchRecord&), const std::remove_cvref_t<Options>& options) {
    measure(options, record_);
    for (const BenchRow& row : record_.rows) expect_ratio_of_times(row);
  }
  template <class What>
  Measured(void (*measure)(What, const MicrobenchmarkOptions&, BenchRecord&), const std::remove_cvref_t<What>& what) {
    measure(what, hasty, record_);
    for (const BenchRow& row : record_.rows) expect_ratio_of_times(row);
  }
  const std::vector<BenchRow>& rows() const { return record_.rows; }
  const std::vector<std::string>& notes() const { return record_.notes; }

 private:
  /// Checks the intervals. With three rounds, `low` and `high` are the minimum and maximum, and the ratio of a round
  /// lies between the quotients of these.
  static void expect_ratio_of_times(const BenchRow& row) {
    SCOPED_TRACE(row.work + ", " + row.scene + ", " + row.peer + ", " + row.mysim);
    if (!row.ratio) return;
    EXPECT_LE(*row.low, *row.time);
    EXPECT_LE(*row.time, *row.high);
    EXPECT_LE(*row.ratio_low, *row.ratio);
    EXPECT_LE(*row.ratio, *row.ratio_high);
    EXPECT_LE(*row.ratio, *row.peer_high / *row.low * (1 + 1e-9));
    EXPECT_GE(*row.ratio, *row.peer_low / *row.high * (1 - 1e-9));
  }
  Progress progress_{1};
  const LockPatience patience_;
  BenchRecord record_{patience_, progress_};
};

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

TEST(BenchKernels, EachOneForEachInstructionSet) {
  const Measured kernels(measure_kernels, 40);  // runs all kernels; includes single precision and its tolerance
  // two rows for the naive and the plain loop; for each instruction set, one for the general kernel and three for fused
  // steps
  EXPECT_EQ(kernels.rows().size(), 2 + 4 * simd::supported_instruction_sets().size());
  std::set<std::string> names;
  for (const BenchRow& row : kernels.rows()) {
    names.insert(row.mysim + std::string(name_of(row.instructions)));
    EXPECT_GT(*row.share, 0);
  }
  EXPECT_EQ(names.size(), kernels.rows().size());
  EXPECT_EQ(kernels.rows()[0].mysim, "naive loop, double");
  EXPECT_EQ(*kernels.rows()[0].ratio, 1);
}

TEST(BenchKernels, OnNarrowClothsWithoutTheFusedStep) {
  EXPECT_EQ(Measured(measure_kernels, 8).rows().size(), 2 + simd::supported_instruction_sets().size());
}

TEST(BenchScenes, EveryOneWithSprings) {
  std::vector<Scene> scenes;
  size_t with_springs = 0;
  for (const auto& name : shipped_scenes()) {
    scenes.push_back(load_scene(std::string(name)));
    const auto* springs = scenes.back().model.find<Springs>();
    with_springs += springs && !springs->list.empty();
  }
  const Measured measured(measure_scenes, scenes);
  std::set<std::string> seen;
  bool fused = false;
  for (const BenchRow& row : measured.rows()) {
    seen.insert(row.scene);
    EXPECT_TRUE(row.ratio);
    fused |= row.mysim.starts_with("sweep");
  }
  EXPECT_EQ(seen.size(), with_springs);
  EXPECT_TRUE(fused);
}

class BenchEqualError : public testing::Test {
 protected:
  Measured rows_of(std::vector<Peer> peers) const {
    return {measure_equal_error, EqualErrorOptions{scene_, std::move(peers), hasty_turns}};
  }
  std::shared_ptr<const Scene> scene_ = std::make_shared<const Scene>(hanging_cloth(20));
};

TEST_F(BenchEqualError, ARowForEachRunAndInstructionSet) {
  const Measured measured = rows_of({{"odeint/rk4", {1, 0.5}}, {"bullet/pbd", {1}, true}, {"odeint/dopri5", {1e-5}}});
  const std::vector<simd::InstructionSet> sets = compared_instruction_sets();
  ASSERT_EQ(measured.rows().size(), 4 * sets.size());
  for (size_t i = 0; i < measured.rows().size(); ++i) {
    const BenchRow& row = measured.rows()[i];
    SCOPED_TRACE(row.peer);
    EXPECT_EQ(row.instructions, sets[i % sets.size()]);
    EXPECT_EQ(row.variant, row.peer == "bullet/pbd" ? "other model" : "");
    EXPECT_EQ(row.verdict, Verdict::ok);
    EXPECT_FALSE(row.build.empty());
    EXPECT_EQ(row.tolerance.has_value(), row.peer == "odeint/dopri5");
    EXPECT_EQ(row.step.has_value(), row.peer != "odeint/dopri5");
    EXPECT_TRUE(row.ratio);
    ASSERT_GT(*row.error, 2 * *row.truth_bar);
    EXPECT_LE(*row.error_of_mysim, *row.error - 2 * *row.truth_bar);
  }
}

TEST_F(BenchEqualError, APeersRunThatFailsIsARow) {
  const Measured measured = rows_of({{"odeint/rk4", {3}}});
  ASSERT_EQ(measured.rows().size(), compared_instruction_sets().size());
  EXPECT_NE(measured.rows()[0].verdict, Verdict::ok);
  EXPECT_EQ(measured.rows()[0].remark, "the peer's run failed");
  EXPECT_FALSE(measured.rows()[0].ratio);
}

/// The errors of one peer, from its first setting to its last one.
std::vector<double> errors_of(const Measured& measured, const std::string& peer) {
  std::vector<double> errors;
  for (const BenchRow& row : measured.rows())
    if (row.peer == peer && row.instructions == simd::active_instruction_set())
      errors.push_back(row.error.value_or(INFINITY));
  return errors;
}

/// Expects the errors of an adaptive peer to follow its two tolerances.
void expect_tolerance_followed(const std::vector<double>& errors) {
  ASSERT_GE(errors.size(), 2u);
  EXPECT_LT(errors[0], 1e-4);
  EXPECT_LT(errors[1], errors[0] / 10);
}

TEST_F(BenchEqualError, OthersComeToMysimsTruthAsTheirOrdersSay) {
  // The peers use Bullet or independently written equations, so that truth and peers share no code.
  const Measured measured = rows_of(
      {{"odeint/rk4", {0.5, 0.25}}, {"odeint/dopri5", {1e-6, 1e-8}}, {"bullet/deformable-explicit", {0.2, 0.1}}});
  const auto rk4 = errors_of(measured, "odeint/rk4"), euler = errors_of(measured, "bullet/deformable-explicit");
  EXPECT_NEAR(std::log2(rk4[0] / rk4[1]), 4, 0.4);
  EXPECT_NEAR(std::log2(euler[0] / euler[1]), 1, 0.3);
  expect_tolerance_followed(errors_of(measured, "odeint/dopri5"));
}

TEST_F(BenchEqualError, SundialsComesToMysimsTruthAsItsToleranceSays) {
  NEEDS_SUNDIALS;
  expect_tolerance_followed(errors_of(rows_of({{"sundials/arkode+order=4", {1e-6, 1e-8}}}), "sundials/arkode+order=4"));
}

TEST(BenchLinks, PositionBasedOnesComeToTheirOwnLawsTruth) {
  const Measured measured(
      measure_equal_error,
      EqualErrorOptions{
          std::make_shared<const Scene>(hanging_cloth_of_links(20)), {{"bullet/pbd", {0.125, 0.0625}}}, hasty_turns});
  EXPECT_TRUE(measured.notes().empty());
  for (const BenchRow& row : measured.rows()) {
    EXPECT_EQ(row.variant, "");
    EXPECT_TRUE(row.ratio);
  }
  const auto errors = errors_of(measured, "bullet/pbd");
  EXPECT_NEAR(slope(errors[0], errors[1]), 1, 0.3);  // first order, like backward Euler
}

TEST(BenchThreads, OneIsAtWorkWhereASheetIsSmall) {
  const Measured measured(measure_threads, ThreadsOptions{{64, 96}, hasty_turns});
  if (measured.rows().empty()) GTEST_SKIP() << "this machine has a single core: " << measured.notes().at(0);
  ASSERT_EQ(measured.rows().size(), 2u);
  EXPECT_EQ(measured.rows()[0].variant, "too small for a second thread");
  EXPECT_EQ(measured.rows()[1].variant, "");
  for (const BenchRow& row : measured.rows()) {
    EXPECT_GT(*row.share, 0);
    EXPECT_LT(*row.share, 1.1);  // the clocks of machine and process are read one after the other
  }
}

TEST(BenchSameStep, BothEnginesComeToTheSamePlaces) {
  const Measured measured(measure_same_step, SameStepOptions{20, 0.05, hasty_turns});
  const size_t sets = compared_instruction_sets().size();
  ASSERT_EQ(measured.rows().size(), 2 * sets);
  for (size_t i = 0; i < measured.rows().size(); ++i) {
    SCOPED_TRACE(i);
    const BenchRow& row = measured.rows()[i];
    const Scene scene = i < sets ? hanging_cloth(20) : hanging_cloth_of_two_stiffnesses(20);
    EXPECT_EQ(row.scene, scene.name);
    EXPECT_EQ(row.variant, i < sets ? "own force class" : "Bullet's force");
    const double growth = perturbation_growth(find_method("mysim/symplectic-euler"), scene, scene.step, 0.05);
    const auto bound = round_off_bound(scene, 1, growth);
    ASSERT_TRUE(bound);
    EXPECT_LT(*row.apart, *bound);
  }
}

TEST(BenchImplicit, BothWaysEndWhereTheOtherDoes) {
  const Measured measured(measure_implicit_steps, ImplicitStepOptions{{24}, {60, 240}, hasty});
  ASSERT_EQ(measured.rows().size(), 2 * compared_instruction_sets().size());
  // One solver stops at 1e-12 of the forces, the other at round-off. Such a residual moves the softest mode most,
  // because only inertia holds it back. At 60 steps per second, it moves by 1e-12 g h^2 = 3e-15 m if the residual is
  // spread like the weight, and by 24 times as much, 7e-14 m, if it acts on a single one of the 24 x 24 particles.
  for (const BenchRow& row : measured.rows()) EXPECT_LE(*row.apart, 1e-13);
}

TEST(FactorisedStep, RefusesDragThatIsNoRate) {
  Scene scene = hanging_cloth(9);
  scene.model.particles.mass[3] *= 2;
  EXPECT_THROW(FactorisedStep(scene, 0.01), std::invalid_argument);
}

TEST(FactorisedStep, IsTheLinearImplicitStepOfAnyScene) {
  // the scene has a random initial state, and springs that form no cloth grid
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
