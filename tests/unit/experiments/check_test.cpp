// Relations: each relation detects an engine that violates it, and a correct engine violates none.

#include "experiments/check/check.h"
#include "experiments/check/transformations.h"
#include "experiments/scenes/scenes.h"
#include "tests/unit/experiments/defects.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::vector<Answer> all_answers(const Method& method, const std::vector<KnownBreak>& known = {}) {
  return answers_of(method, {}, 1, known);
}

TEST(Relations, AllHoldForLeapfrog) {
  for (const Answer& answer : all_answers(find_method("leapfrog")))
    EXPECT_EQ(answer.mark, RelationMark::holds)
        << answer.relation->name << " " << answer.scene << ": " << answer.sentence();
}

TEST(Relations, EachFindsItsDefect) {
  std::set<std::string> covered;
  for (const Defect& defect : defects()) {
    SCOPED_TRACE(defect.what);
    covered.insert(defect.relation);
    const Relation& relation = find_relation(defect.relation);
    Subject subject(defect.make("leapfrog"));
    bool found = false;
    for (const Scene& scene : relation.smallest())
      found = found || ask(relation, subject, scene, 1, {}).mark == RelationMark::broken;
    EXPECT_TRUE(found) << defect.relation;
  }
  for (const Relation& relation : relations())
    EXPECT_TRUE(covered.contains(std::string(relation.name))) << relation.name;
}

TEST(Relations, SayWhySomethingCannotBeAsked) {
  Subject adaptive(find_method("dopri5"));
  const Answer answer = ask(find_relation("half-step"), adaptive, small_nets()[0], 1, {});
  EXPECT_EQ(answer.mark, RelationMark::not_applicable);
  EXPECT_EQ(answer.sentence(), "it chooses its own steps");

  Method silent = with_defect("leapfrog", nullptr, [](const Scene&, State& s) { s.v.resize(3, 0); });
  Subject without(silent);
  for (const char* name : {"energy", "angular-momentum", "resume"}) {
    const Relation& relation = find_relation(name);
    const Answer said = ask(relation, without, relation.smallest()[0], 1, {});
    EXPECT_EQ(said.mark, RelationMark::not_applicable) << name;
    EXPECT_TRUE(contains(said.sentence(), "no velocities")) << name;
  }
}

TEST(Relations, CountWhatAnImplicitStepLeavesUnsolved) {
  const Relation& free_fall = find_relation("free-fall");
  for (const char* name : {"implicit-euler", "implicit-midpoint"}) {
    bool more_than_rounding = false;
    for (const Scene& net : falling_nets()) {
      Subject implicit(find_method(name));
      const Answer answer = ask(free_fall, implicit, net, 1, {});
      EXPECT_EQ(answer.mark, RelationMark::holds) << name << ": " << answer.sentence();
      more_than_rounding |= answer.finding.measured > implicit.noise(net).x.back();
    }
    EXPECT_TRUE(more_than_rounding) << name;
  }
  const Scene net = falling_nets()[0];
  Subject explicit_rule(find_method("leapfrog"));
  EXPECT_EQ(explicit_rule.noise_with_unsolved(net).x, explicit_rule.noise(net).x);
}

TEST(Relations, OfPlacedRunsCountWhatAnImplicitStepLeavesUnsolvedOfABendingStrip) {
  Scene strip = load_scene("cloth-cantilever");
  strip.duration = strip.window = 0.1, strip.samples = 5;
  Subject implicit(find_method("implicit-midpoint")), explicit_rule(find_method("leapfrog"));
  const Answer shifted = ask(find_relation("shifted"), implicit, strip, 1, {});
  EXPECT_EQ(shifted.mark, RelationMark::holds) << shifted.sentence();
  EXPECT_GT(shifted.finding.measured, implicit.noise(strip).x.back());
  EXPECT_LT(shifted.finding.tolerance, 1e-6 * strip.size());  // far below any visible defect
  EXPECT_EQ(ask(find_relation("turned"), implicit, strip, 1, {}).mark, RelationMark::holds);
  const Answer rounded = ask(find_relation("shifted"), explicit_rule, strip, 1, {});
  EXPECT_EQ(rounded.mark, RelationMark::holds) << rounded.sentence();
  EXPECT_LE(rounded.finding.tolerance, 1e-12);
}

TEST(Relations, TakeARunThatFailsForBroken) {
  Method dead = find_method("leapfrog");
  dead.engine = [](const Scene&, const crosscheck::Run&, Observer&) {
    Outcome out;
    out.verdict = Verdict::crash, out.reason = "it is gone", out.end = 0.25;
    return out;
  };
  Subject subject(dead);
  const Answer answer = ask(find_relation("turned"), subject, small_nets()[0], 1, {});
  EXPECT_EQ(answer.mark, RelationMark::broken);
  EXPECT_TRUE(contains(answer.sentence(), "it is gone"));
  EXPECT_EQ(answer.finding.since, 0.25);
}

TEST(Relations, CannotBeAskedOfAMethodThatEndsNoRun) {
  Method dead = find_method("leapfrog"), weak = dead;
  dead.engine = [](const Scene&, const crosscheck::Run&, Observer&) {
    Outcome out;
    out.verdict = Verdict::crash, out.reason = "it did not start";
    return out;
  };
  const std::vector<Answer> answers = answers_of(dead, {}, 1, {});
  for (const Answer& a : answers) EXPECT_EQ(a.mark, RelationMark::not_applicable) << a.relation->name;
  EXPECT_TRUE(contains(answers.front().sentence(), "it did not start"));
  EXPECT_EQ(status_of(answers), 1);
  // An engine that completes some scenes violates the relations on the scenes where it fails.
  weak.engine = [&dead, alive = weak.engine](const Scene& scene, const crosscheck::Run& run, Observer& observer) {
    return (scene.model.find<Springs>() ? dead.engine : alive)(scene, run, observer);
  };
  const std::vector<Answer> some = answers_of(weak, {shipped_scene("projectile"), shipped_scene("spring")}, 1, {});
  EXPECT_TRUE(std::ranges::any_of(some, [](const Answer& a) { return a.mark == RelationMark::broken; }));
}

TEST(Relations, AreAPartOfEveryReportAndOfANamedScenesForProgramsAlone) {
  Request request;
  EXPECT_EQ(relations_points(request).size(), default_methods().size());
  request.scenes_only = true;
  EXPECT_TRUE(relations_points(request).empty());
  request.methods = {find_method("leapfrog"), find_method("exec:" CROSSCHECK_EXAMPLE)};
  const std::vector<Point> points = relations_points(request);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(contains(points[0].name, "exec:"));

  request.scenes_only = false;
  TableSet tables;
  relations_points(request)[0].compute(tables);
  const Table* table = tables.table("relations");
  ASSERT_NE(table, nullptr);
  EXPECT_GE(table->rows.size(), relations().size());
}

TEST(Relations, OfNamedScenesAreThoseThatSaySomething) {
  std::set<std::string> asked;
  for (const Answer& a : answers_of(find_method("leapfrog"), {shipped_scene("spring")}, 1, {})) {
    asked.insert(std::string(a.relation->name));
    EXPECT_EQ(a.mark, RelationMark::holds) << a.relation->name << ": " << a.sentence();
  }
  for (const char* name : {"turned", "pins", "energy", "repeatable"}) EXPECT_TRUE(asked.contains(name)) << name;
  for (const char* name : {"free-fall", "momentum", "no-force"}) EXPECT_FALSE(asked.contains(name)) << name;
}

TEST(Relations, PassWhereNothingButKnownBreaksWasFound) {
  const auto status = [](std::initializer_list<RelationMark> marks) {
    std::vector<Answer> answers;
    for (const RelationMark mark : marks) answers.push_back({"m", "s", &relations()[0], mark, {}, "", ""});
    return status_of(answers);
  };
  using enum RelationMark;
  EXPECT_EQ(status({holds, known, not_applicable}), 0);
  EXPECT_EQ(status({known}), 0);
  EXPECT_EQ(status({holds, broken}), 1);
  EXPECT_EQ(status({not_applicable}), 1);
  EXPECT_EQ(status({}), 1);
}

class KnownBreaks : public InFolder {};

TEST_F(KnownBreaks, CoverAMethodOrARuleARelationAndASize) {
  // In the Gauss-Seidel iteration, another order of the springs moves the net by about 1e6 tolerances.
  for (const char* whose : {"method = \"mysim/xp*\"", "rule = \"xpbd\""}) {
    SCOPED_TRACE(whose);
    const auto known = read_known_breaks(
        write("known.toml",
              fmt::format("[[known]]\n{}\nrelation = \"spring-order\"\ntimes = 1e9\nreason = \"In turn.\"\n", whose)));
    const auto mark = [&](const Method& method, double times) {
      auto list = known;
      list[0].times = times;
      Subject subject(method);
      const Relation& order = find_relation("spring-order");
      return ask(order, subject, order.smallest()[0], 1, list).mark;
    };
    EXPECT_EQ(mark(find_method("xpbd"), 1e9), RelationMark::known);
    EXPECT_EQ(mark(find_method("xpbd"), 2), RelationMark::broken);
    // a table that names a rule does not excuse an engine whose name suggests this rule, but which follows another one
    Method other = with_defect("leapfrog", [](Scene& s, const crosscheck::Run&) { springs_in(s)[0].k *= 1.01; });
    other.name = "mysim/xpbd";
    EXPECT_EQ(mark(other, 1e15), known[0].rule.empty() ? RelationMark::known : RelationMark::broken);
  }
}

TEST_F(KnownBreaks, RefuseWhatTheyDoNotKnow) {
  struct Case {
    const char *text, *message;
  };
  for (const auto& [text, message] :
       {Case{"[[known]]\nmethod = \"a\"\nrelation = \"enrgy\"\nreason = \"r\"\n",
             "known.toml:3: known[0].relation: expected the name of a relation, got 'enrgy'"},
        Case{"[[known]]\nmethod = \"a\"\nrelation = \"energy\"\n", "reason"},
        Case{"[[knwon]]\nmethod = \"a\"\n", "knwon"}}) {
    const auto file = write("known.toml", text);
    EXPECT_TRUE(contains(refusal_of([&] { read_known_breaks(file); }), message));
  }
  EXPECT_TRUE(contains(refusal_of([] { find_relation("enrgy"); }), "unknown relation 'enrgy'"));
  EXPECT_TRUE(contains(refusal_of([] { find_relation("enrgy"); }), "did you mean 'energy'?"));
}

TEST(Transformations, UndoneGiveTheSceneAgain) {
  const Scene scene = small_cloth();
  const std::vector<int> order = seeded_order(scene.model.particles.size(), 5);
  std::vector<int> back(order.size());
  for (size_t i = 0; i < order.size(); ++i) back[order[i]] = static_cast<int>(i);
  EXPECT_EQ(hash_of(renumbered(renumbered(scene, order), back)), hash_of(scene));
  EXPECT_NE(hash_of(renumbered(scene, order)), hash_of(scene));
  EXPECT_EQ(hash_of(scaled(scaled(scene, {4, 2, 0.5}), {0.25, 0.5, 2})), hash_of(scene));
  EXPECT_NEAR(seeded_turn(3).determinant(), 1, 1e-14);
}

}  // namespace
}  // namespace crosscheck
