// Distance to a method's own finest run: it tells who converges to something else than the truth.
#include "experiments/experiment.h"
#include "experiments/scenes.h"
#include "experiments/sweep/sweep.h"
#include "report/charts/charts.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

struct Row {
  double step, error;
  std::optional<double> own;
};

/// Rows of one method in the table that experiment `order` writes, from long steps to short ones.
std::vector<Row> rows_of(const Scene& scene, const std::string& method, Rows& result) {
  Request request;
  request.scenes = {scene};
  request.methods = find_methods(method);
  result.append(computed(order_points(request)));
  const Table& table = *result.table("order");
  std::vector<Row> rows;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto* own = std::get_if<double>(&table.at(i, "distance to own finest"));
    rows.push_back({std::get<double>(table.at(i, "step")), std::get<double>(table.at(i, "error")),
                    own ? std::optional<double>(*own) : std::nullopt});
  }
  return rows;
}

TEST(OwnFinest, TellsWhoConvergesToAnotherLaw) {
  Scene of_their_law = load_scene("chain-link");
  Scene of_hooke = of_their_law;
  of_hooke.model.find<Springs>()->law = SpringLaw::hooke;
  for (const auto& [scene, same_law] : {std::pair{&of_their_law, true}, std::pair{&of_hooke, false}}) {
    SCOPED_TRACE(same_law);
    Rows result;
    const std::vector<Row> rows = rows_of(*scene, "bullet/pbd", result);
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_FALSE(rows.back().own);  // no distance from itself
    const Row& last = rows[3];
    EXPECT_DOUBLE_EQ(last.step, scene->step / 2);
    // order 1: e and e/2 are left, e/2 apart; to another law the error stays while the distance falls
    if (same_law) {
      EXPECT_NEAR(last.error / *last.own, 2, 0.1);
      EXPECT_NEAR(slope(rows[3].error, rows[4].error), 1, 0.05);
    } else {
      EXPECT_GT(last.error / *last.own, 8);
      EXPECT_NEAR(rows[3].error / rows[4].error, 1, 0.1);
    }
    // what is left is 3 and 1 of the finest step: a factor of 3 at order 1
    EXPECT_NEAR(*rows[2].own / *rows[3].own, 3, 0.1);
    EXPECT_TRUE(result.table("order-slopes")->rows.empty());  // no order is promised for Bullet
  }
}

TEST(OrderCharts, AreDrawnFromTheirOwnTablesAlone) {
  const Scene scene = load_scene("spring");
  Request request;
  request.scenes = {scene};
  request.methods = find_methods("leapfrog,rk4,explicit-euler");
  const Rows alone = computed(order_points(request));
  Rows both = alone;
  both.append(computed(engines_points(request)));
  std::vector<std::vector<Chart>> drawn;
  for (const Rows* rows : {&alone, static_cast<const Rows*>(&both)}) {
    const std::vector<Scene> scenes{scene};
    const std::vector<SceneFacts> facts{facts_of(scene.name, *rows)};
    drawn.push_back(order_charts({scenes, facts, *rows, "commit"}));
    ASSERT_EQ(drawn.back().size(), 1u);
  }
  const Figure &a = std::get<Figure>(drawn[0][0].figure), &b = std::get<Figure>(drawn[1][0].figure);
  EXPECT_EQ(a.curves.size(), 3u);
  EXPECT_EQ(drawing_of(a).script, drawing_of(b).script);
  EXPECT_EQ(a.tier, b.tier);
  EXPECT_TRUE(contains(a.tier, "the exact truth, error bar ")) << a.tier;
}

TEST(OwnFinest, OfAStepperFallsWithItsErrorAndRulesOfToleranceAreNamed) {
  Rows result;
  const std::vector<Row> rows = rows_of(load_scene("pendulum"), "leapfrog,dopri5,odeint/dopri5", result);
  ASSERT_EQ(rows.size(), 7u);
  // order 2: the distance is the error less what is left at the finest step
  for (int i = 2; i + 1 < 7; ++i) EXPECT_NEAR((rows[i].error - rows.back().error) / *rows[i].own, 1, 0.02);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_TRUE(contains(result.notes[0], "mysim/dopri5, odeint/dopri5: steps that follow a tolerance"));
}

}  // namespace
}  // namespace crosscheck
