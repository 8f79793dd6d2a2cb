// Relations: no shipped engine has an unknown violation, each defect is attributed correctly, and no seed raises a
// false alarm.

#include "experiments/check/check.h"
#include "experiments/scenes/scenes.h"
#include "tests/unit/experiments/defects.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(RelationsOfAllEngines, AreBrokenOnlyWhereThatIsKnown) {
  std::vector<Method> methods;
  for (const Stepper& s : steppers()) methods.push_back(find_method(std::string(s.name)));
  for (const char* name : {"bullet/deformable-explicit", "bullet/deformable-implicit", "bullet/pbd+n=10"})
    methods.push_back(find_method(name));
  std::set<std::string> holding;
  for (const Method& method : methods)
    for (const Answer& a : answers_of(method, {}, 1, read_known_breaks(shipped_known_breaks()))) {
      EXPECT_NE(a.mark, RelationMark::broken)
          << a.method << " " << a.relation->name << " " << a.scene << ": " << a.sentence();
      if (a.mark == RelationMark::holds) holding.insert(a.method);
    }
  EXPECT_EQ(holding.size(), methods.size());
}

TEST(Defects, AreNamedByTheirOwnRelationAndNoOther) {
  for (const char* base : {"leapfrog", "bullet/deformable-explicit"})
    for (const Defect& defect : defects()) {
      const Method method = defect.make(base);
      if (const Stepper* rule = stepper_of(method); rule && rule->order < defect.least_order) continue;
      SCOPED_TRACE(fmt::format("{} in {}", defect.what, base));
      std::set<std::string> broken;
      for (const Answer& a : answers_of(method, {}, 1, {}))
        if (a.mark == RelationMark::broken) broken.insert(std::string(a.relation->name));
      EXPECT_TRUE(broken.contains(defect.relation));
      for (const std::string& name : broken)
        EXPECT_TRUE(name == defect.relation || defect.also.contains(name) ||
                    (base != std::string("leapfrog") && defect.also_in_bullet.contains(name)))
            << name << " is broken too";
    }
}

TEST(Seeds, OfTurnsShiftsAndOrdersGiveNoFalseAlarm) {
  for (const char* name : {"leapfrog", "bullet/deformable-explicit"}) {
    Subject subject(find_method(name));
    for (unsigned seed = 2; seed < 42; ++seed)
      for (const char* relation : {"turned", "shifted", "particle-order", "spring-order"}) {
        const Relation& asked = find_relation(relation);
        for (const Scene& scene : asked.smallest()) {
          const Answer answer = ask(asked, subject, scene, seed, {});
          EXPECT_EQ(answer.mark, RelationMark::holds)
              << name << " " << relation << " seed " << seed << ": " << answer.sentence();
        }
      }
  }
}

TEST(IterationError, CoversAStripWhoseErrorIsAllAsymmetry) {
  const Scene scene = load_scene("cloth-cantilever");
  const Relation& mirror = find_relation("mirror");
  for (const char* name : {"bullet/pbd", "bullet/pbd+n=4"}) {
    Subject subject(find_method(name));
    const Answer answer = ask(mirror, subject, scene, 1, {});
    EXPECT_EQ(answer.mark, RelationMark::holds) << name << ": " << answer.sentence();
    // The measured value approaches the bound, which is four times the distance between n and 2n iterations.
    EXPECT_GT(answer.finding.ratio(), 0.6) << name;
  }
}

}  // namespace
}  // namespace crosscheck
