// Findings on scenes and balls, the choice of a method, and the page's first answers, from hand-made rows.

#include "experiments/scenes/scenes.h"
#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/adequacy.h"
#include "experiments/tables/contact.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/stability.h"
#include "report/figures/charts.h"
#include "report/findings/answers.h"
#include "report/findings/evidence.h"
#include "report/findings/findings_text.h"
#include "report/findings/recommendation.h"
#include "report/findings/report_data.h"
#include "report/findings/summaries.h"
#include "report/page/page_parts.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/made_up_findings.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

MethodData run(const std::string& method, std::optional<double> error, Verdict verdict = Verdict::ok,
               long evaluations = 6000) {
  MethodData m;
  m.method = method, m.verdict = verdict, m.error = error, m.step = 5e-4, m.evaluations = evaluations;
  if (!method.starts_with(program_prefix)) m.same_rule = method == ours || method == theirs;
  return m;
}

Findings answer_findings(const std::vector<Scene>& scenes, const std::vector<SceneData>& data, const TableSet& rows) {
  Findings all = found_by_rules({rows, scenes, data}, false);
  std::erase_if(all, [](const Finding& f) { return finding_rule(f.rule).topic != "answer"; });
  return all;
}

void set_round_off(SceneData& f, std::optional<double> bound) {
  for (MethodData& m : f.methods) m.round_off_bound = bound;
}

SceneData facts(std::vector<MethodData> methods) {
  SceneData f;
  f.scene = "cloth-hang", f.motion = 1, f.window = 3, f.tier = "converged", f.error_bar = 1e-9;
  f.methods = std::move(methods);
  return f;
}

class OfAScene : public testing::Test {
 protected:
  std::vector<Finding> said(const SceneData& data) const {
    const TableSet rows;
    Facts facts(rows);
    facts.scene = &scene_, facts.of = &data;
    const std::vector<Finding> all = scene_findings(facts);
    expect_short(all);
    for (const Finding& f : all) EXPECT_EQ(f.scene, scene_.name);
    return all;
  }
  const Scene scene_ = load_scenes({"cloth-hang"})[0];
};

TEST_F(OfAScene, TheNearestIsNamedWithItsErrorBar) {
  const Finding best = the(said(facts({run("mysim/suzuki4", 1e-8, Verdict::ok, 30000), run("mysim/leapfrog", 2e-5),
                                       run("bullet/pbd", 5e-3), run("truth/converged", 0.)})),
                           "nearest");
  EXPECT_EQ(best.method, "mysim/suzuki4");
  EXPECT_EQ(best.value, 1e-8);
  EXPECT_DOUBLE_EQ(*best.low, 0.9e-8);
  EXPECT_DOUBLE_EQ(*best.high, 1.1e-8);
  EXPECT_EQ(best.tier, "converged");
}

TEST_F(OfAScene, OfSeveralThatAreAsNearTheThriftiestIsNamed) {
  const Finding f = the(said(facts({run("mysim/implicit-euler", 1e-2, Verdict::ok, 18000),
                                    run("mysim/symplectic-euler", 1.0001e-2), run("mysim/explicit-euler", 2e-2)})),
                        "nearest");
  EXPECT_EQ(f.method, "mysim/symplectic-euler");
  EXPECT_EQ(f.words.at("others"), "implicit-euler");
}

TEST_F(OfAScene, NothingIsSaidBelowTheErrorBar) {
  SceneData f = facts({run("mysim/rk4", 1e-4)});
  f.error_bar = 2e-3;
  const Finding nearest = the(said(f), "nearest");
  EXPECT_EQ(nearest.value, 2e-3);
  EXPECT_EQ(nearest.low, 0);
  EXPECT_EQ(nearest.words.at("off"), "< 2 mm");
}

TEST_F(OfAScene, FailuresAreCountedAndTheFirstIsNamed) {
  SceneData f = facts({run("mysim/rk4", 1e-4), run("mysim/explicit-euler", {}, Verdict::energy),
                       run("mysim/trapezoidal", {}, Verdict::stretch), run("bullet/pbd", {}, Verdict::unsupported)});
  f.methods[1].end = 2, f.methods[2].end = 1, f.methods[2].step_limit = 1e-4;
  const Finding failed = the(said(f), "failed");
  EXPECT_EQ(failed.value, 2);
  EXPECT_EQ(failed.method, "mysim/trapezoidal");
  EXPECT_TRUE(says(sentence_of(failed), {"500 µs", "2 of 3", "Heun", "1 s", "100 µs"}));
  f.methods[2].verdict = Verdict::ok, f.methods[2].error = 1;
  EXPECT_TRUE(says(sentence_of(the(said(f), "failed")), {"500 µs", "1 of 3", "explicit-euler", "2 s"}));
}

TEST_F(OfAScene, AgreementIsOneOfFourRules) {
  SceneData f = facts({run(ours, 1e-3), run(theirs, 1e-3)});
  MethodData& peer = f.methods[1];
  const auto rule = [&] {
    for (const Finding& each : said(f))
      if (each.other == theirs) return each.rule;
    return std::string();
  };
  EXPECT_EQ(rule(), "") << "there is no comparison";
  peer.difference = 1e-12, set_round_off(f, 1e-11);
  EXPECT_EQ(rule(), "same-rule");
  peer.difference = 1e-9;
  EXPECT_EQ(rule(), "same-rule.differs");
  set_round_off(f, {});
  EXPECT_EQ(rule(), "chaotic");
  peer.different_law = "drag";
  EXPECT_EQ(rule(), "same-rule.different");
  peer.clearance = 0;
  EXPECT_EQ(rule(), "same-rule.contact");
  peer.verdict = Verdict::energy;
  EXPECT_EQ(rule(), "") << "failed runs are not compared";
}

TEST_F(OfAScene, AgreementOfAProgramIsJudgedByTheRuleFound) {
  SceneData f = facts({run(ours, 1e-3), run("exec:./mine", 1e-3)});
  set_round_off(f, 1e-11), f.methods[1].difference = 1e-12;
  EXPECT_TRUE(
      says(sentence_of(the(said(f), "same-rule.same-motion")), {"mine", "symplectic-euler", "1.0e-12 m", "1.0e-11 m"}));
  f.methods[1].difference = 1e-9;
  EXPECT_EQ(the(said(f), "same-rule.unknown").value, 1e-9);
  f.methods[1].same_rule = true;
  EXPECT_EQ(the(said(f), "same-rule.differs").value, 1e-9);
  f.methods[1].round_off_bound = 1e-8;  // single precision
  EXPECT_EQ(the(said(f), "same-rule").value, 1e-9);
  f.methods[1].same_rule = false;
  EXPECT_EQ(the(said(f), "same-rule.different").other, "exec:./mine");
}

TEST_F(OfAScene, WithoutBulletNoSentenceSpeaksOfIt) {
  SceneData f = facts({run(ours, 1e-3), run("mysim/explicit-euler", {}, Verdict::energy), run("exec:./mine", 2e-3)});
  f.methods[2].difference = 1e-3;
  const auto all = said(f);
  for (const Finding& each : all) EXPECT_FALSE(contains(sentence_of(each), "Bullet")) << sentence_of(each);
  EXPECT_EQ(the(all, "same-rule.unknown").other, "exec:./mine");
}

Table least(const std::vector<LeastModelRow>& rows) {
  Table t = table_of<LeastModelRow>();
  for (const LeastModelRow& row : rows) add(t, row);
  return t;
}
LeastModelRow least_row(ToleranceKind kind, double tolerance, const std::string& left_out, double unseen, bool holds,
                        const std::string& scene = "cloth-hang") {
  return {.scene = scene,
          .tolerance = tolerance,
          .tolerance_is = kind,
          .least_model = "",
          .left_out = left_out,
          .unseen_error_1 = 5e-3,
          .unseen_error_2 = unseen,
          .unseen_error_3 = unseen,
          .holds = holds,
          .cost_of_full = left_out.empty() ? 1 : 0.67};
}

TEST(LeastModels, HaveARowForEachThingThatIsSaid) {
  TableSet rows;
  rows.add(least({least_row(ToleranceKind::of_scene, 1e-3, "", 1, true),
                  least_row(ToleranceKind::hundredth_of_motion, 0.01, "shear springs", 0.02, false),
                  least_row(ToleranceKind::tenth_of_motion, 0.1, "bend springs", 0.02, true),
                  least_row(ToleranceKind::of_scene, 1e-3, "", 1, true, "chain"),
                  least_row(ToleranceKind::tenth_of_motion, 0.1, "", 1, true, "chain")}));
  const auto findings = adequacy_findings(rows);
  expect_short(findings);
  EXPECT_EQ(rules_of(findings),
            (std::vector<std::string>{"least-model.full", "least-model-fails", "least-model", "least-model-none"}));
  EXPECT_EQ(findings[1].value, 2);
  EXPECT_DOUBLE_EQ(findings[2].value, 33);
  EXPECT_EQ(findings[2].scene, "cloth-hang");
  EXPECT_EQ(findings[3].value, 1);
  EXPECT_TRUE(says(sentence_of(findings[2]), {"cloth-hang", "bend springs", "10 %", "33 %"}));
}

TEST(LeastModels, WhatHoldsAtSeveralTolerancesIsSaidOnce) {
  TableSet rows;
  rows.add(least({least_row(ToleranceKind::hundredth_of_motion, 0.01, "bend springs", 5e-3, true),
                  least_row(ToleranceKind::tenth_of_motion, 0.1, "bend springs", 5e-3, true)}));
  EXPECT_TRUE(contains(sentence_of(the(adequacy_findings(rows), "least-model")), "within 1 % and 10 %"));
  EXPECT_EQ(ingredients_text("shear springs, bend springs, drag"), "shear, bend springs and drag");
  EXPECT_EQ(ingredients_text("shear springs, bend springs"), "shear and bend springs");
  EXPECT_EQ(ingredients_text("a, b, c, d"), "4 ingredients");
  EXPECT_EQ(ingredients_text(""), "nothing");
}

/// Provides runs of methods with their costs, on a scene whose motion is 1 m, and a row for the cheapest run with an
/// error of at most 1 %.
class Take : public testing::Test {
 protected:
  /// Adds a run. A successful run is accompanied by another with half the step.
  void add_run(const std::string& method, double step, double error, double cpu, Verdict verdict = Verdict::ok) {
    SpeedAccuracyRow run;
    run.scene = scene, run.method = method, run.requested = run.step = step, run.verdict = verdict, run.motion = 1;
    run.truth = "converged", run.truth_bar = 1e-6, run.evaluations = std::lround(1e5 * cpu);
    if (verdict == Verdict::ok) run.error = error;
    add(runs_, run);
    if (verdict == Verdict::ok) {
      SpeedAccuracyRow finer = run;
      finer.requested = finer.step = step / 2, finer.error = error / 4, finer.evaluations *= 2;
      add(runs_, finer);
    }
    SpeedAccuracyCostRow cost;
    cost.scene = scene, cost.method = method, cost.requested = step, cost.cpu = cpu;
    if (verdict != Verdict::ok) cost.verdict = RunEnd::failed;
    add(costs_, cost);
  }
  void add_cheapest(const std::string& method, double step, double error, double cpu, const std::string& tied = "") {
    CheapestRow<Cost::cpu> row;
    row.scene = scene, row.part_of_motion = row.bound = 0.01;
    row.method = method, row.setting = SettingKind::step, row.requested = step, row.distance = error, row.cost = cpu;
    if (!tied.empty()) row.tied = tied;
    add(cheapest_, row);
    for (const auto& [method_beside, times] :
         {std::pair{"bullet/pbd", 25.}, {"odeint/rk4", 2.}, {"exec:./mine", 30.}}) {
      EngineSpeedRow beside;
      beside.scene = scene, beside.part_of_motion = 0.01, beside.engine = beside.method = method_beside;
      if (beside.engine.starts_with("bullet")) beside.engine = "bullet";
      beside.cpu = times * cpu;
      beside.times_mysim = times, beside.times_mysim_low = 0.9 * times, beside.times_mysim_high = 1.1 * times;
      add(engines_, beside);
    }
  }
  TableSet rows() const {
    TableSet all;
    for (const Table& table : {runs_, costs_, cheapest_, engines_}) all.add(table);
    return all;
  }
  std::string scene = "cloth-hang";
  Table runs_ = table_of<SpeedAccuracyRow>(), costs_ = table_of<SpeedAccuracyCostRow>(),
        cheapest_ = table_of<CheapestRow<Cost::cpu>>(), engines_ = table_of<EngineSpeedRow>();
};

TEST_F(Take, OfRunsOfTheSameCostTheNearestIsTakenWhateverTheClockSays) {
  add_run("mysim/symplectic-euler", 2e-3, 8e-3, 0.10);
  add_run("mysim/leapfrog", 2e-3, 7e-4, 0.101);
  add_run("mysim/rk4", 4e-3, 5e-3, 0.102);
  add_run("bullet/deformable-explicit", 4e-3, 5e-3, 0.05);
  add_cheapest("mysim/symplectic-euler", 2e-3, 8e-3, 0.10);
  const auto run = recommended_run(scene, 0.01, rows());
  ASSERT_TRUE(run);
  EXPECT_EQ(run->method, "mysim/leapfrog");
  EXPECT_EQ(run->requested, 2e-3);
  EXPECT_EQ(run->error, 7e-4);
  EXPECT_EQ(run->cost, 0.101);
  EXPECT_EQ(run->evaluations, 10100);
  EXPECT_EQ(run->motion, 1);
  EXPECT_EQ(run->tied, (std::vector<std::string>{"mysim/symplectic-euler", "mysim/rk4"}));
  ASSERT_EQ(run->beside.size(), 2u) << "integrators with our right-hand side are not engines";
  EXPECT_EQ(run->beside[0].engine, "bullet");
  EXPECT_DOUBLE_EQ(run->beside[0].times, 25 * 0.10 / 0.101) << "relative to the recommended run";
  EXPECT_EQ(run->beside[1].engine, "exec:./mine");

  const std::vector<Scene> scenes = load_scenes({scene});
  const TableSet tables = rows();
  Facts facts(tables);
  facts.scene = &scenes[0];
  const auto all = recommendation_findings(facts);
  expect_short(all);
  EXPECT_EQ(rules_of(all), std::vector<std::string>{"take"});
  EXPECT_EQ(all[0].method, "mysim/leapfrog");
  EXPECT_DOUBLE_EQ(all[0].value, 0.07);
  EXPECT_EQ(all[0].words.at("tied"), "symplectic-euler and rk4");
  EXPECT_FALSE(recommended_run(scene, 1e-5, rows())) << "no run is this accurate";
  EXPECT_FALSE(recommended_run("chain", 0.01, rows()));
  EXPECT_FALSE(recommended_run(scene, 0.01, {}));
}

TEST_F(Take, WhatBindsTheStepIsWhatTheNextLongerOneDid) {
  add_run("mysim/leapfrog", 1e-3, 1e-3, 0.2);
  add_run("mysim/leapfrog", 4e-3, 0, 0, Verdict::energy);
  add_run("mysim/rk4", 2e-3, 0, 0, Verdict::energy);
  add_cheapest("mysim/leapfrog", 1e-3, 1e-3, 0.2);
  EXPECT_EQ(recommended_run(scene, 0.01, rows())->bound, "stability");
  add_run("mysim/leapfrog", 2e-3, 0.02, 0.1);  // stable but inaccurate
  EXPECT_EQ(recommended_run(scene, 0.01, rows())->bound, "accuracy");
}

TEST_F(Take, TheLongestStepThatWasTriedIsBoundBySampling) {
  add_run("mysim/leapfrog", 1e-3, 1e-3, 0.2);
  add_cheapest("mysim/leapfrog", 1e-3, 1e-3, 0.2);
  EXPECT_EQ(recommended_run(scene, 0.01, rows())->bound, "sampling");
}

TEST_F(Take, IsRingedInItsChartBesideTheCriticalStepOfItsRule) {
  add_run("mysim/leapfrog", 1e-3, 1e-3, 0.2);
  add_run("mysim/leapfrog", 4e-3, 0, 0, Verdict::energy);
  add_run("bullet/pbd", 4e-3, 0.02, 0.1);
  for (auto& row : runs_.rows)
    for (size_t c = 0; c < runs_.columns.size(); ++c)
      if (runs_.columns[c].name == "truth bar") row[c] = 1e-9;
  add_cheapest("mysim/leapfrog", 1e-3, 1e-3, 0.2);
  const std::vector<Scene> scenes = load_scenes({scene});
  const std::vector<SceneData> facts;
  TableSet all = rows();
  const auto drawn = [&] {
    for (const Chart& chart : speed_accuracy_charts({scenes, facts, all, "commit"}))
      if (const auto* f = std::get_if<Figure>(&chart.figure); f && f->from_costs) return *f;
    return Figure{};
  };
  const Figure free = drawn();
  const OnPage& page = free.on_page;
  ASSERT_EQ(free.guides.size(), 1u) << "no stability limit is known";
  EXPECT_EQ(free.guides[0].at, scenes[0].duration) << "the line of real time";
  ASSERT_TRUE(page.take);
  EXPECT_EQ(page.take->x, 0.2);
  EXPECT_DOUBLE_EQ(page.take->y, 0.1) << "in % of the motion";
  EXPECT_EQ(page.take->name, "recommended: 1 ms");
  EXPECT_EQ(page.take->more, "0.1 %, 200 ms");
  Table limits = table_of<LimitRow>();
  LimitRow row;
  row.scene = scene, row.method = "mysim/leapfrog", row.predicted = 2e-3, row.omega = 1000;
  add(limits, row);
  all.add(limits);
  const Figure bound = drawn();
  ASSERT_EQ(bound.guides.size(), 2u);
  EXPECT_DOUBLE_EQ(bound.guides[1].at, 0.1) << "twice the step is half of the cost";
  EXPECT_TRUE(contains(bound.guides[1].text, "2/ω = 2 ms")) << bound.guides[1].text;
}

/// Provides the answers of a report on several scenes, with all tables or only with the engines' runs.
class Answers : public Take {
 protected:
  void SetUp() override {
    for (const Scene& s : scenes_) {
      SceneData f = facts({run(ours, 1e-3), run(theirs, 1e-3), run("bullet/pbd", 5e-3)});
      f.scene = s.name, set_round_off(f, 1e-9), f.methods[1].difference = 3.4e-12;
      if (s.model.find<Spheres>()) f.methods[0].clearance = 0, f.methods[1].difference = 0.81e-3, f.window = 0.48;
      facts_.push_back(f);
    }
  }
  std::vector<Finding> answers(const TableSet& tables) const { return answer_findings(scenes_, facts_, tables); }
  Table limits_about(LimitState state, std::optional<double> error_below = {}) const {
    Table limits = table_of<LimitRow>();
    for (const char* method : {"mysim/leapfrog", "mysim/symplectic-euler"}) {
      LimitRow row;
      row.scene = scene, row.method = method, row.state = state, row.predicted = 2.504e-3, row.measured = 2.5075e-3;
      row.held = 2.5e-3, row.failed = 2.515e-3, row.deviation = 0.0014;
      if (error_below) row.error_below = error_below, row.error_above = 0.5, row.motion = 1;
      add(limits, row);
    }
    return limits;
  }
  TableSet full() {
    add_run("mysim/symplectic-euler", 2.5e-3, 7.1e-3, 0.112);
    add_cheapest("mysim/symplectic-euler", 2.5e-3, 7.1e-3, 0.112);
    TableSet all = rows();
    const Table limits = limits_about(LimitState::rest);
    Table cone = table_of<ConeRow>(), least = table_of<LeastModelRow>();
    for (const std::string& method : {std::string(ours), std::string(theirs), std::string("bullet/pbd")})
      for (int i = 0; i < 72; ++i) {
        ConeRow row;
        row.method = method;
        row.state = method != ours && i % 2 ? ContactState::neither : ContactState::sticks;
        add(cone, row);
      }
    for (const ToleranceKind kind : {ToleranceKind::hundredth_of_motion, ToleranceKind::tenth_of_motion}) {
      LeastModelRow row;
      row.scene = scene, row.tolerance_is = kind, row.holds = true, row.cost_of_full = 0.67;
      row.left_out = kind == ToleranceKind::tenth_of_motion ? "bend springs, shear springs" : "";
      add(least, row);
    }
    Table energy = table_of<EnergyRow>(), end = table_of<EngineTimeRow>("cloth-sphere-engines");
    for (const auto& [method, symplectic, residual] : {std::tuple{"mysim/leapfrog", true, 4e-5},
                                                       {"mysim/symplectic-euler", true, 9e-5},
                                                       {"mysim/rk4", false, 1e-6},
                                                       {"mysim/implicit-euler", false, 1.}}) {
      EnergyRow row{.scene = "cloth-hang", .method = method, .symplectic = symplectic, .closure_claimed = true};
      row.turned_over = 2., row.largest_residual = residual;
      if (residual == 1) row.equivalent_drag = 0.98;
      add(energy, row);
    }
    for (const double t : {0.4, 3.}) add(end, EngineTimeRow{.method = theirs, .t = t, .difference = 2.8e-3});
    for (const Table& table : {limits, cone, least, energy, end}) all.add(table);
    return all;
  }
  const std::vector<Scene> scenes_ = load_scenes({"chain", "cloth-hang", "cloth-sphere"});
  std::vector<SceneData> facts_;
};

TEST_F(Answers, AreOneToEachQuestion) {
  const std::vector<Finding> all = answers(full());
  ASSERT_EQ(questions().size(), 6u);
  ASSERT_EQ(all.size(), 6u);
  expect_short(all);
  for (size_t i = 0; i < 6; ++i) {
    const FindingRule& rule = finding_rule(all[i].rule);
    EXPECT_EQ(rule.topic, "answer");
    EXPECT_EQ(rule.chapter, questions()[i].chapter);
    EXPECT_EQ(answer_to(questions()[i], all), &all[i]);
  }
  EXPECT_EQ(all[0].value, 3.4e-12);
  EXPECT_EQ(all[1].scene, "cloth-hang") << "the cloth without contact represents the others";
  EXPECT_EQ(all[1].method, "mysim/symplectic-euler");
  EXPECT_DOUBLE_EQ(all[1].value, 0.71);
  EXPECT_EQ(all[1].other, "bullet") << "the next engine, not an integrator";
  EXPECT_EQ(all[2].rule, "answer-limit");
  EXPECT_EQ(all[2].value, 2.5075e-3);
  EXPECT_EQ(all[2].low, 2.5e-3);
  EXPECT_EQ(all[2].high, 2.515e-3);
  EXPECT_TRUE(says(sentence_of(all[2]), {"2 of 2", "at most 0.14 %"}));
  EXPECT_EQ(all[3].value, 72);
  EXPECT_TRUE(contains(sentence_of(all[3]), "pbd 36. On cloth-sphere"));
  EXPECT_TRUE(contains(sentence_of(all[3]), "480 ms, 2.8 mm at the end."));
  EXPECT_EQ(all[4].method, "mysim/leapfrog") << "rk4 conserves it better here, but not for long";
  EXPECT_DOUBLE_EQ(all[4].value, 2e-3);
  EXPECT_TRUE(contains(sentence_of(all[4]), "a drag of 0.98 per second"));
  EXPECT_DOUBLE_EQ(all[5].value, 33);
  EXPECT_TRUE(contains(sentence_of(all[5]), "bend and shear springs"));
  EXPECT_EQ(answers_of_chapter("energy", all), sentence_of(all[3]) + " " + sentence_of(all[4]));
}

TEST_F(Answers, OnContactCountTheCasesOnPlanesBesideThoseOnBalls) {
  TableSet all = full();
  Table planes = table_of<PlaneConeRow>();
  for (const auto& [method, right] : {std::pair{std::string(ours), 72}, {std::string("bullet/pbd"), 31}})
    for (int i = 0; i < 72; ++i)
      add(planes, ConeRow{.method = method, .state = i < right ? ContactState::sticks : ContactState::neither});
  all.add(planes);
  const Finding ball = answers(all).at(3);
  expect_short({ball});
  EXPECT_EQ(ball.rule, "answer-ball.planes");
  EXPECT_EQ(ball.value, 72);
  EXPECT_TRUE(
      says(sentence_of(ball), {"Of 72 cases on balls/planes", "mysim 72/72", "explicit 36/-", "pbd 36/31", "then 2.8"}))
      << sentence_of(ball);
}

TEST_F(Answers, OfABallAreLeftToScenesThatHaveOne) {
  const std::vector<Scene> scenes = load_scenes({"cloth-hang"});
  facts_.erase(facts_.begin()), facts_.pop_back();
  for (const Finding& f : answer_findings(scenes, facts_, full())) EXPECT_NE(f.rule, "answer-ball");
}

TEST_F(Answers, GiveALimitAboutAStartOnlyWhereTheTruthConfirmsIt) {
  TableSet all = full();
  const auto failure = [&](std::optional<double> error_below) {
    *std::ranges::find(all.tables, "stability", &Table::name) = limits_about(LimitState::start, error_below);
    return answers(all).at(2);
  };
  EXPECT_EQ(failure(0.01).rule, "answer-limit");
  EXPECT_EQ(failure(0.01).value, 2.5075e-3);
  EXPECT_EQ(failure(0.2).rule, "answer-failed") << "runs called stable are too inaccurate there";
  EXPECT_EQ(failure({}).rule, "answer-failed");
}

TEST_F(Answers, NameTheReadersProgram) {
  using Known = std::optional<bool>;
  for (const auto& [same_rule, difference, words] :
       {std::tuple{Known(true), 6e-12, "mysim, mine and Bullet differ by at most 6.0e-12 m"},
        {Known(), 6e-12, "mysim and Bullet differ by at most 3.4e-12 m (scenes without contact: 2); mine: 6.0e-12 m."},
        {Known(true), 1.3e-3, "No: with the same rule and step, mysim and mine differ by up to 1.3 mm"},
        {Known(false), 1.3e-3,
         "mysim and Bullet differ by at most 3.4e-12 m (scenes without contact: 2); mine (other rule): 1.3 mm."}}) {
    std::vector<SceneData> facts = facts_;
    facts[1].methods.push_back(run("exec:./mine", 1e-3));
    facts[1].methods.back().difference = difference, facts[1].methods.back().same_rule = same_rule;
    facts[1].methods.back().round_off_bound = 1e-9;
    const std::vector<Finding> all = answer_findings(scenes_, facts, full());
    EXPECT_EQ(all[0].rule,
              same_rule && difference > 1e-9 && *same_rule ? "answer-agreement.no" : "answer-agreement.yes");
    EXPECT_TRUE(contains(sentence_of(all[0]), words)) << sentence_of(all[0]);
    expect_short(all);
  }
  std::vector<SceneData> facts = facts_;
  facts[1].methods.push_back(run("exec:./mine", {}, Verdict::crash));
  const std::vector<Finding> all = answer_findings(scenes_, facts, full());
  EXPECT_TRUE(sentence_of(all[0]).ends_with("; mine: no answer.")) << sentence_of(all[0]);
}

TEST_F(Answers, OfAProgramThatFellOverSayNothingOfItsPhysics) {
  std::vector<SceneData> facts = facts_;
  facts[0].methods.push_back(run("exec:./mine", {}, Verdict::crash));
  facts[1].methods.push_back(run("exec:./mine", {}, Verdict::energy));
  const TableSet none;
  const std::vector<Finding> all = failure_findings({none, scenes_, facts});
  const auto said = [&](const char* rule) {
    const auto at = std::ranges::find(all, rule, &Finding::rule);
    return at == all.end() ? std::string() : sentence_of(*at);
  };
  EXPECT_TRUE(says(said("failed-of-all.crashed"), {"mine", "no answer", "chain"}));
  EXPECT_TRUE(says(said("failed-of-all"), {"mine", "fails", "cloth-hang"}));
}

TEST_F(Answers, OfAQuestionThatNoTableSpeaksOfThereAreNone) {
  const std::vector<Finding> few = answers({});
  expect_short(few);
  EXPECT_EQ(rules_of(few), (std::vector<std::string>{"answer-agreement.yes", "answer-failed", "answer-contact"}));
  EXPECT_EQ(answer_to(questions()[1], few), nullptr);
  EXPECT_TRUE(answer_findings({}, {}, {}).empty());
}

TEST_F(Answers, WithoutBulletTheyAreOfTheEngineThatIsThere) {
  for (SceneData& each : facts_) {
    std::erase_if(each.methods,
                  [](const MethodData& m) { return family_of(m.method).by_default() && m.method != ours; });
    each.methods.push_back(run("exec:./bin/mine", 2e-3));
    each.methods.back().difference = 1e-4, each.methods.back().round_off_bound = 1e-9;
  }
  const std::vector<Finding> all = answers({});
  expect_short(all);
  EXPECT_EQ(rules_of(all),
            (std::vector<std::string>{"answer-agreement.difference", "answer-failed", "answer-contact"}));
  for (const Finding& f : all) EXPECT_FALSE(contains(sentence_of(f), "Bullet")) << sentence_of(f);
  EXPECT_TRUE(says(sentence_of(all[0]), {"mine", "symplectic-euler", "0.1 mm"}));
  for (SceneData& each : facts_) each.methods.back().difference = 1e-12;
  EXPECT_EQ(answers({})[0].rule, "answer-agreement.difference") << "there is no bound with contact";
  facts_.pop_back();
  EXPECT_EQ(answers({})[0].rule, "answer-agreement.same-motion");
  for (SceneData& each : facts_) each.methods.back().same_rule = true;
  EXPECT_EQ(answers({})[0].rule, "answer-agreement.yes");
  EXPECT_EQ(answers({})[0].other, "exec:./bin/mine");
}

TEST_F(Answers, ADisagreementBeyondRoundOffIsNoYes) {
  EXPECT_EQ(answers({})[0].rule, "answer-agreement.yes");
  facts_[0].methods[1].difference = 1e-3;
  const Finding no = answers({})[0];
  EXPECT_EQ(no.rule, "answer-agreement.no");
  EXPECT_EQ(no.value, 1e-3);
  EXPECT_EQ(no.words.at("where"), "chain");
}

TEST_F(Answers, WhereTheMotionIsChaoticNothingIsSaidOfAgreement) {
  facts_.pop_back();
  for (SceneData& each : facts_) set_round_off(each, {}), each.growth = 1e9;
  EXPECT_EQ(answers({})[0].rule, "answer-chaotic");
  EXPECT_EQ(answers({})[0].value, 1e9);
  expect_short(answers({}));
}

TEST_F(Answers, RunsThatFailedAreCountedWhereNoLimitWasMeasured) {
  EXPECT_EQ(the(answers({}), "answer-failed").value, 0);
  facts_[1].methods[0].verdict = Verdict::energy;
  facts_[2].methods[2].verdict = Verdict::unsupported;
  const Finding failed = the(answers({}), "answer-failed");
  EXPECT_EQ(failed.value, 1);
  EXPECT_TRUE(says(sentence_of(failed), {"1 of 8", "failed", "symplectic-euler"}));
}

TEST(StepReadBack, IsTheSameToRoundingInEveryChapter) {
  Request request;
  request.scenes = load_scenes({"spring"});
  const Scene& scene = request.scenes[0];
  for (const bool rounded : {true, false}) {
    SCOPED_TRACE(rounded);
    Method mine = find_method("bullet/deformable-explicit");
    mine.name = "exec:./mine";
    mine.engine = [inner = mine.engine, rounded](const Scene& s, const crosscheck::Run& r, Observer& o) {
      Outcome out = inner(s, r, o);
      out.readback->step = rounded ? std::nextafter(out.step, 1) : out.step * (1 + 1e-9);
      return out;
    };
    request.methods = {find_method(ours), mine};
    MethodResults results;
    TableSet rows;
    engines_on(request, scene, results, rows);
    const SceneData facts = scene_data(scene.name, rows);
    Facts known(rows);
    known.scene = &scene, known.of = &facts;
    const std::vector<Finding> all = scene_findings(known);
    EXPECT_EQ(of_rule(all, "same-rule").size(), rounded);
    PageContent page;
    page.findings = answer_findings(request.scenes, {facts}, rows);
    page.scenes = {{&scene, &facts, all}};
    for (const Certificate& c : rows.certificates) page.scenes[0].certificates.push_back(&c);
    EXPECT_EQ(contains(filled("first-screen", first_screen_data(page)), "certificate, 1 of 1"), rounded);
    speed_accuracy_on(request, scene, rows);
    const auto runs = crosscheck::rows_of<SpeedAccuracyRow>(rows);
    EXPECT_EQ(std::ranges::any_of(runs, [](const SpeedAccuracyRow& r) { return r.method == "exec:./mine"; }), rounded);
  }
}

TEST(MainScene, IsTheLastClothThatWasTimedElseTheLastScene) {
  const std::vector<Scene> scenes = load_scenes({"cloth-hang", "chain", "spring"});
  const auto timed = [](const std::vector<std::string>& names) {
    Table t = table_of<CheapestRow<Cost::cpu>>();
    for (const std::string& name : names) {
      CheapestRow<Cost::cpu> row;
      row.scene = name, row.method = "mysim/rk4";
      add(t, row);
    }
    TableSet rows;
    rows.add(t);
    return rows;
  };
  EXPECT_EQ(main_scene(scenes, timed({"chain", "cloth-hang"}))->name, "cloth-hang");
  EXPECT_EQ(main_scene(scenes, timed({"chain"}))->name, "chain");
  EXPECT_EQ(main_scene(scenes, {}), nullptr);
}

TableSet only(const Table& table) {
  TableSet rows;
  rows.add(table);
  return rows;
}

TEST(SphereFindings, LeavingAnglesByEngineAndWhoGetsWorse) {
  Table t = table_of<LeavingRow>();
  for (const auto& [method, coarse, fine] :
       {std::tuple{"mysim/rk4", 54.9, 54.99}, {"mysim/leapfrog", 54.9, 54.995}, {"bullet/pbd", 54.8, 53.4}})
    for (const auto& [step, angle] : {std::pair{1e-3, coarse}, {1e-4, fine}})
      add(t, LeavingRow{.method = method, .reason = "", .step = step, .angle = angle, .angle_by_theory = 55});
  add(t, LeavingRow{.method = sticky_sphere, .reason = "", .step = 1e-4, .angle_by_theory = 55});
  const auto all = leaving_findings(only(t));
  expect_short(all);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].method, "mysim/rk4") << "the least accurate method of mysim";
  EXPECT_NEAR(all[0].value, -0.01, 1e-9);
  EXPECT_NEAR(all[1].value, -1.6, 1e-9);
  EXPECT_TRUE(says(sentence_of(all[1]), {"pbd", "-1.6 degrees", "100 µs", "-0.2 degrees", "1 ms"}));
  t.rows.clear();
  EXPECT_TRUE(leaving_findings(only(t)).empty());
}

TEST(PlaneFindings, ReadTheRepresentativeAtAMillisecondAndWhatIsNotAtRest) {
  Table t = table_of<PlaneProbeRow>();
  const auto row = [&](PlaneProbe probe, const std::string& method, double step, std::optional<double> value,
                       double theory) {
    add(t, PlaneProbeRow{.probe = probe,
                         .method = method,
                         .verdict = value ? Verdict::ok : Verdict::unsupported,
                         .step = step,
                         .measured = value,
                         .by_theory = theory});
  };
  for (const double step : {1e-3, 1e-4}) {
    row(PlaneProbe::apex, ours, step, 0.25 + 10 * step, 0.25);
    row(PlaneProbe::apex, "bullet/pbd", step, {}, 0.25);
    row(PlaneProbe::period, ours, step, 1 + 3 * step, 1);
    row(PlaneProbe::loss, ours, step, -1e-14, 0);
    row(PlaneProbe::held, "mysim/explicit-euler", step, 0.5, 1);
    row(PlaneProbe::held, "bullet/pbd", step, 0.2, 1);
  }
  auto all = plane_findings(only(t));
  expect_short(all);
  ASSERT_EQ(rules_of(all), (std::vector<std::string>{"planes", "planes-rest"}));
  EXPECT_NEAR(all[0].value, 4, 1e-9);
  EXPECT_TRUE(says(sentence_of(all[0]), {"1 ms", "4 %", "0.3 %", "Bullet has no restitution"})) << sentence_of(all[0]);
  EXPECT_EQ(all[1].value, 0);
  EXPECT_TRUE(says(sentence_of(all[1]), {"mysim loses 0 %", "explicit-euler is at rest in only 50 %"}))
      << sentence_of(all[1]);
  row(PlaneProbe::loss, "mysim/rk4", 1e-3, 1e-3, 0);
  EXPECT_NEAR(plane_findings(only(t)).at(1).value, 0.1, 1e-12);
  EXPECT_TRUE(plane_findings(only(table_of<PlaneProbeRow>())).empty());
}

TEST(SphereFindings, TheDrapeSaysWhoLeftTheBallAndWhoTouchesIt) {
  Table t = table_of<DrapeRow>();
  const auto end = [&](const std::string& method, double step, double height, std::optional<double> creep,
                       Verdict verdict = Verdict::ok) {
    add(t, DrapeRow{.scene = "drop-aside",
                    .method = method,
                    .verdict = verdict,
                    .reason = "",
                    .end = 1.6,
                    .step = step,
                    .centre_height = height,
                    .creep = creep});
  };
  end(ours, 2e-3, -0.7, {}), end(ours, 1e-3, -0.7, {}), end(theirs, 1e-3, 0, {}, Verdict::energy);
  end(position_based(), 1e-3, 0.3, 0.0208), end(sticky_sphere, 1e-3, 0.3, 0.);
  const auto all = drape_findings(only(t));
  expect_short(all);
  EXPECT_EQ(rules_of(all), (std::vector<std::string>{"slides-off", "still-touches", "still-touches"}));
  EXPECT_EQ(all[0].value, -0.7);
  EXPECT_EQ(all[1].method, position_based());
  EXPECT_EQ(all[1].value, 0.0208);
  EXPECT_EQ(all[2].value, 0);
  EXPECT_TRUE(drape_findings(only(table_of<DrapeRow>())).empty());
}

TEST(SharedWords, NumbersHaveOneStyle) {
  EXPECT_EQ(step_text(5e-4), "500 µs");
  EXPECT_EQ(step_text(1.117e-3), "1.12 ms");
  EXPECT_EQ(step_text(3), "3 s");
  EXPECT_EQ(nice(3518.2), "3518");
  EXPECT_EQ(count_text(100000), "100 000");
  EXPECT_EQ(count_text(4000), "4000");
  EXPECT_EQ(percent(6.5e-6, 1), "0.00065 %");
  EXPECT_EQ(percent(1e-7, 1), "1.0e-5 %");
  EXPECT_EQ(percent(0.66, 1), "66 %");
}

}  // namespace
}  // namespace crosscheck
