// Tests that the example code of report/CONTRACT.md reads a run correctly.

#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class Contract : public Cli {};

TEST_F(Contract, ExampleReadsARunToWithinTheStatedBound) {
  constexpr auto python = "/usr/bin/python3";
  if (!fs::exists(python) || run_program({python, "-c", "import numpy"}, "/").status != 0)
    GTEST_SKIP() << "package python3-numpy is not installed: the example of CONTRACT.md is not tested";
  ASSERT_EQ(call({"report", "chain", "--quick", "--methods", "leapfrog,rk4", "--out", "rep"}).status, 0);
  ASSERT_EQ(call({"run", "chain", "--method", "leapfrog", "--out", "run"}).status, 0);
  const std::string text = read(fs::path(CROSSCHECK_SOURCE) / "report/CONTRACT.md"), begin = "```python\n";
  const size_t from = text.find(begin) + begin.size();
  std::string example = text.substr(from, text.find("```", from) - from);
  EXPECT_LE(std::count(example.begin(), example.end(), '\n'), 15);
  write("example.py", example + R"(
run, positions = read_run("rep", "chain-engines", "mysim/leapfrog")
trajectory = np.load("run/trajectory.npy")
trajectory = trajectory[::(len(trajectory) - 1) // (run["frames"] - 1)]
assert positions.shape == trajectory.shape, (positions.shape, trajectory.shape)
worst = abs(positions - trajectory).max()
assert 0 < worst <= run["bound"], (worst, run["bound"])
)");
  const ProgramResult read = run_program({python, "example.py"}, folder_);
  EXPECT_EQ(read.status, 0) << read.err;
}

}  // namespace
}  // namespace crosscheck
