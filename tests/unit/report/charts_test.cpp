// Charts: stacked bars, who is fastest at an accuracy, distance to a method's own finest run.

#include "report/figures/charts.h"
#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/work_precision.h"
#include "experiments/sweep/sweep.h"
#include "report/figures/figure.h"
#include "report/findings/findings.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

StackedBars two_bars() {
  StackedBars bars;
  bars.name = "test-bars", bars.title = "bars", bars.label = "energy / J";
  bars.names = {"mysim/a", "bullet/b"};
  bars.parts = {{"drag", "#0072B2", false, {2, 1}},
                {"contact (inferred)", "#D55E00", true, {0, 3}},
                {"gravity", "#999999", false, {-1.5, 0.5}},
                {"wind", "#E69F00", false, {-0.5, -4.5}}};
  return bars;
}

TEST(StackedBars, StackEachSignFromZero) {
  const Table data = drawing_of(two_bars()).data;
  // part, bar, place, from, to; heights of zero have no row
  const std::vector<std::vector<Cell>> expected = {{"drag", "mysim/a", 1., 0., 2.},
                                                   {"drag", "bullet/b", 2., 0., 1.},
                                                   {"contact (inferred)", "bullet/b", 2., 1., 4.},
                                                   {"gravity", "mysim/a", 1., 0., -1.5},
                                                   {"gravity", "bullet/b", 2., 4., 4.5},
                                                   {"wind", "mysim/a", 1., -1.5, -2.},
                                                   {"wind", "bullet/b", 2., 0., -4.5}};
  EXPECT_EQ(data.rows, expected);
}

TEST(StackedBars, InferredPartsAreHatchedAndOthersAreNot) {
  const std::string script = drawing_of(two_bars()).script;
  size_t hatched = 0, solid = 0;
  for (size_t at = 0; (at = script.find("boxxyerror", at)) != std::string::npos; ++at) {
    const std::string rest = script.substr(at, 200);
    const bool inferred = rest.find("inferred") < rest.find(", \\");
    EXPECT_EQ(rest.find("pattern") < rest.find("title"), inferred) << rest;
    (inferred ? hatched : solid) += 1;
  }
  EXPECT_EQ(hatched, 1u);  // plotted once, then drawn again for the other files
  EXPECT_EQ(solid, 3u);
}

TEST(StackedBars, NothingAndWhatIsNotFiniteAreRefused) {
  const auto message = [](const StackedBars& bars) -> std::string {
    try {
      drawing_of(bars);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  StackedBars empty = two_bars(), bad = two_bars();
  for (StackedBars::Part& part : empty.parts) part.height = {0, 0};
  bad.parts[1].height[1] = NAN;
  EXPECT_EQ(message(empty), "figure test-bars: nothing to draw");
  EXPECT_EQ(message(bad), "figure test-bars: a value is not finite");
  EXPECT_EQ(message(two_bars()), "");
}

using namespace testing_tools;

WorkPrecisionPoint point(const std::string& method, double error, double seconds, bool ok = true) {
  const Timing time{seconds, 0.9 * seconds, 1.2 * seconds, 5};
  return {method, SettingKind::step, 0.01, ok, error, seconds, time};
}

double number(const Table& t, size_t row, const char* column) { return std::get<double>(t.at(row, column)); }
std::string word(const Table& t, size_t row, const char* column) { return std::get<std::string>(t.at(row, column)); }

const std::vector<WorkPrecisionPoint> runs = {point("mysim/rk4", 1e-6, 8),
                                              point("mysim/leapfrog", 5e-3, 2),
                                              point("mysim/xpbd", 0.05, 1),
                                              point("odeint/rk4", 1e-6, 4),
                                              point("bullet/pbd", 0.5, 3),
                                              point("bullet/deformable-explicit", 8e-3, 60),
                                              point("sundials/arkode", 1e-6, 0.5, false)};

TEST(ByEngine, TheCheapestRunOfEachWithinTheBoundBesideMysims) {
  Table t = table_of<EngineSpeedRow>();
  add_by_engine("s", 0.01, Measure::error, 0.01, runs, t);
  ASSERT_EQ(t.rows.size(), 3u) << "ARKODE failed, and failures are not fast";
  EXPECT_EQ(word(t, 0, "method"), "mysim/leapfrog");
  EXPECT_EQ(number(t, 0, "times mysim"), 1);
  EXPECT_EQ(word(t, 1, "method"), "odeint/rk4");
  EXPECT_EQ(number(t, 1, "times mysim"), 2);
  EXPECT_EQ(word(t, 2, "engine"), "bullet");
  EXPECT_EQ(number(t, 2, "times mysim"), 30);
  // as far as both intervals allow: (0.9 60) / (1.2 2) and (1.2 60) / (0.9 2)
  EXPECT_DOUBLE_EQ(number(t, 2, "times mysim low"), 22.5);
  EXPECT_DOUBLE_EQ(number(t, 2, "times mysim high"), 40);
}

TEST(ByEngine, WithoutARunOfMysimThereIsNoQuotient) {
  Table t = table_of<EngineSpeedRow>();
  add_by_engine("s", 1e-5, Measure::error, 1e-7, runs, t);
  EXPECT_TRUE(t.rows.empty()) << "nobody is as near";
  add_by_engine("s", 0.1, Measure::error, 0.1, {runs[3]}, t);
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(t.at(0, "times mysim")));
}

std::vector<Chart> charts_of(const Table& t) {
  Rows rows;
  rows.add(t);
  const std::vector<Scene> scenes;
  const std::vector<SceneData> facts;
  return cheapest_charts({scenes, facts, rows, "commit"});
}

TEST(CheapestChart, SaysWhoIsFastestWhereTheClockCanTell) {
  Table t = table_of<EngineSpeedRow>();
  for (const double part : {0.1, 0.01, 0.001}) add_by_engine("cloth", part, Measure::error, part, runs, t);
  // odeint is no slower than mysim here, within the intervals
  add_by_engine("rod", 0.01, Measure::error, 0.01, {point("mysim/xpbd", 1e-3, 2), point("odeint/rk4", 1e-6, 2.1)}, t);
  // held against a rule of mysim's own: no error, so no place in the figure
  add_by_engine("drape", 0.01, Measure::difference, 0.01, runs, t);
  const auto charts = charts_of(t);
  ASSERT_EQ(charts.size(), 1u);
  const DotPlot& f = std::get<DotPlot>(charts[0].figure);
  EXPECT_EQ(f.names, (std::vector<std::string>{"cloth", "rod"}));
  ASSERT_EQ(f.series.size(), 2u);
  EXPECT_EQ(f.series[0].title, "Bullet");
  EXPECT_EQ(f.series[0].dots[0]->value, 30);
  EXPECT_FALSE(f.series[0].dots[1]);
  EXPECT_EQ(f.finding,
            "Within 1 % of the motion mysim is the fastest, beyond the intervals, on 1 of 2 scenes; Bullet takes 30 "
            "(cloth) times its CPU time, Boost odeint takes 1.1 (rod) to 2 (cloth).");
  EXPECT_EQ(charts[0].tables.at(0).rows.size(), 3u);
  EXPECT_NO_THROW(drawing_of(f));
}

TEST(CheapestChart, WithoutAnotherEngineThereIsNone) {
  Table t = table_of<EngineSpeedRow>();
  add_by_engine("cloth", 0.01, Measure::error, 0.01, {runs[0], runs[1]}, t);
  EXPECT_TRUE(charts_of(t).empty());
  EXPECT_TRUE(cheapest_charts({{}, {}, {}, "commit"}).empty());
}

TEST(CheapestChart, NamesWhoIsThereAndWhichTimesAreScaled) {
  EXPECT_EQ(builds_text({"mysim/rk4", "bullet/pbd"}),
            "mysim is compiled in this build, Bullet is Debian's generic x86-64 build");
  EXPECT_EQ(builds_text({"mysim/", "odeint/", "bullet/", "sundials/"}),
            "mysim and odeint are compiled in this build, Bullet and SUNDIALS are Debian's generic x86-64 builds");
  EXPECT_EQ(builds_text({"mysim/rk4", "exec:./a"}),
            "mysim is compiled in this build, programs of their own are as they were built");
  const auto caption_of = [](const std::vector<WorkPrecisionPoint>& points) {
    Table t = table_of<EngineSpeedRow>();
    add_by_engine("cloth", 0.01, Measure::error, 0.01, points, t);
    return figure_info(charts_of(t).at(0))->caption;
  };
  std::vector<WorkPrecisionPoint> whole{point("mysim/rk4", 1e-3, 1), point("bullet/pbd", 1e-3, 8)}, part = whole;
  EXPECT_FALSE(contains(caption_of(whole), "scaled"));
  EXPECT_FALSE(contains(caption_of(whole), "SUNDIALS")) << "where no run of it is there it is not named";
  EXPECT_FALSE(contains(caption_of(whole), "odeint"));
  part[1].part = 0.1;
  EXPECT_TRUE(contains(caption_of(part), "in 1 of 1 quotients a time is scaled from the first part of its run; "));
}

TEST(CheapestFinding, TellsScenesByEngine) {
  Table t{"speed-accuracy-cheapest-cost", {}, {}};
  for (const char* column : {"scene", "part of motion", "measure", "method", "as cheap within noise", "Bullet / mysim"})
    t.columns.push_back({column, "1"});
  t.add({"spring", 0.01, "error", "mysim/leapfrog", "", 70.});
  t.add({"chain", 0.01, "error", "mysim/symplectic-euler", "mysim/leapfrog", 30.});
  t.add({"rod", 0.01, "error", "odeint/dopri5", "", 8.3});
  // the clock cannot tell two engines apart: nobody wins there
  t.add({"circle", 0.01, "error", "mysim/rk4", "mysim/dopri5, odeint/rk4", 9.});
  Rows rows;
  rows.add(t);
  const auto findings = speed_findings(rows);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(
      findings[0].sentence,
      "For an error of 1 % of the motion the cheapest of the runs tried, in CPU time, is of mysim on 2 scenes "
      "(leapfrog on spring; symplectic-euler or leapfrog on chain) and of odeint/dopri5 on rod; the clock cannot tell "
      "the cheapest of two engines apart on circle (mysim/rk4, mysim/dopri5, odeint/rk4); the best run of Bullet's "
      "worlds takes 8.3 to 70 times as long as that of mysim.");
}

TEST(OwnCharts, AreOfScenesThatTheExperimentLooksAt) {
  for (const Experiment& e : experiments())
    for (const std::string_view scene : e.quick_charts) {
      SCOPED_TRACE(fmt::format("{} {}", e.name, scene));
      const std::string name(scene);
      EXPECT_NO_THROW(load_scene(name));
      EXPECT_NE(std::find(e.quick_scenes.begin(), e.quick_scenes.end(), scene), e.quick_scenes.end());
      EXPECT_TRUE(has_own_charts(std::string(e.name), name, false));
    }
  EXPECT_FALSE(has_own_charts("speed-accuracy", "spring", false));
  EXPECT_TRUE(has_own_charts("speed-accuracy", "spring", true));
  EXPECT_TRUE(has_own_charts("order", "spring", false)) << "all have, where no few are named";
}

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
    const std::vector<SceneData> facts{scene_data(scene.name, *rows)};
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
