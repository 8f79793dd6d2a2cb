// Tests that `engine` builds the adapters for Debian's engines, and that they follow mysim's rule.

#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

struct Packaged {
  std::string name, options;  // options: those that make the engine use symplectic Euler with drag
};

class PackagedEngine : public Cli, public ::testing::WithParamInterface<Packaged> {
 protected:
  /// Builds the adapter, or skips the test if a package is missing.
  void SetUp() override {
    Cli::SetUp();
    const ProgramResult made = call({"engine", GetParam().name, "-o", GetParam().name});
    const size_t missing = made.err.find("package "), end = made.err.find(" is not installed");
    if (end != std::string::npos) GTEST_SKIP() << made.err.substr(missing, end - missing) << " is not installed";
    ASSERT_EQ(made.status, 0) << made.err;
  }
  std::string engine() const { return "exec:" + (folder_ / GetParam().name).string(); }
};
INSTANTIATE_TEST_SUITE_P(Debian, PackagedEngine,
                         ::testing::Values(Packaged{"mujoco", "+drag=callback"}, Packaged{"simbody", ""},
                                           Packaged{"ode", ""}),
                         [](const auto& of) { return of.param.name; });

TEST_P(PackagedEngine, IsSymplecticEulerToRoundOff) {
  const std::string method = engine() + GetParam().options;
  const ProgramResult compared = call({"compare", "chain", "--methods", "symplectic-euler," + method});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
  EXPECT_TRUE(contains(compared.out, "read back, no mismatch\n")) << compared.out;
  EXPECT_TRUE(contains(compared.out, "mysim/symplectic-euler and " + method + " use the same rule")) << compared.out;
  EXPECT_FALSE(contains(compared.out, "NOT THE SAME")) << compared.out;
}

TEST_P(PackagedEngine, LacksNothingOfTheProtocol) {
  const ProgramResult kit = call({"check", "--protocol", engine()});
  EXPECT_EQ(kit.status, 0) << kit.out;
  EXPECT_TRUE(contains(kit.out, " 0 lacking, of which 0 required")) << kit.out;
}

}  // namespace
}  // namespace crosscheck::testing_tools
