// The hunter: random scenes, their reduction, and the agreement of methods.

#include "tests/hunt/hunt.h"
#include "experiments/check/compare.h"
#include "experiments/check/transformations.h"
#include "tests/unit/experiments/defects.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Draw, IsAFunctionOfSeedAndIndex) {
  for (long index = 0; index < 3 * drawn_kinds; ++index) {
    EXPECT_EQ(draw(1, index).text(), draw(1, index).text());
    EXPECT_NE(draw(1, index).text(), draw(2, index).text());
    EXPECT_NE(draw(1, index).text(), draw(1, index + drawn_kinds).text());
  }
}

TEST(Draw, GivesScenesWithEveryIngredientAndOneForEveryRelation) {
  std::set<std::string> terms, asked;
  std::set<Family> families;
  int moved = 0, gusts = 0, links = 0, frictions = 0, rebounds = 0;
  for (long index = 0; index < 20 * drawn_kinds; ++index) {
    const Scene scene = draw(3, index).scene();
    SCOPED_TRACE(scene.source);
    EXPECT_GE(scene.model.particles.size(), 1);
    EXPECT_LE(scene.model.particles.size(), 30);
    for (const Term& term : scene.model.terms) terms.emplace(name_of(term));
    moved += scene.model.particles.move.has_value();
    if (const auto* wind = scene.model.find<Wind>()) gusts += wind->acceleration.gusts.has_value();
    if (const auto* springs = scene.model.find<Springs>()) {
      links += springs->law == SpringLaw::bullet_link;
      for (const Spring& s : springs->list) families.insert(s.family);
    }
    if (const auto* spheres = scene.model.find<Spheres>())
      for (const Sphere& s : spheres->list) frictions += s.friction > 0, rebounds += s.restitution > 0;
    for (const Relation& relation : relations())
      if (relation.excluded(scene).empty()) asked.emplace(relation.name);
  }
  // all terms except aerodynamics, which acts on the triangles of a grid
  EXPECT_EQ(terms, (std::set<std::string>{"rotation", "gravity", "springs", "dashpots", "constraints", "drag", "wind",
                                          "sphere"}));
  EXPECT_EQ(families.size(), 4U);
  for (const int count : {moved, gusts, links, frictions, rebounds}) EXPECT_GT(count, 0);
  for (const Relation& relation : relations()) EXPECT_TRUE(asked.contains(std::string(relation.name))) << relation.name;
}

/// A net of many particles. Tests reduce it while a property holds that depends only on gravity and one shear spring.
SceneDraft large_draft() {
  for (long index = 0;; index += drawn_kinds) {
    SceneDraft draft = draw(5, index);
    if (draft.size() > 15 && draft.gravity && draft.gamma &&
        std::ranges::any_of(draft.springs, [](const auto& s) { return s.family == Family::shear; }))
      return draft;
  }
}
bool has_shear_and_gravity(const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  return springs && scene.model.find<Gravity>() &&
         std::ranges::any_of(springs->list, [](const Spring& s) { return s.family == Family::shear; });
}

TEST(Shrink, FindsTheSmallestThatStillShowsIt) {
  const Shrunk smallest = shrink(large_draft(), has_shear_and_gravity, 1000);
  EXPECT_TRUE(has_shear_and_gravity(smallest.draft.scene()));
  EXPECT_EQ(smallest.draft.kind(), "springs-gravity");
  EXPECT_EQ(smallest.draft.size(), 2);
  EXPECT_EQ(smallest.draft.springs.size(), 1U);
  EXPECT_EQ(smallest.draft.samples, 1);
  for (const auto& p : smallest.draft.particles) EXPECT_EQ(p.mass, 1);
  EXPECT_EQ(smallest.draft.springs[0].k, 1);
  EXPECT_FALSE(smallest.draft.springs[0].rest);
  EXPECT_TRUE(smallest.draft.gravity->isZero(0));
  EXPECT_EQ(shrink(large_draft(), has_shear_and_gravity, 1000).draft.text(), smallest.draft.text());
}

TEST(Shrink, KeepsWhatTogetherIsNeeded) {
  // The property requires a sum of masses that two particles of 0.4 kg do not reach, and a duration that can be halved
  // only once.
  SceneDraft draft = large_draft();
  for (auto& p : draft.particles) p.mass = 0.4;
  const double duration = draft.duration;
  const Shrunk smallest = shrink(
      draft, [&](const Scene& s) { return s.model.particles.mass.sum() > 1.05 && s.duration > 0.3 * duration; }, 1000);
  EXPECT_GE(smallest.draft.size(), 2);  // at least two, because a mass may become 1
  EXPECT_GT(smallest.draft.particles[0].mass + smallest.draft.particles[1].mass, 1.05);
  EXPECT_EQ(smallest.draft.duration, duration / 2);
}

TEST(Shrink, StopsAfterSoManyTrialsAndAsksNothingTwice) {
  std::set<std::string> asked;
  const Shrunk smallest = shrink(
      large_draft(),
      [&](const Scene& s) {
        EXPECT_TRUE(asked.insert(s.source).second) << s.source;
        return has_shear_and_gravity(s);
      },
      9);
  EXPECT_EQ(smallest.trials, 9);
  EXPECT_EQ(asked.size(), 9U);
  EXPECT_TRUE(has_shear_and_gravity(smallest.draft.scene()));
}

Method heavy(const std::string& base) {
  return with_defect(base, [](Scene& s, const crosscheck::Run&) { multiply_gravity(s, 1.01); });
}
Answer agreement_of(const Method& a, const Method& b, const Scene& scene) {
  Subject one(a), other(b);
  return ask_agreement(one, other, scene, {});
}

TEST(Agreement, HoldsForRulesOfOneLimitAndNotForAnother) {
  const Scene net = small_nets()[0], spring = shipped_scene("spring");
  for (const char* other :
       {"rk4", "symplectic-euler", "implicit-euler", "dopri5", "xpbd", "bullet/deformable-explicit"}) {
    const Answer answer = agreement_of(find_method("leapfrog"), find_method(other), net);
    EXPECT_EQ(answer.mark, RelationMark::holds) << other << ": " << answer.sentence();
    EXPECT_GT(answer.finding.measured, 0) << other;
    EXPECT_EQ(agreement_of(find_method("leapfrog"), heavy(other), net).mark, RelationMark::broken) << other;
  }
  const Method exact = find_method("truth/exact");
  EXPECT_EQ(agreement_of(find_method("leapfrog"), exact, spring).mark, RelationMark::holds);
  EXPECT_EQ(agreement_of(heavy("leapfrog"), exact, spring).mark, RelationMark::broken);
}

/// A single particle in free flight without forces.
Scene flight(double step) {
  return parse_scene(fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 4\nstep = {}\n"
                                 "window = 1\ntolerance = 1e-3\nmethod = \"leapfrog\"\n[[particle]]\n"
                                 "position = [0, 0, 0]\nmass = 1\nvelocity = [1, 0, 0]\n",
                                 step),
                     "flight");
}

TEST(Agreement, IsAskedWhereNoSpringHasALaw) {
  const Answer answer = agreement_of(find_method("leapfrog"), find_method("bullet/pbd"), flight(1. / 128));
  EXPECT_EQ(answer.mark, RelationMark::holds) << answer.sentence();
}

TEST(ShippedKnownBreaks, HaveTheStepThatBulletRoundsToSinglePrecision) {
  const auto known = read_known_breaks(shipped_known_breaks());
  Subject pbd(find_method("bullet/pbd"));
  const Relation& momentum = find_relation("momentum");
  EXPECT_EQ(ask(momentum, pbd, flight(1. / 128), 1, known).mark, RelationMark::holds)
      << "this step is exact in single precision";
  const Answer rounded = ask(momentum, pbd, flight(0.01), 1, known);
  EXPECT_EQ(rounded.mark, RelationMark::known) << rounded.sentence();
  // The change is relative to the path of 1 m. The row's sentence has two digits, hence the tolerance of 1 %.
  const double expected = 1 - double(0.01F) / 0.01;
  EXPECT_NEAR(rounded.finding.measured, expected, 0.01 * expected) << rounded.sentence();
}

TEST(Agreement, SaysWhyItCannotBeAsked) {
  const Method leapfrog = find_method("leapfrog");
  EXPECT_TRUE(
      contains(agreement_of(leapfrog, find_method("bullet/pbd"), small_nets()[0]).sentence(), "different laws"));
  EXPECT_TRUE(contains(agreement_of(leapfrog, find_method("bullet/deformable-explicit"), draw(1, 1).scene()).sentence(),
                       "bullet/deformable-explicit follows another law of contact"));
  EXPECT_TRUE(contains(agreement_of(leapfrog, find_method("truth/converged"), draw(1, 13).scene()).sentence(),
                       "no truth is known"));
}

TEST(Hunt, KeepsTheSmallestSceneOfEachBreak) {
  const Hunt hunt{{heavy("leapfrog"), find_method("rk4")}, {}, 1, 200};
  const long projectile = 8;
  int answers = 0;
  const std::vector<Break> breaks = breaks_of(hunt, projectile, answers);
  EXPECT_GT(answers, 5);
  ASSERT_EQ(breaks.size(), 1U);
  const auto& [answer, smallest] = breaks[0];
  EXPECT_EQ(answer.method, "mysim/leapfrog & mysim/rk4");
  EXPECT_EQ(answer.relation->name, "agreement");
  EXPECT_EQ(smallest.draft.kind(), "gravity");
  EXPECT_EQ(smallest.draft.size(), 1);
  // the file alone suffices to reproduce the answer
  Subject a(hunt.methods[0]), b(hunt.methods[1]);
  EXPECT_EQ(ask_agreement(a, b, smallest.draft.scene(), {}).sentence(), answer.sentence());
  const std::vector<Break> again = breaks_of(hunt, projectile, answers);
  EXPECT_EQ(again.at(0).smallest.draft.text(), smallest.draft.text());
}

}  // namespace
}  // namespace crosscheck
