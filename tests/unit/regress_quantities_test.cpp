// What regress asks, and how far each answer may move: quantities against closed forms, tolerances between engines.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "experiments/regress/rows.h"
#include "experiments/regress/tolerance.h"
#include "tests/unit/question.h"

namespace crosscheck {
namespace {

using testing_tools::question;

/// Seen by one quantity of the table.
Quantities taken(void (*row)(const Seen&, Quantities&), const Question& q, const Answered& answered) {
  Quantities out;
  row({q, answered}, out);
  return out;
}

TEST(Quantities, SettleTimeIsWhereMotionHasDiedAway) {
  const Question q = question("chain");
  Answered decaying;
  for (int i = 0; i <= 100; ++i) {
    LedgerRow row{};
    row.t = 0.1 * i;
    row.energy.kinetic = 3 * std::exp(-row.t);
    decaying.ledger.push_back(row);
  }
  const Quantities settled = taken(settle_time, q, decaying);
  ASSERT_EQ(settled.size(), 1u);
  EXPECT_NEAR(settled[0].value, std::log(100.), 1e-12) << "an exponential is a line between samples";
  decaying.ledger.resize(40);  // 4 s: not there yet
  EXPECT_TRUE(taken(settle_time, q, decaying).empty());
}

TEST(Quantities, OfARunThatSlidesOffABallTheAngleIsThatOfTheClosedForm) {
  const Question q = question("slide");
  const Answered answered = answer_to(q);
  const Quantities angle = taken(leaving_angle, q, answered);
  ASSERT_EQ(angle.size(), 1u);
  // contact ends at 53.1 degrees; a flight of 1 mm above the surface takes some more
  EXPECT_GT(angle[0].value, 53.1);
  EXPECT_LT(angle[0].value, 60);
  EXPECT_TRUE(taken(leaving_angle, question("bounce"), answer_to(question("bounce"))).empty());
}

TEST(Quantities, OfAFailedRunWhenItFailedAndWhatItDidBefore) {
  const Question q = question("cloth-hang", "explicit-euler");
  const std::vector<Toleranced> all = with_tolerances(q);
  std::map<std::string, Toleranced> by_name;
  for (const Toleranced& t : all) by_name[t.quantity.name] = t;
  ASSERT_NE(by_name["verdict"].quantity.word, "ok");
  ASSERT_TRUE(by_name.contains(time_of_failure));
  const Toleranced& when = by_name[time_of_failure];
  EXPECT_GT(when.quantity.value, 0);
  EXPECT_GE(when.tolerance, q.scene.duration / q.scene.samples) << "failures are looked for at samples";
  EXPECT_LT(when.tolerance, 0.5 * when.quantity.value + 3 * q.scene.duration / q.scene.samples);
}

TEST(Quantities, SettingsAreWhatTheEngineTells) {
  const auto settings_of = [](const std::string& method) {
    std::map<std::string, std::string> words;
    const Question q = question("chain", method);
    for (const Quantity& each : quantities_of(q, answer_to(q)))
      if (each.name.starts_with(setting_prefix)) words[each.name] = each.word;
    return words;
  };
  EXPECT_EQ(settings_of("bullet/pbd+n=7")["setting iterations"], "7");
  EXPECT_EQ(settings_of("bullet/deformable-explicit")["setting sleeping"], "off");
  EXPECT_EQ(settings_of("bullet/deformable-explicit+default-sleep")["setting sleeping"], "on");
  EXPECT_EQ(settings_of("bullet/pbd")["setting precision"], "double");
  EXPECT_TRUE(settings_of("mysim/leapfrog").empty());
}

/// What the rounding of a step is taken for must hold where two engines take the same steps in other words.
TEST(Tolerances, HoldBetweenTwoEnginesOfOneRule) {
  for (const char* scene : {"projectile", "chain", "pendulum", "spring"}) {
    const Question ours = question(scene, "symplectic-euler"), theirs = question(scene, "bullet/deformable-explicit");
    const std::vector<Quantity> is = quantities_of(theirs, answer_to(theirs));
    for (const Toleranced& was : with_tolerances(ours)) {
      const Quantity* other = find(is, was.quantity.name);
      if (!other || was.quantity.is_word() || was.quantity.count) continue;
      EXPECT_NEAR(other->value, was.quantity.value, was.tolerance) << scene << ", " << was.quantity.name;
    }
  }
}

}  // namespace
}  // namespace crosscheck
