// Sentences and charts of the chapters on stability, energy and the least model, from tables made by hand: they say
// what the rows say, also where rows contradict theory, fail or are missing.

#include "experiments/tables/engines.h"
#include "report/figures/charts.h"
#include "report/findings/findings.h"
#include "report/findings/summaries.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
using Row = std::vector<Cell>;

Table table_of(const std::string& name, const std::vector<std::string>& columns, std::vector<Row> rows) {
  Table t{name, {}, {}};
  for (const std::string& column : columns) t.columns.push_back({column, "1"});
  for (Row& row : rows) t.add(std::move(row));
  return t;
}
Rows rows_of(std::vector<Table> tables) {
  Rows rows;
  for (const Table& t : tables) rows.add(t);
  return rows;
}
std::vector<Chart> charts_of(std::vector<Chart> (*make)(const ChartInput&), const Rows& rows) {
  const std::vector<Scene> scenes;
  const std::vector<SceneData> facts;
  return make({scenes, facts, rows, "commit"});
}

Table stability(std::vector<Row> rows) {
  return table_of("stability",
                  {"scene", "method", "state", "prediction", "predicted limit", "measurement", "measured limit", "held",
                   "failed", "deviation", "verdict above", "steps", "reason"},
                  std::move(rows));
}
Row limit_row(const std::string& method, double predicted, double held, double failed, const std::string& scene = "s",
              const std::string& state = "rest") {
  const double limit = std::sqrt(held * failed);
  return {scene,    method, state, "limit", predicted, "limit", limit, held, failed, limit / predicted - 1,
          "energy", 4000l,  ""};
}
Row words_row(const std::string& method, const std::string& theory, Cell predicted, const std::string& run, Cell held,
              Cell failed) {
  return {"s",    method, "rest", theory, std::move(predicted), run, Cell(), std::move(held), std::move(failed),
          Cell(), Cell(), 4000l,  ""};
}

TEST(ChapterWords, MethodsThatBreakWhereTheorySaysAgree) {
  const Rows rows =
      rows_of({stability({limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3),
                          words_row("mysim/xpbd", "every step", Cell(), "every step tried", 1., Cell())})});
  const auto findings = stability_findings(rows);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].topic, "agreement");
  EXPECT_TRUE(begins(findings[0].sentence, "Where methods break is where theory says: 1 measured largest stable step"));
}

TEST(ChapterWords, ContradictionsAreCountedAndNamed) {
  const Rows rows = rows_of({stability(
      {limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3), limit_row("mysim/explicit-euler", 1e-6, 4.99e-5, 5.01e-5),
       limit_row("mysim/implicit-midpoint", 1e-3, 0.9e-3, 1.35e-3),  // coarse
       words_row("mysim/leapfrog", "limit", 1e-3, "no stable step", Cell(), 1e-6),
       words_row("bullet/pbd", "limit", 1e-3, "every step tried", 1., Cell()),
       words_row("bullet/x", "limit", 1., "held up to a refusal", 0.5, Cell())})});  // not told
  const auto findings = stability_findings(rows);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].topic, "failure");
  EXPECT_TRUE(begins(findings[0].sentence, "Not every method breaks where theory says: 1 measured"));
  EXPECT_TRUE(contains(findings[0].sentence, "1 searched coarsely has"));
  EXPECT_TRUE(contains(findings[0].sentence,
                       "3 lie elsewhere: mysim/explicit-euler on s (50 times as long), "
                       "mysim/leapfrog on s (fails at every step tried, by theory up to 1 ms) and "
                       "bullet/pbd on s (holds at every step tried, by theory up to 1 ms)."));
}

TEST(ChapterWords, LimitsWithoutTheoryStandInATableWithoutFigure) {
  Table t = stability({});
  t.add({"s", "bullet/pbd", "rest", "none", Cell(), "limit", 0.33, 0.329, 0.331, Cell(), "energy", 4000l, "its own"});
  const auto charts = charts_of(stability_charts, rows_of({t}));
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(charts[0].figure));
  ASSERT_EQ(charts[0].tables.size(), 1u);
  const std::vector<std::string> expected{"bullet/pbd", "no theory", "330 ms", "", "blew up", "its own"};
  EXPECT_EQ(charts[0].tables[0].rows.at(0), expected);
  EXPECT_TRUE(contains(charts[0].text, "Runs took 4000 steps."));
}

Table energy(std::vector<Row> rows) {
  return table_of("energy",
                  {"scene", "method", "verdict", "end", "steps", "undamped", "symplectic", "closure claimed",
                   "energy turned over", "largest residual", "residual", "growth of the residual"},
                  std::move(rows));
}

TEST(ChapterWords, DriftIsComputedAndFailedRunsAreSaid) {
  const Row kept{"spring", "mysim/leapfrog", "ok", 100., 20000l, 1l, 1l, 1l, 4., 4e-3, -4e-3, 0.01},
      drifts{"spring", "mysim/symplectic-euler", "ok", 100., 20000l, 1l, 1l, 1l, 4., 0.04, -0.04, 0.98},
      fails{"spring", "mysim/suzuki4", "stretch", 3., 3000l, 1l, 1l, 1l, 4., 40., 40., 2.};
  auto findings = energy_findings(rows_of({energy({kept})}));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].sentence,
            "In runs of 20 000 steps on spring (no drag, no contact) symplectic rules keep the energy to 0.1 % of what "
            "is turned over, without drift.");
  findings = energy_findings(rows_of({energy({kept, drifts, fails})}));
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].topic, "failure");
  EXPECT_TRUE(contains(findings[0].sentence, "mysim/suzuki4 on spring (overstretched at 3 s)"));
  EXPECT_TRUE(contains(findings[1].sentence, "not all without drift: mysim/symplectic-euler on spring (drifts down)"));
}

TEST(ChapterWords, WhatContactLeavesOpenIsSaidByScene) {
  Table t = energy({{"spring", "mysim/leapfrog", "ok", 100., 20000l, 1l, 1l, 1l, 4., 4e-3, -4e-3, 0.01},
                    {"ball", "mysim/leapfrog", "ok", 100., 20000l, 0l, 1l, 1l, 1., 0.4, 0.4, 1.},
                    {"ball", "mysim/symplectic-euler", "ok", 100., 20000l, 0l, 1l, 1l, 1., 8., -8., 1.}});
  for (const char* column : {"drag took", "dashpots took", "contact took"}) {
    t.columns.push_back({column, "J"});
    t.rows[0].emplace_back(0.);
    t.rows[1].emplace_back(column == std::string_view("contact took") ? -2. : 1.);
    t.rows[2].emplace_back(5.);
  }
  const auto findings = energy_findings(rows_of({t}));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_TRUE(contains(findings[0].sentence,
                       "on spring (no drag, no contact) symplectic rules keep the energy to 0.1 % of what is turned "
                       "over, without drift. On ball, where drag or contact act, what does not add up with "
                       "symplectic rules is 10 % (mysim/leapfrog) to 53 % (mysim/symplectic-euler) of what passes "
                       "through drag and contact, gains and losses counted alike."));
}

TEST(ChapterWords, DampingNamesWhoWasAsked) {
  const Table t = table_of("energy-damping", {"method", "h omega", "equivalent drag", "by theory"},
                           {{"bullet/pbd", 0.1, 0.995, 0.99503}, {"bullet/pbd", 1., 6.93, 6.9315}});
  const auto findings = energy_findings(rows_of({t}));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_TRUE(begins(findings[0].sentence,
                     "bullet/pbd damps by itself: at a tenth of a radian per step like a drag of "
                     "0.10 ω, as theory says to 0.0"));
  EXPECT_TRUE(contains(figure_info(charts_of(energy_charts, rows_of({t})).at(0))->finding, "in 2 measurements"));
  const Table none = table_of("energy-damping", {"method", "h omega", "equivalent drag", "by theory"},
                              {{"bullet/deformable-explicit", 0.1, 1e-9, 0.}});
  EXPECT_TRUE(energy_findings(rows_of({none})).empty());
  EXPECT_TRUE(begins(figure_info(charts_of(energy_charts, rows_of({none})).at(0))->finding, "By theory none of"));
}

TEST(ChapterWords, WhoWasHardlyTriedIsSaidWhereItTakesTheScene) {
  const Table cheap =
                  table_of("speed-accuracy-cheapest-cost",
                           {"scene", "part of motion", "measure", "method", "as cheap within noise", "Bullet / mysim"},
                           {{"cloth", 0.01, "error", "mysim/leapfrog", "mysim/rk4", 26.6}}),
              runs = table_of("speed-accuracy", {"scene", "method", "verdict"},
                              {{"cloth", "mysim/leapfrog", "ok"},
                               {"cloth", "mysim/leapfrog", "ok"},
                               {"cloth", "mysim/implicit-euler", "ok"},
                               {"rod", "mysim/xpbd", "ok"},
                               {"rod", "mysim/xpbd", "ok"},
                               {"rod", "bullet/pbd", "ok"},
                               {"rod", "bullet/pbd", "ok"}});
  Table engines = crosscheck::table_of<EngineRow>();
  for (const char* method : {"mysim/leapfrog", "mysim/implicit-euler", "bullet/pbd"})
    add(engines, EngineRow{.scene = "cloth", .method = method, .reason = ""});
  add(engines, EngineRow{.scene = "rod", .method = "mysim/leapfrog", .verdict = Verdict::unsupported, .reason = ""});
  const auto findings = speed_findings(rows_of({cheap, runs, engines}));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(
      findings[0].sentence,
      "For an error of 1 % of the motion the cheapest of the runs tried, in CPU time, is of mysim/leapfrog or rk4 on "
      "cloth; the best run of Bullet's worlds takes 27 times as long as that of mysim. "
      "Hardly tried: mysim/implicit-euler (one run) and bullet/pbd (no run) on cloth.");
}

TEST(ChapterWords, AStepOfBothIsComparedLikeForLikeFirst) {
  const std::vector<std::string> columns{"method", "side", "cpu per step"};
  const auto sentence = [&](std::vector<Row> rows) -> std::string {
    const auto findings = cost_findings(rows_of({table_of("size-cost", columns, std::move(rows))}));
    return findings.empty() ? "" : findings.at(0).sentence;
  };
  const Row kernel8{"mysim/symplectic-euler", 8l, 1e-6}, kernel64{"mysim/symplectic-euler", 64l, 4e-5},
      plain8{"mysim/symplectic-euler+plain", 8l, 2e-6}, plain64{"mysim/symplectic-euler+plain", 64l, 1.6e-4},
      bullet8{"bullet/deformable-explicit", 8l, 2e-5}, bullet64{"bullet/deformable-explicit", 64l, 1.76e-3};
  EXPECT_EQ(sentence({kernel8, plain8, bullet8, kernel64, plain64, bullet64}),
            "In CPU time a step of symplectic Euler on a cloth costs Bullet (Debian's build) 10 (8 x 8) to 11 (64 x "
            "64) times that "
            "of mysim's solver for any network and 20 (8 x 8) to 44 (64 x 64) times that of mysim's kernel for regular "
            "cloths, which Bullet has no like of.");
  EXPECT_FALSE(contains(sentence({kernel8, bullet8}), "any network"));
  EXPECT_EQ(sentence({plain8, kernel8}), "");
}

/// A cloth that touches a ball until 1 s, its single positions compared until 0.5 s.
std::vector<Table> touched(double of_rules, double of_bullet) {
  std::vector<Row> runs, rows;
  for (const char* method :
       {"mysim/symplectic-euler", "mysim/leapfrog", "mysim/rk4", "mysim/xpbd", "bullet/deformable-explicit"}) {
    const std::string name = method;
    runs.push_back({"drape", name, "ok", 0.5, 1., 1e-4});
    const double apart = name.starts_with("bullet") ? of_bullet
                         : name.ends_with("xpbd")   ? 1.  // no rule like the others
                         : name.ends_with("euler")  ? 0.
                                                    : of_rules;
    rows.push_back({name, 0.5, apart / 10}), rows.push_back({name, 1., apart});
  }
  return {table_of("engines", {"scene", "method", "verdict", "window", "end", "smallest clearance"}, std::move(runs)),
          table_of("drape-engines", {"method", "t", "difference"}, std::move(rows))};
}

TEST(ChapterWords, WhetherTheMotionAfterContactIsPredictableIsMeasuredByTheRules) {
  const auto sentence = [](double of_rules, double of_bullet) {
    const auto findings = sphere_findings(rows_of(touched(of_rules, of_bullet)));
    return findings.size() == 1 ? findings[0].sentence : "";
  };
  EXPECT_EQ(
      sentence(2e-4, 2.97e-3),
      "On drape, beyond 0.5 s and up to 1 s, 2 of mysim's rules stay within 0.2 mm of mysim/symplectic-euler; "
      "single positions can be predicted there, and it is bullet/deformable-explicit that differs, by up to 3 mm.");
  EXPECT_EQ(sentence(0.2, 0.3),
            "On drape, beyond 0.5 s and up to 1 s, 2 of mysim's rules stay within 200 mm of mysim/symplectic-euler; "
            "bullet/deformable-explicit differs by up to 300 mm: no more can be said of single positions.");
}

TEST(ChapterWords, GrowthThatIsNotShownIsCounted) {
  const Table growth =
      table_of("stability-growth",
               {"scene", "method", "h omega", "share of limit", "predicted growth", "measured growth", "deviation"},
               {{"s", "mysim/trapezoidal", 0.1, Cell(), 1e-5, 1e-5, 0.},
                {"s", "mysim/rk4", 2.8, 0.98, -1e-3, -1e-3, 0.},
                {"s", "mysim/rk4", 2.9, 1.02, 1e-3, 1e-3, 0.}});
  std::string text;
  for (const Chart& chart :
       charts_of(stability_charts, rows_of({stability({limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3)}), growth})))
    if (chart.heading == "Slow blow-ups") text = chart.text;
  EXPECT_TRUE(
      contains(text, " 2 rows of other rules, beside their limits, stand in the table stability-growth alone."));
}

Table resolution(std::vector<Row> rows) {
  return table_of("adequacy-resolution",
                  {"scene", "particles along a side", "cells", "error against the finest", "sag",
                   "stiffness factor for the finest's sag", "verdict"},
                  std::move(rows));
}

TEST(ChapterWords, ASagThatRunsOnWithTheGridIsNoLimitThatIsNeared) {
  std::vector<Row> rows;
  for (const auto& [scene, sag] :
       {std::pair<const char*, double (*)(double)>{"endless", [](double cells) { return 1 + 0.1 * std::log(cells); }},
        {"settles", [](double cells) { return 1.4 - 1 / cells; }},
        {"still", [](double cells) { return 1 + 1e-7 * cells; }}})
    for (const long n : {8l, 12l, 16l, 24l}) {
      const auto cells = static_cast<double>(n - 1);
      rows.push_back({scene, n, cells, n < 24 ? Cell(1 / cells) : Cell(), sag(cells), 1., "ok"});
    }
  const auto charts = charts_of(adequacy_charts, rows_of({resolution(rows)}));
  const std::string said = figure_info(charts.at(0))->finding;
  EXPECT_TRUE(contains(said, "On endless the sag at rest grows with the logarithm of the number of cells"));
  EXPECT_FALSE(contains(said, "settles"));
  EXPECT_FALSE(contains(said, "still"));
}

TEST(ChapterWords, GridsWhoseFinestRunFailsKeepTheirTable) {
  const auto charts =
      charts_of(adequacy_charts, rows_of({resolution({{"flag", 8l, 7., Cell(), Cell(), Cell(), "ok"},
                                                      {"flag", 16l, 15., Cell(), Cell(), Cell(), "stretch"}})}));
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(charts[0].figure));
  EXPECT_EQ(charts[0].tables.at(0).rows.at(0), (std::vector<std::string>{"8", "no rest"}));
  EXPECT_TRUE(contains(charts[0].text, "Runs that failed: flag with 16 particles along a side (overstretched)."));
}

TEST(ChapterWords, BendSpringsStiffenByTheirNumberAndTheRestIsSaidToBeUnexplained) {
  const auto bending = [](double shift) {  // k goes as the fourth power of particles - shift
    Table t = table_of("adequacy-bending", {"particles along a line", "cells", "stiffness of bend springs"}, {});
    for (const long n : {8l, 10l, 12l, 16l})
      t.add({n, static_cast<double>(n) - 1.5, std::pow(static_cast<double>(n) - shift, 4)});
    return t;
  };
  const Table power = table_of("adequacy-scaling", {"scene", "quantity", "exponent", "standard error"},
                               {{"", std::string(stiffness_for_droop), 4.24, 0.03}});
  EXPECT_TRUE(contains(bend_sentence(rows_of({bending(2), power})), "4.00 ± 0.00: nearly all of the difference"));
  EXPECT_TRUE(contains(bend_sentence(rows_of({bending(2.2), power})), "only a part of the difference"));
  EXPECT_TRUE(contains(bend_sentence(rows_of({bending(4), power})), "The difference is not explained."));
  EXPECT_EQ(bend_sentence({}), "");
}

}  // namespace
}  // namespace crosscheck
