// Adapters of engines that Debian packages: compiled by the call in their first lines, they obey mysim's rule.

#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

struct Packaged {
  std::string name, header, package, options;  // with these options it is symplectic Euler, drag included
  std::vector<std::string> libraries;
};

class PackagedEngine : public Cli, public ::testing::WithParamInterface<Packaged> {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (!on_path("g++")) GTEST_SKIP() << "package g++ is not installed";
    if (!fs::exists(GetParam().header)) GTEST_SKIP() << "package " << GetParam().package << " is not installed";
  }
  /// Compiles the adapter and returns the method's name; empty on failure.
  std::string built() const {
    const fs::path source = CROSSCHECK_SOURCE;
    const std::string program = (folder_ / GetParam().name).string();
    std::vector<std::string> words{"g++",
                                   "-std=c++17",
                                   "-O2",
                                   "-ffp-contract=off",
                                   "-I",
                                   (source / "reference/protocol").string(),
                                   "-I",
                                   "/usr/include/simbody",
                                   (source / "reference/engines" / (GetParam().name + ".cpp")).string(),
                                   "-o",
                                   program};
    for (const std::string& library : GetParam().libraries) words.push_back("-l" + library);
    const ProgramResult made = run_program(words, folder_);
    EXPECT_EQ(made.status, 0) << made.err;
    return made.status == 0 ? "exec:" + program : "";
  }
};
INSTANTIATE_TEST_SUITE_P(
    Debian, PackagedEngine,
    ::testing::Values(Packaged{"mujoco", "/usr/include/mujoco/mujoco.h", "libmujoco-dev", "+drag=callback", {"mujoco"}},
                      Packaged{"simbody",
                               "/usr/include/simbody/Simbody.h",
                               "libsimbody-dev",
                               "",
                               {"SimTKsimbody", "SimTKmath", "SimTKcommon"}},
                      Packaged{"ode", "/usr/include/ode/ode.h", "libode-dev", "", {"ode"}}),
    [](const auto& of) { return of.param.name; });

TEST_P(PackagedEngine, IsSymplecticEulerToRoundOff) {
  const std::string engine = built();
  ASSERT_FALSE(engine.empty());
  const std::string method = engine + GetParam().options;
  const ProgramResult compared = call({"compare", "chain", "--methods", "symplectic-euler," + method});
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
  EXPECT_TRUE(contains(compared.out, "read back, no mismatch\n")) << compared.out;
  EXPECT_TRUE(contains(compared.out, "mysim/symplectic-euler and " + method + " are the same rule")) << compared.out;
  EXPECT_FALSE(contains(compared.out, "NOT THE SAME")) << compared.out;
}

TEST_P(PackagedEngine, LacksNothingOfTheProtocol) {
  const std::string engine = built();
  ASSERT_FALSE(engine.empty());
  const ProgramResult kit = call({"check", "--protocol", engine});
  EXPECT_EQ(kit.status, 0) << kit.out;
  EXPECT_TRUE(contains(kit.out, " 0 lacking, of which 0 required")) << kit.out;
}

}  // namespace
}  // namespace crosscheck::testing_tools
