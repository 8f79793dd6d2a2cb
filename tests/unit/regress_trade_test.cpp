// Accuracy and speed on one line: the sentence of each case, from invented figures.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/regress/trade.h"

namespace crosscheck {
namespace {

SpeedCompared speed(Pace state, const std::string& scene = "chain") {
  SpeedCompared row{scene, "mysim/rk4", 1., state == Pace::slower ? 1.4 : 1 / 1.4};
  row.change = {row.is, row.is, row.is, 9};
  row.state = state;
  return row;
}

Compared answer(const std::string& quantity, double was, double is, const std::string& scene = "chain") {
  Compared row{scene, "mysim/rk4", "", quantity, "m", was, is};
  row.tolerance = 1e-6;
  row.state = std::abs(is - was) > row.tolerance ? Standing::moved : Standing::same;
  return row;
}

Compared error(double was, double is, const std::string& scene = "chain") {
  return answer("error against truth", was, is, scene);
}

std::string fast(const std::vector<Compared>& answers) { return trade_of(speed(Pace::faster), answers); }
std::string slow(const std::vector<Compared>& answers) { return trade_of(speed(Pace::slower), answers); }

TEST(Trades, AreNamed) {
  EXPECT_EQ(fast({error(1e-3, 2.3e-3)}),
            "buys speed with accuracy: 1.4 times faster, error against truth 2.3 times larger");
  EXPECT_EQ(slow({error(2.3e-3, 1e-3)}),
            "buys accuracy with speed: 1.4 times slower, error against truth 2.3 times smaller");
  EXPECT_EQ(fast({error(2.3e-3, 1e-3)}),
            "faster and more accurate: 1.4 times faster, error against truth 2.3 times smaller");
  EXPECT_EQ(slow({error(1e-3, 2.3e-3)}),
            "slower and less accurate: 1.4 times slower, error against truth 2.3 times larger");
  EXPECT_EQ(fast({error(1e-5, 5e-2)}),
            "buys speed with accuracy: 1.4 times faster, error against truth 5000 times larger");
  EXPECT_EQ(fast({error(0, 2e-3)}),
            "buys speed with accuracy: 1.4 times faster, error against truth larger: from 0 to 0.002 m");
}

TEST(Trades, WhatIsNotKnownIsNotClaimed) {
  EXPECT_EQ(fast({answer("offset at 1 s", 1, 1)}), "faster at the same answer: 1.4 times faster");
  EXPECT_EQ(slow({answer("offset at 1 s", 1, 1)}), "slower at the same answer: 1.4 times slower");
  EXPECT_EQ(fast({answer("offset at 1 s", 1, 2)}),
            "1.4 times faster, and the answer moved; whether for the better is not known");
  EXPECT_EQ(fast({answer("offset at 1 s", 1, 2), error(1e-3, 1.0005e-3)}),
            "1.4 times faster, and the answer moved; its error is the same");
  EXPECT_EQ(fast({}), "1.4 times faster; its answer was not asked for");
  EXPECT_EQ(trade_of(speed(Pace::same), std::vector{error(1e-3, 2e-3)}), "");
  EXPECT_EQ(trade_of(speed(Pace::fresh), std::vector{error(1e-3, 2e-3)}), "");
}

TEST(Trades, WorkIsNoPartOfTheAnswerAndAFailureIsWorseThanAnyError) {
  EXPECT_EQ(fast({answer("force evaluations", 4000, 1000)}), "faster at the same answer: 1.4 times faster");
  Compared verdict{"chain", "mysim/rk4", "", "verdict", "word"};
  verdict.was_word = "ok", verdict.is_word = "energy", verdict.state = Standing::moved;
  EXPECT_EQ(fast({verdict}), "1.4 times faster, and the run of chain now ends with the verdict 'energy'");
}

TEST(Trades, OnlyTheSceneItselfUnderTheMethodCounts) {
  std::vector<Compared> others{error(1e-3, 5e-3), error(1e-3, 5e-3), error(1e-3, 5e-3, "spring"),
                               answer("offset at 1 s", 1, 1)};
  others[0].without = "drag", others[1].method = "mysim/leapfrog";
  EXPECT_EQ(fast(others), "faster at the same answer: 1.4 times faster");
}

TEST(Trades, WithoutATruthTheHalvedStepTells) {
  EXPECT_EQ(fast({answer("change at half the step", 1e-3, 3e-3)}),
            "buys speed with accuracy: 1.4 times faster, change at half the step 3 times larger");
  EXPECT_EQ(fast({answer("change at half the step", 1e-3, 3e-3), error(1e-3, 2e-3)}),
            "buys speed with accuracy: 1.4 times faster, error against truth 2 times larger");
}

TEST(Trades, OfTheClothThatIsThereForItsSizeAllScenesOfTheMethodTell) {
  const auto cloth = [](const std::vector<Compared>& answers) {
    return trade_of(speed(Pace::faster, "cloth-32x32"), answers);
  };
  EXPECT_EQ(cloth({error(1e-3, 2e-3), error(1e-3, 4e-3, "spring")}),
            "buys speed with accuracy: 1.4 times faster, error against truth 4 times larger on spring");
  EXPECT_EQ(cloth({error(1e-3, 2e-3), error(4e-3, 1e-3, "spring")}),
            "1.4 times faster, more accurate here and less there: error against truth 2 times larger on chain, error "
            "against truth 4 times smaller on spring");
}

TEST(Trades, AreListedWithTheirScene) {
  std::vector<SpeedCompared> speeds{speed(Pace::same), speed(Pace::slower)};
  const auto told = tell_trades(speeds, std::vector{error(1e-3, 1e-3)});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], "chain under mysim/rk4: slower at the same answer: 1.4 times slower");
  EXPECT_EQ(speeds[1].sentence, "slower at the same answer: 1.4 times slower");
  EXPECT_TRUE(speeds[0].sentence.empty());
}

}  // namespace
}  // namespace crosscheck
