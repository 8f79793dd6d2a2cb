// Which method for which scene: cells of the opening table from facts made by hand, and words that findings share.

#include "experiments/scenes/scenes.h"
#include "report/findings/evidence.h"
#include "report/findings/findings_text.h"
#include "report/findings/recommendation.h"
#include "report/findings/report_data.h"
#include "report/findings/summaries.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

MethodData run(const std::string& method, std::optional<double> error, Verdict verdict = Verdict::ok,
               long evaluations = 6000) {
  MethodData m;
  m.method = method, m.verdict = verdict, m.error = error, m.step = 5e-4, m.evaluations = evaluations;
  return m;
}

SceneData facts(std::vector<MethodData> methods) {
  SceneData f;
  f.scene = "cloth-hang", f.motion = 1, f.window = 3, f.tier = "converged", f.error_bar = 1e-9;
  f.methods = std::move(methods);
  return f;
}

class Choice : public testing::Test {
 protected:
  RecommendationCell cell(const std::string& head, const SceneData& facts, const Rows& rows = {}) const {
    const auto cells = recommendations_of(scene_, facts, rows);
    for (size_t i = 0; i < cells.size(); ++i)
      if (recommendation_columns()[i].head == head) return cells[i];
    ADD_FAILURE() << head;
    return {};
  }
  const Scene scene_ = load_scenes({"cloth-hang"})[0];
};

TEST_F(Choice, TheNearestOfEachEngineAndWhoIsNearest) {
  const SceneData f = facts({run("mysim/suzuki4", 1e-8, Verdict::ok, 30000), run("mysim/leapfrog", 2e-5),
                             run("bullet/deformable-explicit", 6e-4), run("bullet/pbd", 5e-3)});
  EXPECT_EQ(cell("mysim's nearest", f).text, "suzuki4 < 0.001 %");
  EXPECT_EQ(cell("mysim's nearest", f).css_class, std::string("best"));
  EXPECT_EQ(cell("mysim's, one evaluation a step", f).text, "leapfrog 0.002 %");
  EXPECT_EQ(cell("mysim's, one evaluation a step", f).css_class, std::string());
  EXPECT_EQ(cell("Bullet's nearest", f).text, "deformable-explicit 0.06 %");
  EXPECT_EQ(cell("failed, or over 10 % off", f).text, "none of 4");
}

TEST_F(Choice, OfSeveralThatAreAsNearTheCheapestIsNamed) {
  // 2.5e-16 m apart at three times the work; one with fewer evaluations is nearer by far than those of one a step
  const SceneData f = facts({run("mysim/implicit-euler", 1e-2, Verdict::ok, 18000),
                             run("mysim/symplectic-euler", 1.0001e-2), run("mysim/explicit-euler", 2e-2)});
  EXPECT_EQ(cell("mysim's nearest", f).text, "symplectic-euler 1 %");
  const SceneData few = facts({run("mysim/dopri5", 1e-8, Verdict::ok, 100), run("mysim/explicit-euler", 2e-2)});
  EXPECT_EQ(cell("mysim's nearest", few).text, "dopri5* < 0.001 %");
}

TEST_F(Choice, EnginesOfOthersKeepTheirNames) {
  const SceneData f = facts({run("mysim/rk4", 1e-4), run("bullet/pbd", 2e-4), run("bullet32/pbd", 3e-4),
                             run("exec:./my/engine", 5e-5), run("truth/converged", 0.)});
  EXPECT_EQ(cell("nearest of others", f).text, "exec:./my/engine 0.005 %");
  EXPECT_EQ(cell("nearest of others", f).css_class, std::string("best"));
  EXPECT_EQ(cell("Bullet's nearest", f).text, "pbd 0.02 %");
  EXPECT_TRUE(cell("nearest of others", facts({run("mysim/rk4", 1e-4)})).empty());
}

TEST_F(Choice, WithinFivePercentBothAreNearest) {
  const SceneData f = facts({run("mysim/xpbd", 5.51e-3), run("bullet/pbd", 5.5e-3)});
  EXPECT_EQ(cell("mysim's nearest", f).css_class, std::string("best"));
  EXPECT_EQ(cell("Bullet's nearest", f).css_class, std::string("best"));
}

TEST_F(Choice, NothingIsSaidBelowTheErrorBar) {
  SceneData f = facts({run("mysim/rk4", 1e-4)});
  f.error_bar = 2e-3;
  EXPECT_EQ(cell("mysim's nearest", f).text, "rk4 < 0.2 %");
}

TEST_F(Choice, FailuresAndUselessAnswersAreNamed) {
  const SceneData f = facts({run("mysim/rk4", 1e-4), run("mysim/explicit-euler", {}, Verdict::energy),
                             run("mysim/xpbd", 0.2), run("bullet/pbd", 0.3),
                             run("bullet/deformable-explicit", {}, Verdict::unsupported), run(sticky_sphere, 0.9)});
  EXPECT_EQ(cell("failed, or over 10 % off", f).text, "explicit-euler failed; off: pbd 30 %, xpbd 20 % (of 4)");
  EXPECT_EQ(cell("Bullet's nearest", facts({run("bullet/pbd", {}, Verdict::unsupported)})).text, "cannot");
}

TEST_F(Choice, WithoutATruthThereAreDifferencesOnly) {
  SceneData f = facts({run("mysim/rk4", {}), run(theirs, {})});
  f.tier = "", f.methods[1].difference = 8.1e-4;
  EXPECT_EQ(cell("truth", f).text, "none");
  EXPECT_EQ(cell("mysim's nearest", f).text, "–");
  EXPECT_TRUE(begins(cell("Bullet's nearest", f).text, "0.81 mm from mysim until "));
}

Table least(std::vector<std::vector<Cell>> rows) {
  Table t{"adequacy-least", {}, {}};
  for (const char* column : {"scene", "tolerance", "tolerance is", "left out", "unseen error 1", "unseen error 2",
                             "unseen error 3", "holds", "cost of full"})
    t.columns.push_back({column, "1"});
  for (auto& row : rows) t.add(std::move(row));
  return t;
}

TEST_F(Choice, WhatMayBeLeftOutAndWhoIsCheapest) {
  Rows rows;
  rows.add(least({{"cloth-hang", 1e-3, "the scene's own", "", 1., 1., 1., 1l, 1.},
                  {"cloth-hang", 0.01, "1 % of its motion", "shear springs", 5e-3, 0.02, 0.03, 0l, 0.67},
                  {"cloth-hang", 0.1, "10 % of its motion", "bend springs", 5e-3, 0.02, 0.03, 1l, 0.67}}));
  Table cheap{"speed-accuracy-cheapest-cost", {}, {}};
  for (const char* column : {"scene", "part of motion", "measure", "method", "as cheap within noise", "Bullet / mysim"})
    cheap.columns.push_back({column, "1"});
  cheap.add({"cloth-hang", 0.01, "error", "mysim/leapfrog", "mysim/rk4, odeint/rk4", 26.6});
  rows.add(cheap);
  const SceneData f = facts({run("mysim/rk4", 1e-4)});
  EXPECT_EQ(cell("not needed for 1 % / 10 %", f, rows).text, "nothing / bend springs");
  EXPECT_EQ(cell("cheapest for 1 %, CPU time", f, rows).text, "leapfrog, rk4, odeint/rk4; Bullet\u00a0×\u00a027");
  EXPECT_EQ(cell("cheapest for 1 %, CPU time", f).text, "–");

  // what holds within 1 % is within 10 % too, also where the search goes further there and fails
  Rows further;
  further.add(least({{"cloth-hang", 0.01, "1 % of its motion", "shear springs", 5e-3, 5e-3, 5e-3, 1l, 0.67},
                     {"cloth-hang", 0.1, "10 % of its motion", "shear springs, drag", 0.2, 0.02, 0.03, 0l, 0.67}}));
  EXPECT_EQ(cell("not needed for 1 % / 10 %", f, further).text, "shear springs");

  // nobody of Bullet is as near, though its worlds take the scene
  Table none = cheap;
  none.rows[0].back() = Cell();
  Rows without;
  without.add(none);
  EXPECT_EQ(cell("cheapest for 1 %, CPU time", facts({run("bullet/pbd", 0.1)}), without).text,
            "leapfrog, rk4, odeint/rk4; Bullet:\u00a0none");
  const auto models = least_models_of(rows, "cloth-hang");
  ASSERT_EQ(models.size(), 3u);
  EXPECT_EQ(models[1].failing, 2);
  EXPECT_FALSE(models[1].holds);
  EXPECT_TRUE(models[2].of_motion(10));
  EXPECT_FALSE(models[2].of_motion(1));

  const auto findings = adequacy_findings(rows);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(
      findings[0].sentence,
      "On cloth-hang within its tolerance all is needed; at 1 % of its motion without shear springs it fails from "
      "2 of 3 other starts; at 10 % of its motion it can do without bend springs, which saves 33 % of the spring "
      "evaluations. All this holds while single positions can be compared.");
}

TEST_F(Choice, TheFindingSaysTheRowWithoutTimings) {
  const Finding f = recommendation_finding(scene_, facts({run("mysim/rk4", 1e-4)}), {});
  EXPECT_TRUE(contains(f.sentence, "mysim's nearest: rk4 0.01 %; "));
  EXPECT_FALSE(contains(f.sentence, "CPU"));
  EXPECT_EQ(f.tier, "converged");
  EXPECT_NO_THROW(finding_rule(f.rule));
}

TEST(SceneKind, IsTheHardestThingInIt) {
  const std::vector<std::string> names{"circle", "projectile", "chain", "rod", "cloth-hang", "cloth-sphere"},
      kinds{"rotation", "free flight", "springs", "hard lengths", "cloth", "ball"};
  const std::vector<Scene> scenes = load_scenes(names);
  for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(scene_class(scenes[i]), kinds[i]) << names[i];
}

TEST(SharedWords, LeavingAnglesByEngineAndWhoGetsWorse) {
  Table t{"sphere-leaving", {{"method", "1"}, {"step", "s"}, {"angle", "degrees"}, {"angle by theory", "degrees"}}, {}};
  for (const auto& [method, coarse, fine] : {std::tuple{"mysim/rk4", 54.9, 54.99}, {"bullet/pbd", 54.8, 53.4}}) {
    t.add({method, 1e-3, coarse, 55.});
    t.add({method, 1e-4, fine, 55.});
  }
  t.add({sticky_sphere, 1e-4, Cell(), 55.});
  EXPECT_EQ(
      leaving_sentence(t),
      "At a step of 100 µs particles leave the ball off the exact angle: mysim's rules by at most 0.01 degrees (-0.1 "
      "at 1 ms) and bullet/pbd by -1.6 (-0.2 at 1 ms). Shorter steps make bullet/pbd worse.");
  t.rows.clear();
  EXPECT_EQ(leaving_sentence(t), "");
}

TEST(SharedWords, TheDrapeSaysWhoLeftTheBallAndWhoTouchesIt) {
  Table t{"sphere-drape", {}, {}};
  for (const char* column : {"scene", "method", "verdict", "step", "end", "centre height", "creep"})
    t.columns.push_back({column, "1"});
  t.add({"drop-aside", ours, "ok", 2e-3, 1.6, -0.7, Cell()});
  t.add({"drop-aside", ours, "ok", 1e-3, 1.6, -0.7, Cell()});
  t.add({"drop-aside", theirs, "energy", 1e-3, 0.3, Cell(), Cell()});
  t.add({"drop-aside", position_based, "ok", 1e-3, 1.6, 0.3, 0.0208});
  t.add({"drop-aside", sticky_sphere, "ok", 1e-3, 1.6, 0.3, 0.});
  EXPECT_EQ(drape_end_sentence(drape_ends(t)),
            "At 1.6 s it is off the ball with mysim/symplectic-euler; with bullet/pbd it still touches it, sliding at "
            "20.8 mm/s and with mysim/symplectic-euler+sticky it still touches it, frozen.");
  EXPECT_EQ(drape_end_sentence({}), "");
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
