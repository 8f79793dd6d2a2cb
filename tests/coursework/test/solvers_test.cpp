// Too much acceleration in a6-solvers: the hand-out's formulas compared with simulated steps.
#include <gtest/gtest.h>

#include "tests/coursework/a6-solvers/cases.h"

namespace coursework::a6 {
namespace {

/// A smaller version of the course's net, flat and at rest, without gravity.
Scene flat() {
  Scene s = square(5, 2, 1);
  s.stiffness = 8000, s.h = 0.0333;
  return s;
}

/// The net with its particles displaced a little within its plane.
Scene disturbed() {
  Scene s = flat();
  Random random(3);
  for (int i = 0; i < s.x.cols(); ++i)
    if (!s.held[i]) s.x.col(i) += 1e-7 * crosscheck::Vec3(random.uniform(-1, 1), 0, random.uniform(-1, 1));
  return s;
}

/// True if speeds are higher after 1000 steps than after 500. A growing deviation changes its sign in each step, so
/// that its speed is high.
bool explodes(int passes, double rho) {
  Scene s = disturbed();
  double before = 0;
  for (int i = 1; i <= 1000; ++i) {
    step(s, passes, rho);
    if (i == 500) before = s.v.norm();
  }
  return !(s.v.norm() < before);
}

double theory(int passes) {
  const Scene s = flat();
  const Eigen::MatrixXd b = s.iteration();
  return diverges_from(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(b).eigenvalues(), 1 / (s.h * s.h) / s.slope(),
                       passes);
}

// Compares values of 1 - rho, because rho is near 1.
TEST(Solvers, ExplodeFromTheRhoThatEigenvaluesSay) {
  for (const int passes : {4, 8}) {
    const double expected = theory(passes);
    ASSERT_GT(expected, 0.5);
    ASSERT_LT(expected, 0.999);
    EXPECT_TRUE(explodes(passes, 1 - 0.99 * (1 - expected))) << passes << " passes, expected " << expected;
    EXPECT_FALSE(explodes(passes, 1 - 1.01 * (1 - expected))) << passes << " passes, expected " << expected;
  }
}

TEST(Solvers, ThirtyTwoPassesAreSafeWithTheRhoOfTheCourse) {
  EXPECT_GT(theory(32), 0.995);
  EXPECT_LT(theory(8), 0.995);
}

}  // namespace
}  // namespace coursework::a6
