
#include <gtest/gtest.h>

#include <numbers>

#include "experiments/energy/long_run.h"
#include "experiments/sweep/sweep.h"
#include "experiments/tables/matrix.h"
#include "reference/engines/engines.h"
#include "tests/unit/experiments/helpers.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class MatrixInFolder : public InFolder {};

TableSet untimed_rows(const std::string& methods) {
  Request request;
  request.methods = find_methods(methods);
  auto points = matrix_points(request);
  std::erase_if(points, [](const Point& p) { return p.timed; });
  return computed(points);
}

TEST(Matrix, NeedsAnOutsideEngine) { EXPECT_TRUE(untimed_rows("leapfrog,rk4").table("matrix") == nullptr); }

TEST(Matrix, DampingOfASpringIsThatOfTheory) {
  const double step = 2 * std::numbers::pi / oscillator_omega / 72;
  int compared = 0;
  for (const auto& row :
       rows_of<MatrixRow<false>>(untimed_rows("trapezoidal,implicit-euler,rk4,symplectic-euler,leapfrog,"
                                              "exec:" CROSSCHECK_EXAMPLE))) {
    if (row.question != EngineQuestion::damping_of_spring) continue;
    SCOPED_TRACE(row.method);
    const bool example = row.method.starts_with("exec:");
    const auto theory =
        damping_by_theory(find_method(example ? "symplectic-euler" : row.method), step, oscillator_omega);
    ASSERT_TRUE(theory && row.value && row.bar);
    // The smallest rate here is 7e-7 /s, for rk4. The step has a relative error of 1e-9.
    EXPECT_LT(*row.bar, 2e-7);
    EXPECT_NEAR(*row.value, *theory, *row.bar + 2e-9 * std::abs(*theory));
    ++compared;
  }
  EXPECT_EQ(compared, 6);
}

/// Installs the example engine in place of Rapier, whose adapter has an option for springs as user-supplied forces.
TEST_F(MatrixInFolder, SpringsAsForcesAreAnAnswerOfTheirOwn) {
  const SetVariable cache("CROSSCHECK_CACHE", folder_.c_str());
  const auto program = kept_program("rapier");
  std::filesystem::create_directories(program.parent_path());
  std::filesystem::copy_file(CROSSCHECK_EXAMPLE, program);
  int answers = 0;
  for (const auto& row : rows_of<MatrixRow<false>>(untimed_rows("leapfrog,exec:" + program.string()))) {
    if (row.question != EngineQuestion::damping_by_forces) continue;
    EXPECT_EQ(row.method, "exec:" + program.string());
    // the example engine ignores options, so the rule is symplectic Euler, which adds no damping
    ASSERT_TRUE(row.value && row.bar);
    EXPECT_LE(std::abs(*row.value), *row.bar);
    ++answers;
  }
  EXPECT_EQ(answers, 1);
}

}  // namespace
}  // namespace crosscheck
