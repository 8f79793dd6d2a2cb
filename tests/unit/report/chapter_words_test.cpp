// Findings and charts on stability, energy and the smallest model, from hand-made tables. They must agree with the
// rows, even if rows are missing, contain failures, or contradict theory.

#include <algorithm>
#include <set>

#include "experiments/scenes/scenes.h"
#include "experiments/tables/adequacy.h"
#include "experiments/tables/cost.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/matrix.h"
#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/stability.h"
#include "experiments/tables/stiffness.h"
#include "report/figures/charts.h"
#include "report/findings/findings.h"
#include "report/findings/summaries.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/made_up_findings.h"

namespace crosscheck {
namespace {

using namespace testing_tools;
TableSet rows_of(std::vector<Table> tables) {
  TableSet rows;
  for (const Table& t : tables) rows.add(t);
  return rows;
}
std::vector<Chart> charts_of(std::vector<Chart> (*make)(const ChartInput&), const TableSet& rows) {
  const std::vector<Scene> scenes;
  const std::vector<SceneData> facts;
  return make({scenes, facts, rows, "commit"});
}

Table stability(const std::vector<LimitRow>& rows) {
  Table t = crosscheck::table_of<LimitRow>();
  for (const LimitRow& row : rows) add(t, row);
  return t;
}
LimitRow limit_row(const std::string& method, double predicted, double held, double failed,
                   LimitState state = LimitState::rest) {
  const double limit = std::sqrt(held * failed);
  LimitRow row{.scene = "s",
               .method = method,
               .state = state,
               .predicted = predicted,
               .measured = limit,
               .held = held,
               .failed = failed,
               .deviation = limit / predicted - 1,
               .above = Verdict::energy,
               .steps = 4000,
               .reason = ""};
  return row;
}
LimitRow words_row(const std::string& method, PredictionKind theory, std::optional<double> predicted,
                   MeasuredLimit::Kind run, std::optional<double> held, std::optional<double> failed) {
  return {.scene = "s",
          .method = method,
          .prediction = theory,
          .predicted = predicted,
          .measurement = run,
          .held = held,
          .failed = failed,
          .steps = 4000,
          .reason = ""};
}

/// Effective stiffnesses from the sag of a cloth, and from the period of a chain.
TableSet effective_stiffnesses() {
  Table table = crosscheck::table_of<EffectiveStiffnessRow>();
  for (const std::string net : {"chain of 8", "cloth of 6 x 6"})
    for (const double step : {1. / 60, 1. / 240})
      for (const auto& [method, n, left] : {std::tuple{"bullet/pbd", 1, 0.25},
                                            {"bullet/pbd", 16, 0.2},
                                            {"mysim/xpbd", 1, 0.5},
                                            {"mysim/xpbd", 16, 0.98},
                                            {"bullet/deformable-implicit", 1, 1.}}) {
        const double part = step < 1. / 100 ? std::sqrt(left) : left;
        add(table,
            EffectiveStiffnessRow{
                .net = net, .method = method, .step = step, .iterations = n, .by_sag = part, .by_period = part / 2});
      }
  return rows_of({table});
}

TEST(StiffnessFigures, ShowTheClothBySagAndTheChainByPeriod) {
  const auto charts = charts_of(stiffness_charts, effective_stiffnesses());
  ASSERT_EQ(charts.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const Figure& f = std::get<Figure>(charts[i].figure);
    EXPECT_EQ(f.name, i == 0 ? "stiffness-effective" : "stiffness-effective-period");
    ASSERT_EQ(f.curves.size(), 4u) << "a world without iterations is in the table only";
    EXPECT_EQ(f.curves[1].title, "16 iterations of pbd");
    EXPECT_EQ(f.curves[2].title, "1 sub-step of xpbd");
    ASSERT_EQ(f.curves[1].points.size(), 2u);
    EXPECT_DOUBLE_EQ(f.curves[1].points.back().second, i == 0 ? 20 : 10);  // %, at the longest step
    std::set<std::string> colours;
    for (const Curve& curve : f.curves) colours.insert(curve.style.colour);
    EXPECT_EQ(colours.size(), 4u) << "curves of the same colour would share a name";
    EXPECT_EQ(f.finding,
              i == 0 ? "At a step of 16.7 ms with 16 iterations of pbd, the cloth is 5 times softer than specified."
                     : "At a step of 16.7 ms with 16 iterations of pbd, the chain is 10 times softer than "
                       "specified.");
    EXPECT_FALSE(drawing_of(f).script.empty());
  }
}

TEST(StabilityFindings, LimitsThatTheoryConfirmsAreCountedWithDeviationAndBracket) {
  const TableSet rows = rows_of(
      {stability({limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3),
                  limit_row("mysim/implicit-midpoint", 1e-3, 0.9e-3, 1.35e-3),  // coarse
                  words_row("mysim/xpbd", PredictionKind::every_step, {}, MeasuredLimit::every_step, 1., {})})});
  const Finding f = the(limit_findings(rows), "step-limits");
  expect_short({f});
  EXPECT_EQ(f.words.at("confirmed"), "2");
  EXPECT_EQ(f.words.at("all"), "2");
  EXPECT_NEAR(f.value, 5e-5, 1e-5) << "the deviation; the bracket is stated separately";
  EXPECT_EQ(f.words.at("bracket"), "50 %");
}

TEST(StabilityFindings, ContradictionsAreCountedAndTheFurthestIsNamed) {
  std::vector<LimitRow> limits{
      limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3), limit_row("mysim/explicit-euler", 1e-6, 4.99e-5, 5.01e-5),
      words_row("bullet/x", PredictionKind::limit, 1., MeasuredLimit::refused_above, 0.5, {})};  // not counted
  const auto apart = [&] { return the(limit_findings(rows_of({stability(limits)})), "step-limits-apart"); };
  EXPECT_EQ(apart().value, 1);
  EXPECT_TRUE(says(sentence_of(apart()), {"1 of 2", "explicit-euler", "50 times"}));
  limits.push_back(words_row("bullet/pbd", PredictionKind::limit, 1e-3, MeasuredLimit::every_step, 1., {}));
  limits.push_back(words_row("mysim/leapfrog", PredictionKind::limit, 1e-3, MeasuredLimit::no_step, {}, 1e-6));
  limits.push_back(limit_row("mysim/rk4", 1e-3, 2e-3, 2.01e-3, LimitState::start));
  EXPECT_EQ(apart().value, 3);
  EXPECT_EQ(apart().method, "bullet/pbd") << "a row without a step on one side differs most";
  EXPECT_TRUE(says(sentence_of(apart()), {"every step tried", "1 ms"}));
  const auto all = limit_findings(rows_of({stability(limits)}));
  expect_short(all);
  EXPECT_EQ(rules_of(all), (std::vector<std::string>{"step-limits", "step-limits-apart", "step-limits-apart.start"}));
  EXPECT_EQ(all[2].value, 1);
}

TEST(StabilityFindings, TheTruthConfirmsLimitsOfScenesWithoutRest) {
  const auto row = [](const std::string& method, double below, double above) {
    LimitRow limit = limit_row(method, 3.64e-3, 3.617e-3, 3.623e-3, LimitState::start);
    limit.step_below = 3.33e-3, limit.error_below = below, limit.step_above = 4e-3, limit.error_above = above;
    limit.motion = 0.3, limit.truth_bar = 4e-5;
    return limit;
  };
  const auto said = [](const std::vector<LimitRow>& limits) {
    return the(stability_findings(rows_of({stability(limits)})), "limits-by-truth");
  };
  const Finding both = said({row("mysim/leapfrog", 3e-3, 0.06), row("mysim/rk4", 6e-3, 0.09)});
  expect_short({both});
  EXPECT_EQ(both.value, 2);
  EXPECT_TRUE(says(sentence_of(both), {"2 of 2", "at most 2 %", "at least 20 %"}));
  // `failed`: leapfrog's run above its limit agrees with the truth; `held`: in addition, rk4's run below its limit
  // differs much from the truth
  const Finding failed = said({row("mysim/leapfrog", 3e-3, 0.02), row("mysim/rk4", 3e-3, 0.09)}),
                held = said({row("mysim/leapfrog", 3e-3, 0.02), row("mysim/rk4", 0.042, 0.09)});
  expect_short({failed, held});
  EXPECT_EQ(failed.value, 1);
  EXPECT_TRUE(says(sentence_of(failed), {"1 of 2", "leapfrog", "4 ms", "6.7 %"}));
  EXPECT_EQ(held.value, 0);
  EXPECT_TRUE(says(sentence_of(held), {"0 of 2", "rk4", "3.33 ms", "14 %"}));
  const auto without = stability_findings(rows_of({stability({limit_row("mysim/rk4", 1e-3, 2e-3, 2.01e-3)})}));
  EXPECT_FALSE(std::ranges::count(rules_of(without), "limits-by-truth"));
}

TEST(StabilityFindings, MethodsWithoutAStableStepAndTheRateOfTheirGrowth) {
  Table growth = crosscheck::table_of<GrowthRow>();
  for (const auto& [share, deviation] : {std::pair{std::optional<double>(), 2e-3}, {std::optional(0.98), 0.5}})
    add(growth,
        GrowthRow{.scene = "s", .method = "mysim/trapezoidal", .share_of_limit = share, .deviation = deviation});
  const auto all = stability_findings(rows_of(
      {stability({words_row("mysim/trapezoidal", PredictionKind::no_step, {}, MeasuredLimit::no_step, {}, 1e-6)}),
       growth}));
  expect_short(all);
  EXPECT_EQ(the(all, "no-stable-step").method, "mysim/trapezoidal");
  EXPECT_DOUBLE_EQ(the(all, "growth").value, 0.2) << "near a limit the growth is measured elsewhere";
}

TEST(ChapterWords, LimitsWithoutTheoryStandInATableWithoutFigure) {
  LimitRow limit = words_row("bullet/pbd", PredictionKind::none, {}, MeasuredLimit::found, 0.329, 0.331);
  limit.measured = 0.33, limit.above = Verdict::energy, limit.reason = "its own";
  const Table t = stability({limit});
  const auto charts = charts_of(stability_charts, rows_of({t}));
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(charts[0].figure));
  ASSERT_EQ(charts[0].tables.size(), 1u);
  const std::vector<std::string> expected{"bullet/pbd", "–", "330.00", "its own"};
  EXPECT_EQ(charts[0].tables[0].rows.at(0), expected);
  EXPECT_TRUE(contains(charts[0].text, "Runs took 4000 steps."));
}

TEST(ChapterWords, ARunAboveItsLimitIsShownAtItsMoments) {
  Table failure = crosscheck::table_of<FailureRow>();
  for (const auto& [scene, steps] : {std::pair{"spring", 2}, {"chain", 9}})
    for (int i = 1; i <= steps; ++i)
      add(failure, FailureRow{.scene = scene,
                              .method = "mysim/leapfrog",
                              .h = 0.35,
                              .limit = 0.2,
                              .growth = 100.,
                              .step = i,
                              .t = 0.35 * i,
                              .kinetic = i < 5 ? 1e-3 : 1e-3 * std::pow(50, i - 4),
                              .holding = 1e-3,
                              .still = steps > 2 && i > 5});
  const std::vector<Scene> scenes{load_scene("spring"), load_scene("chain")};
  const std::vector<SceneData> facts;
  const TableSet rows = rows_of({stability({limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3)}), failure});
  const auto charts = stability_charts({scenes, facts, rows, "commit"});
  const auto chart = std::ranges::find(charts, true, &Chart::shown);
  ASSERT_NE(chart, charts.end());
  const Figure& f = std::get<Figure>(chart->figure);
  EXPECT_TRUE(says(f.title, {"leapfrog", "chain", "350 ms", "1.75 times"}));
  EXPECT_EQ(f.curves.at(0).points.size(), 9u);
  EXPECT_EQ(f.curves.at(1).points.size(), 9u);
  EXPECT_TRUE(says(f.finding, {"100 times", "50 to 50 times"})) << f.finding;
  ASSERT_EQ(chart->snapshots.size(), 1u);
  ASSERT_EQ(chart->snapshots[0].moments.size(), 4u);
  EXPECT_DOUBLE_EQ(chart->snapshots[0].moments[0].first, 0.35 * 6);
  EXPECT_TRUE(contains(chart->snapshots[0].moments[0].second, "step 6\n2.5 J"));
  // no failure is shown if all of them are too fast to be visible
  failure.rows.resize(2);
  const TableSet fast = rows_of({stability({limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3)}), failure});
  for (const Chart& each : stability_charts({scenes, facts, fast, "commit"})) EXPECT_FALSE(each.shown);
}

Table energy(const std::vector<EnergyRow>& rows) {
  Table t = crosscheck::table_of<EnergyRow>();
  for (const EnergyRow& row : rows) add(t, row);
  return t;
}
/// A long run on a spring, with 4 J of exchanged energy.
EnergyRow long_run(const std::string& method, double largest, double growth, Verdict verdict = Verdict::ok) {
  return {.scene = "spring",
          .method = method,
          .verdict = verdict,
          .reason = "",
          .end = verdict == Verdict::ok ? 100. : 3.,
          .step = 5e-3,
          .steps = 20000,
          .undamped = true,
          .symplectic = true,
          .closure_claimed = true,
          .turned_over = 4,
          .largest_residual = largest,
          .residual = -largest,
          .growth = growth};
}

TEST(EnergyFindings, DriftIsComputedAndFailedRunsAreSaid) {
  const EnergyRow kept = long_run("mysim/leapfrog", 4e-3, 0.01),
                  drifts = long_run("mysim/symplectic-euler", 0.04, 0.98),
                  fails = long_run("mysim/suzuki4", 40, 2, Verdict::stretch);
  auto findings = energy_findings(rows_of({energy({kept})}));
  EXPECT_DOUBLE_EQ(the(findings, "symplectic-energy").value, 0.1);
  EXPECT_TRUE(says(sentence_of(findings[0]), {"20 000", "0.1 %", "1 of 1"}));
  findings = energy_findings(rows_of({energy({kept, drifts, fails})}));
  expect_short(findings);
  EXPECT_EQ(rules_of(findings),
            (std::vector<std::string>{"symplectic-energy", "symplectic-drift", "energy-failed.symplectic"}));
  EXPECT_DOUBLE_EQ(findings[0].value, 1);
  EXPECT_TRUE(contains(sentence_of(findings[0]), "1 of 3"));
  EXPECT_EQ(findings[1].method, "mysim/symplectic-euler");
  EXPECT_EQ(findings[1].words.at("how"), "drifts down");
  EXPECT_EQ(findings[2].value, 3);
  EXPECT_TRUE(says(sentence_of(findings[2]), {"spring", "suzuki4", "3 s", "overstr"}));
}

TEST(EnergyFindings, RulesThatAreNotSymplecticFailDampOrAdd) {
  EnergyRow euler = long_run("mysim/explicit-euler", 40, 2, Verdict::energy), pbd = long_run("bullet/pbd", 1, 0),
            mine = long_run("exec:./mine", 0.4, 0);
  euler.symplectic = pbd.symplectic = mine.symplectic = false;
  pbd.equivalent_drag = 0.11, mine.residual = 0.4;
  const auto all = energy_findings(rows_of({energy({long_run("mysim/leapfrog", 4e-3, 0.01), euler, pbd, mine})}));
  expect_short(all);
  EXPECT_EQ(rules_of(all), (std::vector<std::string>{"symplectic-energy", "energy-failed"}));
}

TEST(EnergyFindings, WhatContactTakesIsHeldAgainstTheTruthAndNothingIsSaidBelowItsBar) {
  const auto said = [](double bar) {
    Table rows = crosscheck::table_of<EngineEnergyRow>();
    for (const auto& [method, taken] : {std::pair{"mysim/symplectic-euler", 11.31},
                                        {"mysim/leapfrog", 11.11},
                                        {"mysim/implicit-euler", 10.46},
                                        {"bullet/deformable-explicit", 11.14},
                                        {"bullet/pbd", 9.},
                                        {"mysim/symplectic-euler+sticky", 5.}})
      add(rows, EngineEnergyRow{.scene = "drape",
                                .method = method,
                                .contact_inferred = std::string_view(method).starts_with("bullet"),
                                .contact = taken,
                                .contact_in_truth = 11.1,
                                .contact_bar = bar,
                                .contact_until = 0.48});
    return energy_findings(rows_of({rows}));
  };
  const Finding f = the(said(0.05), "contact-energy");
  expect_short({f});
  EXPECT_TRUE(says(sentence_of(f), {"11.10 ± 0.05 J", "480 ms", "symplectic-euler +1.9 %", "implicit-euler −5.8 %",
                                    "deformable-explicit 0 ± 0.45 %"}));
  EXPECT_NEAR(f.value, 100 * 0.21 / 11.1, 1e-9);
  EXPECT_NEAR(*f.low, 100 * 0.16 / 11.1, 1e-9);
  EXPECT_TRUE(said(1.2).empty()) << "the bar exceeds a tenth of the value";
}

TEST(EnergyFindings, DampingNamesWhoWasAsked) {
  const auto damping = [](const std::string& method, std::vector<std::array<double, 3>> points) {
    Table t = crosscheck::table_of<DampingRow>();
    for (const auto& [h_omega, drag, theory] : points)
      add(t, DampingRow{.method = method,
                        .step = h_omega / 10,
                        .h_omega = h_omega,
                        .equivalent_drag = drag,
                        .by_theory = theory});
    return t;
  };
  const Table t = damping("bullet/pbd", {{0.1, 0.995, 0.99503}, {1., 6.93, 6.9315}});
  const Finding f = the(energy_findings(rows_of({t})), "numerical-damping");
  EXPECT_EQ(f.method, "bullet/pbd");
  EXPECT_NEAR(f.value, 0.0216, 1e-4);
  EXPECT_TRUE(contains(sentence_of(f), "at h ω = 0.1, as strongly as a drag of 0.10 ω"));
  EXPECT_TRUE(contains(figure_info(charts_of(energy_charts, rows_of({t})).at(0))->finding, "in 2 measurements"));
  const Table none = damping("bullet/deformable-explicit", {{0.1, 1e-9, 0.}});
  EXPECT_TRUE(energy_findings(rows_of({none})).empty());
  EXPECT_TRUE(begins(figure_info(charts_of(energy_charts, rows_of({none})).at(0))->finding, "In theory none of"));
}

template <class Row>
Table table_with(const std::vector<Row>& rows) {
  Table t = crosscheck::table_of<Row>();
  for (const Row& row : rows) add(t, row);
  return t;
}

TEST(EnergyFindings, NameTheEngineThatDampsMostAndThoseThatGainEnergy) {
  const auto answer = [](const char* method, EngineQuestion question, OptionalNumber value, OptionalNumber bar) {
    return MatrixRow<false>{.method = method, .question = question, .value = value, .bar = bar, .unit = "1/s"};
  };
  const auto spring = EngineQuestion::damping_of_spring, forces = EngineQuestion::damping_by_forces;
  const std::vector rows{answer("mysim/implicit-euler", spring, 2., 1e-6),
                         answer("exec:./ode", spring, 1e-9, 1e-7),
                         answer("exec:./one", spring, 0.2, 0.003),
                         answer("exec:./two", spring, 0.87, 0.01),
                         answer("exec:./one", forces, -0.33, 0.001),
                         answer("exec:./two", forces, -0.1, 0.2),
                         answer("exec:./bad", spring, {}, {})};
  const Finding f = the(energy_findings(rows_of({table_with(rows)})), "engines-damp");
  expect_short({f});
  EXPECT_EQ(f.method, "exec:./two");
  EXPECT_EQ(f.value, 0.87);
  EXPECT_NEAR(*f.low, 0.86, 1e-12);
  EXPECT_NEAR(*f.high, 0.88, 1e-12);
  EXPECT_EQ(f.words.at("none"), "ode");
  EXPECT_EQ(f.words.at("others"), "one 0.2");
  EXPECT_EQ(f.words.at("gains"), "one 0.33");
  EXPECT_TRUE(energy_findings(rows_of({table_with(std::vector{rows[0], rows[1]})})).empty());
}

TEST(SpeedFindings, TellWhatOtherEnginesTake) {
  using Cheapest = CheapestRow<Cost::cpu>;
  std::vector<Cheapest> cheapest;
  const auto add_cheapest = [&](const char* scene, const char* method, const char* tied) {
    Cheapest row{.scene = scene, .part_of_motion = 0.01, .method = method};
    if (*tied) row.tied = tied;
    cheapest.push_back(row);
  };
  add_cheapest("spring", "mysim/leapfrog", ""), add_cheapest("chain", "mysim/symplectic-euler", "mysim/leapfrog");
  add_cheapest("rod", "odeint/dopri5", ""), add_cheapest("circle", "mysim/rk4", "mysim/dopri5, odeint/rk4");
  std::vector<EngineSpeedRow> engines;
  for (const auto& [scene, engine, times] : {std::tuple{"spring", "bullet", 70.},
                                             {"chain", "bullet", 8.3},
                                             {"chain", "exec:./mine", 3.},
                                             {"spring", "mysim", 1.}}) {
    EngineSpeedRow row{.scene = scene, .part_of_motion = 0.01, .engine = engine};
    row.method = std::string(engine).starts_with("exec") ? engine : engine + std::string("/x");
    row.times_mysim = times;
    engines.push_back(row);
  }
  std::vector<SpeedAccuracyRow> runs(4);
  runs[0].scene = "rod", runs[0].method = "bullet/pbd";
  runs[1].scene = "circle", runs[1].method = "bullet/pbd", runs[1].verdict = Verdict::unsupported;
  // exec:./mine has one run without a time, and one crash
  runs[2].scene = "rod", runs[2].method = "exec:./mine", runs[2].error = 9e-3, runs[2].motion = 1;
  runs[3].scene = "circle", runs[3].method = "exec:./mine", runs[3].verdict = Verdict::crash;
  const auto all = speed_findings(rows_of({table_with(cheapest), table_with(engines), table_with(runs)}));
  expect_short(all);
  const auto times = of_rule(all, "engine-times");
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].value, 70);
  EXPECT_EQ(times[0].low, 8.3);
  EXPECT_EQ(times[0].words.at("where"), "spring");
  EXPECT_TRUE(says(sentence_of(times[1]), {"1 %", "mine", "3 times"})) << sentence_of(times[1]);
  const Finding without = the(all, "engine-without-run");
  EXPECT_EQ(without.method, "bullet");
  EXPECT_EQ(without.words.at("where"), "rod");
}

TEST(SpeedFindings, AStepOfBothIsComparedLikeForLikeFirst) {
  const auto said = [&](std::vector<std::tuple<std::string, long, double>> times) {
    Table t = crosscheck::table_of<SizeCostRow>();
    for (const auto& [method, side, cpu] : times) {
      SizeCostRow row;
      row.method = method, row.side = side, row.cpu = cpu;
      add(t, row);
    }
    const auto all = cost_findings(rows_of({t}));
    expect_short(all);
    return all;
  };
  const std::string kernel = "mysim/symplectic-euler", plain = kernel + "+plain", bullet = "bullet/deformable-explicit";
  const auto all = said({{kernel, 8, 1e-6},
                         {plain, 8, 2e-6},
                         {bullet, 8, 2e-5},
                         {kernel, 64, 4e-5},
                         {plain, 64, 1.6e-4},
                         {bullet, 64, 1.76e-3}});
  EXPECT_EQ(rules_of(all), (std::vector<std::string>{"size-cost.any", "size-cost.grid"}));
  EXPECT_DOUBLE_EQ(*all[0].low, 10);
  EXPECT_DOUBLE_EQ(*all[0].high, 11);
  EXPECT_EQ(all[0].words.at("where"), "64 x 64");
  EXPECT_DOUBLE_EQ(*all[1].low, 20);
  EXPECT_DOUBLE_EQ(*all[1].high, 44);
  EXPECT_EQ(rules_of(said({{kernel, 8, 1e-6}, {bullet, 8, 2e-5}})), std::vector<std::string>{"size-cost.grid"});
  EXPECT_TRUE(said({{plain, 8, 1e-6}, {kernel, 8, 1e-6}}).empty());
}

/// A cloth that is in contact with a ball until the end at 1 s; its comparison window ends at 0.5 s.
std::vector<Table> touched(double of_rules, double of_bullet) {
  std::vector<EngineRow> runs;
  Table rows = crosscheck::table_of<EngineTimeRow>("drape-engines");
  for (const char* method :
       {"mysim/symplectic-euler", "mysim/leapfrog", "mysim/rk4", "mysim/xpbd", "bullet/deformable-explicit"}) {
    const std::string name = method;
    EngineRow run{.scene = "drape", .method = name, .reason = "", .end = 1, .window = 0.5};
    run.clearance = 1e-4;
    runs.push_back(run);
    const double apart = name.starts_with("bullet") ? of_bullet
                         : name.ends_with("xpbd")   ? 1.  // not comparable with the other rules
                         : name.ends_with("euler")  ? 0.
                                                    : of_rules;
    for (const double t : {0.5, 1.0})
      add(rows, EngineTimeRow{.method = name, .t = t, .difference = t == 1 ? apart : apart / 10});
  }
  return {table_with(runs), rows};
}

TEST(SphereFindings, AfterContactEnginesAreStatedWithTheDifferencesOfOwnRules) {
  const auto findings = contact_findings(rows_of(touched(2e-4, 2.97e-3)));
  expect_short(findings);
  const Finding f = the(findings, "after-contact");
  EXPECT_EQ(f.scene, "drape");
  EXPECT_EQ(f.other, "bullet/deformable-explicit");
  EXPECT_EQ(f.value, 2.97e-3) << "the value at the end, not the maximum";
  EXPECT_TRUE(says(sentence_of(f), {"drape", "500 ms", "3 mm", "other 2 stable rules", "0.2 mm"}));
  // unpredictable motion makes both differences large
  EXPECT_TRUE(
      says(sentence_of(the(contact_findings(rows_of(touched(0.2, 0.3))), "after-contact")), {"300 mm", "200 mm"}));
}

TEST(ChapterWords, GrowthThatIsNotShownIsCounted) {
  Table growth = crosscheck::table_of<GrowthRow>();
  add(growth, GrowthRow{.scene = "s", .method = "mysim/trapezoidal"});
  for (const double share : {0.98, 1.02})
    add(growth, GrowthRow{.scene = "s", .method = "mysim/rk4", .share_of_limit = share});
  std::string text;
  for (const Chart& chart :
       charts_of(stability_charts, rows_of({stability({limit_row("mysim/rk4", 1e-3, 0.999e-3, 1.001e-3)}), growth})))
    if (chart.heading == "Slowly growing instabilities") text = chart.text;
  EXPECT_TRUE(says(text, {"2 rows", "stability-growth"}));
}

Table resolution(const std::vector<GridRow>& rows) {
  Table t = crosscheck::table_of<GridRow>();
  for (const GridRow& row : rows) add(t, row);
  return t;
}

TEST(ChapterWords, ASagThatRunsOnWithTheGridIsNoLimitThatIsNeared) {
  std::vector<GridRow> rows;
  for (const auto& [scene, sag] :
       {std::pair<const char*, double (*)(double)>{"endless", [](double cells) { return 1 + 0.1 * std::log(cells); }},
        {"settles", [](double cells) { return 1.4 - 1 / cells; }},
        {"still", [](double cells) { return 1 + 1e-7 * cells; }}})
    for (const long n : {8l, 12l, 16l, 24l}) {
      const auto cells = static_cast<double>(n - 1);
      rows.push_back({scene, n, cells, n < 24 ? OptionalNumber(1 / cells) : std::nullopt, sag(cells), 1.});
    }
  const auto charts = charts_of(adequacy_charts, rows_of({resolution(rows)}));
  const std::string said = figure_info(charts.at(0))->finding;
  EXPECT_TRUE(says(said, {"endless", "logarithm"}));
  EXPECT_FALSE(contains(said, "settles"));
  EXPECT_FALSE(contains(said, "still"));
}

TEST(ChapterWords, GridsWhoseFinestRunFailsKeepTheirTable) {
  const auto charts =
      charts_of(adequacy_charts,
                rows_of({resolution({{.scene = "flag", .particles = 8, .cells = 7},
                                     {.scene = "flag", .particles = 16, .cells = 15, .verdict = Verdict::stretch}})}));
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(charts[0].figure));
  EXPECT_EQ(charts[0].tables.at(0).rows.at(0), (std::vector<std::string>{"8", "no rest"}));
  EXPECT_TRUE(says(charts[0].text, {"flag with 16 particles", "overstretched"}));
}

TEST(ChapterWords, BendSpringsStiffenByTheirNumber) {
  const auto bending = [](double shift) {  // k is proportional to (particles - shift)^4
    Table t = crosscheck::table_of<BendingRow>();
    for (const long n : {8l, 10l, 12l, 16l})
      add(t, BendingRow{n, static_cast<double>(n) - 1.5, std::pow(static_cast<double>(n) - shift, 4), 0.1});
    return t;
  };
  Table power = crosscheck::table_of<ScalingRow>();
  add(power, ScalingRow{"", ScalingQuantity::bend_stiffness_for_droop, 4.24, 0.03, 4});
  const auto said = [&](double shift) {
    const auto all = bend_findings(rows_of({bending(shift), power}));
    expect_short(all);
    EXPECT_EQ(all.at(0).value, 4.24);
    EXPECT_NEAR(*all[0].high - *all[0].low, 0.06, 1e-9);
    return all;
  };
  EXPECT_TRUE(contains(sentence_of(said(2).at(0)), "4.00 ± 0.00 of the springs along a line"));
  EXPECT_TRUE(bend_findings(TableSet()).empty());
}

}  // namespace
}  // namespace crosscheck
