// regress --prove-builds, as far as it takes no compiler: the program itself with the C library's other variants.
#include "tests/unit/cli.h"

namespace crosscheck::testing_tools {
namespace {

class CliRegressBuilds : public Cli {
 protected:
  ProgramResult prove(std::vector<std::string> words) const {
    words.insert(words.begin(), {"regress", "--prove-builds", "--filter", "spring/mysim/*", "--out", "out"});
    return call(words);
  }
};

TEST_F(CliRegressBuilds, ABadNameIsNamedAndNothingIsBuilt) {
  const ProgramResult unknown = prove({"--build", "gcc-O9"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("--build gcc-O9: no such build; expected one of: gcc-O3, gcc-O2"), std::string::npos)
      << unknown.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(call({"regress", "--build", "gcc-O3"}).status, 2) << "a build of what is not asked for";
  EXPECT_EQ(call({"regress", "--prove-builds", "--filter", "nothing-like-it"}).status, 2);
}

TEST_F(CliRegressBuilds, OtherVariantsOfTheLibraryPassAndAChangedBaselineDoesNot) {
  const ProgramResult same = prove({"--build", "no-fma"});
  if (same.out.starts_with("not here"))
    GTEST_SKIP() << "this machine has no other variant of the C library: " << same.out;
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_TRUE(same.out.starts_with("passed       no-fma ")) << same.out;
  EXPECT_NE(same.out.find(" quantities: 0 failed, "), std::string::npos) << same.out;
  EXPECT_NE(same.out.find(" identical, "), std::string::npos) << same.out;
  EXPECT_NE(same.out.find("1 builds passed, 0 with a false alarm"), std::string::npos) << same.out;
  EXPECT_NE(rows(folder_ / "out/builds.csv").find("no-fma,"), std::string::npos);
  EXPECT_NE(rows(folder_ / "out/no-fma/regress.csv").find("tolerances off"), std::string::npos);

  std::string bad = read(CROSSCHECK_SOURCE "/reference/baselines/spring.csv");
  const size_t row = bad.find("mysim/rk4,,always,peak stretch");
  ASSERT_NE(row, std::string::npos);
  bad.replace(bad.find(",1,", row) + 3, 1, "7");  // the first digit of the value
  fs::create_directories(folder_ / "mine");
  write("mine/spring.csv", bad);
  const ProgramResult caught = prove({"--build", "no-fma", "--baselines", "mine"});
  EXPECT_EQ(caught.status, 1);
  EXPECT_TRUE(caught.out.starts_with("FALSE ALARM  no-fma ")) << caught.out;
  EXPECT_NE(caught.out.find("1 failed"), std::string::npos) << caught.out;
  EXPECT_NE(caught.out.find("tolerances at most (spring, mysim/rk4: peak stretch)"), std::string::npos) << caught.out;
}

}  // namespace
}  // namespace crosscheck::testing_tools
