// A new stepper needs one function and one row. This test adds Ralston's rule, runs it, and applies the check that all
// rows of the table must pass. Rows with false declarations must fail.

#include "mysim/run/observers.h"
#include "mysim/steppers/steppers.h"
#include "tests/unit/mysim/declared.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

/// Ralston's rule: k1 = f(X), k2 = f(X + 2/3 h k1), X' = X + h (k1 + 3 k2) / 4.
void ralston(System& f, State& s, double h, Workspace& w) {
  State &k1 = w[0], &k2 = w[1], &stage = w[2];
  f.derivative(s, k1);
  stage.t = s.t + 2 * h / 3;
  stage.x = s.x + 2 * h / 3 * k1.x;
  stage.v = s.v + 2 * h / 3 * k1.v;
  f.derivative(stage, k2);
  s.x += h / 4 * (k1.x + 3 * k2.x);
  s.v += h / 4 * (k1.v + 3 * k2.v);
}

constexpr Stepper ralston_row = {.name = "ralston",
                                 .step = ralston,
                                 .order = 2,
                                 .evaluations = 2,
                                 .first_order = true,
                                 .symplectic = false,
                                 .limit = limits::trapezoidal,  // all two-stage rules of order 2 share its polynomial
                                 .limit_formula = "|1 + z + z^2/2| < 1 at z = h lambda",
                                 .what = "a newcomer"};

TEST(Recipe, EveryRowOfTheTableIsWhatItDeclares) {
  for (const Stepper& s : steppers()) EXPECT_EQ(contradiction(s), "") << s.name;
}

TEST(Recipe, ANewStepperRunsAndIsWhatItDeclares) {
  const Scene scene = small_cloth_in_air();
  DivergenceMonitor monitor(scene.model);
  const Outcome out = simulate(ralston_row, ContactRule::coulomb, scene, {1e-3, 1, 10}, monitor);
  EXPECT_EQ(out.verdict, Verdict::ok);
  EXPECT_EQ(out.evaluations, 2 * 1000);
  EXPECT_EQ(contradiction(ralston_row), "");
}

TEST(Recipe, AWrongOrderIsFound) {
  Stepper wrong = ralston_row;
  wrong.order = 3;
  EXPECT_TRUE(contains(contradiction(wrong), "order 3 is declared, 2."));
  wrong.order = 1;
  EXPECT_TRUE(contains(contradiction(wrong), "order 1 is declared, 2."));
}

TEST(Recipe, AWrongLimitIsFound) {
  Stepper wrong = ralston_row;
  wrong.limit = limits::leapfrog;  // this limit is too long without drag
  EXPECT_TRUE(contains(contradiction(wrong), "is unstable, within the limit"));
  wrong.limit = limits::explicit_euler;  // this limit is too short with drag
  EXPECT_TRUE(contains(contradiction(wrong), "is stable, beyond the limit"));
  wrong.limit = limits::none;
  EXPECT_TRUE(contains(contradiction(wrong), "is unstable, within the limit of inf s"));
}

TEST(Recipe, AStepThatRemembersIsFound) {
  Stepper wrong = ralston_row;
  wrong.step = [](System& f, State& s, double h, Workspace& w) {
    static int calls = 0;
    ralston(f, s, h, w);
    s.x(0, s.x.cols() - 1) *= 1 + 1e-15 * (++calls % 7);
  };
  EXPECT_TRUE(contains(contradiction(wrong), "two runs differ"));
}

}  // namespace
}  // namespace crosscheck
