#include <algorithm>

#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {

// Tests `regress` on the command line: blessed results remain valid, changes are detected, and nothing is blessed by
// mistake.

namespace {

class CliRegress : public Cli {
 protected:
  /// `ci`: value of the variable CI.
  ProgramResult regress(std::vector<std::string> words, const std::string& ci = "") const {
    words.insert(words.begin(), {CROSSCHECK_PROGRAM, "regress", "--baselines", "mine"});
    return run_program(words, folder_, {"ASAN_OPTIONS=detect_leaks=0", "CI=" + ci});
  }
  ProgramResult bless(const std::string& filter, const std::string& reason = "as it is today") const {
    return regress({"--filter", filter, "--bless", "--reason", reason});
  }
};

TEST_F(CliRegress, WhatIsBlessedIsTheSameAndTheFileStaysAsItIs) {
  const ProgramResult missing = regress({"--filter", "pendulum"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.out.find("missing    pendulum: baseline"), std::string::npos) << missing.out;
  ASSERT_EQ(bless("pendulum").status, 0);
  const std::string file = read(folder_ / "mine/pendulum.csv");
  const ProgramResult same = regress({"--filter", "pendulum"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_NE(same.out.find("0 failed"), std::string::npos) << same.out;
  const ProgramResult again = bless("pendulum");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("0 quantities blessed"), std::string::npos) << again.out;
  EXPECT_EQ(read(folder_ / "mine/pendulum.csv"), file) << "nothing changed, so no blessing is needed";
}

TEST_F(CliRegress, AChangedValueIsCaughtNamedAndBlessedByItself) {
  ASSERT_EQ(bless("spring").status, 0);
  const std::string good = read(folder_ / "mine/spring.csv");
  std::string bad = good;
  const size_t row = bad.find("mysim/rk4,,always,peak stretch");
  ASSERT_NE(row, std::string::npos);
  bad.replace(bad.find(",1,", row) + 3, 1, "7");  // first digit of the value
  write("mine/spring.csv", bad);
  const ProgramResult caught = regress({"--filter", "spring"});
  EXPECT_EQ(caught.status, 1);
  EXPECT_NE(caught.out.find("moved      spring, mysim/rk4: peak stretch: was 7"), std::string::npos) << caught.out;
  EXPECT_NE(caught.out.find("1 failed"), std::string::npos) << caught.out;
  EXPECT_NE(read(folder_ / "out/regress/junit.xml").find("failures=\"1\""), std::string::npos);
  EXPECT_NE(read(folder_ / "out/regress/regress.json").find("\"passed\": false"), std::string::npos);

  const ProgramResult other = bless("spring/mysim/leapfrog", "another method");
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_EQ(read(folder_ / "mine/spring.csv"), bad) << "blessing unchanged rows changes nothing";
  const ProgramResult blessed = bless("spring/mysim/rk4", "the digit was wrong");
  EXPECT_EQ(blessed.status, 0) << blessed.err;
  EXPECT_NE(blessed.out.find("was 7"), std::string::npos) << "expected the value before the change: " << blessed.out;
  EXPECT_NE(read(folder_ / "mine/spring.csv").find("# blessing 2: "), std::string::npos);
  EXPECT_NE(read(folder_ / "mine/spring.csv").find("| the digit was wrong"), std::string::npos);
  EXPECT_EQ(regress({"--filter", "spring"}).status, 0);
}

TEST_F(CliRegress, AMethodThatNoBaselineKnowsIsNewAndPasses) {
  ASSERT_EQ(bless("spring/mysim/leapfrog").status, 0);
  const ProgramResult run = regress({"--filter", "spring/mysim/@(leapfrog|rk4)"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_NE(run.out.find("new        mysim/rk4: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(" in 1 scene, not blessed yet; bless with --filter '*/mysim/rk4'\n"), std::string::npos);
  EXPECT_EQ(run.out.find("new        mysim/leapfrog"), std::string::npos) << run.out;
  EXPECT_NE(read(folder_ / "out/regress/index.html").find("<h2>New methods</h2>"), std::string::npos);
  EXPECT_NE(rows(folder_ / "out/regress/regress.csv").find(",new,"), std::string::npos);
  const std::string json = read(folder_ / "out/regress/regress.json");
  EXPECT_NE(json.find("\"method\": \"mysim/rk4\"", json.find("\"new_methods\"")), std::string::npos) << json;
}

TEST_F(CliRegress, StaleAndUnreadableBaselinesFail) {
  ASSERT_EQ(bless("spring").status, 0);
  const std::string good = read(folder_ / "mine/spring.csv");
  std::string other = good;
  other.replace(other.find("# hash: ") + 8, 16, "0123456789abcdef");
  write("mine/spring.csv", other);
  const ProgramResult stale = regress({"--filter", "spring"});
  EXPECT_EQ(stale.status, 1);
  EXPECT_NE(stale.out.find("stale      spring: baseline"), std::string::npos) << stale.out;
  const ProgramResult part = bless("spring/mysim/rk4");
  EXPECT_EQ(part.status, 2);
  EXPECT_NE(part.err.find("expected the whole scene to be blessed"), std::string::npos) << part.err;
  write("mine/spring.csv", good.substr(0, good.size() / 2));
  const ProgramResult torn = regress({"--filter", "spring"});
  EXPECT_EQ(torn.status, 1);
  EXPECT_NE(torn.out.find("unreadable spring: baseline: "), std::string::npos) << torn.out;
}

TEST_F(CliRegress, BadUseIsNamed) {
  const struct {
    std::vector<std::string> words;
    const char *ci, *says;
  } cases[] = {
      {{"--filter", "spring", "--bless"}, "", "expected --reason TEXT"},
      {{"--filter", "spring", "--bless", "--reason", "x"}, "true", "CI never blesses"},
      {{"--filter", "spring", "--bless", "--reason", "a | b"}, "", "expected a text without '|'"},
      {{"--filter", "nothing-like-it"}, "", "no scene and method match"},
      {{"--filter", "spring", "--against", "rk4"}, "", "--against: expected one --method"},
      {{"--filter", "spring", "--method", "rk5"}, "", "unknown method 'rk5'"},
  };
  for (const auto& [words, ci, says] : cases) {
    const ProgramResult result = regress(words, ci);
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
  }
  const ProgramResult bisected = regress({"--filter", "spring", "--method", "rk5", "--bisect"});
  EXPECT_EQ(bisected.status, 125) << "git bisect reads this as 'cannot be tested'";
  EXPECT_FALSE(fs::exists(folder_ / "mine"));
}

TEST_F(CliRegress, OneMethodBesideAnother) {
  const ProgramResult same = regress({"--filter", "chain", "--method", "leapfrog", "--against", "leapfrog"});
  EXPECT_EQ(same.status, 0) << same.out;
  // Bullet sums in another order, so that results differ by round-off
  const ProgramResult twins =
      regress({"--filter", "spring", "--method", "bullet/deformable-explicit", "--against", "symplectic-euler"});
  EXPECT_EQ(twins.status, 0) << twins.out;
  const ProgramResult other = regress({"--filter", "spring", "--method", "symplectic-euler", "--against", "leapfrog"});
  EXPECT_EQ(other.status, 1) << other.out;
  EXPECT_NE(other.out.find("moved      spring, mysim/symplectic-euler"), std::string::npos) << other.out;
  // without contact and springs, an external engine with the same rule agrees exactly
  const ProgramResult outside =
      regress({"--filter", "projectile", "--method", "exec:" CROSSCHECK_EXAMPLE, "--against", "symplectic-euler"});
  EXPECT_EQ(outside.status, 0) << outside.out;
  const ProgramResult precision = regress(
      {"--filter", "chain", "--method", "bullet32/deformable-explicit", "--against", "bullet/deformable-explicit"});
  EXPECT_EQ(precision.status, 1) << precision.out;
}

TEST_F(CliRegress, SettingsOfBulletAreToldApartAndNamed) {
  const struct {
    const char *scene, *is, *was, *setting;
  } cases[] = {
      {"chain", "bullet/pbd+n=10", "bullet/pbd", "setting iterations: was 1, is 10"},
      {"chain", "bullet32/deformable-explicit", "bullet/deformable-explicit",
       "setting precision: was double, is single"},
      {"slide", "bullet/deformable-explicit+default-margin", "bullet/deformable-explicit", "setting margin: was "},
      {"pendulum", "bullet/deformable-explicit+default-sleep", "bullet/deformable-explicit",
       "setting sleeping: was off, is on"},
  };
  for (const auto& [scene, is, was, setting] : cases) {
    const ProgramResult result = regress({"--filter", scene, "--method", is, "--against", was, "--figures", "0"});
    EXPECT_EQ(result.status, 1) << result.out;
    EXPECT_NE(result.out.find(setting), std::string::npos) << result.out;
  }
}

TEST_F(CliRegress, AFailureHasItsCurvesItsPicturesAndTheTimeAtWhichTheyPart) {
  const ProgramResult result =
      regress({"--filter", "chain", "--method", "symplectic-euler", "--against", "leapfrog", "--figures", "1"});
  EXPECT_EQ(result.status, 1) << result.out;
  const std::string page = read(folder_ / "out/regress/index.html");
  EXPECT_NE(page.find("They differ by more than the tolerance between 0 s and"), std::string::npos);
  EXPECT_NE(page.find("quantities failed"), std::string::npos);
  EXPECT_NE(page.find("data:image/webp"), std::string::npos) << "a picture of both runs";
  for (const char* figure : {"curve.svg", "difference.svg", "shape.png"})
    EXPECT_TRUE(fs::exists(folder_ / "out/regress/figures" / (std::string("chain-mysim-symplectic-euler-") + figure)));
  regress({"--filter", "chain", "--method", "symplectic-euler", "--against", "leapfrog", "--figures", "0"});
  EXPECT_FALSE(fs::exists(folder_ / "out/regress/index.html")) << "a page of an earlier run must not remain";
}

TEST_F(CliRegress, ABlessingKeepsAFigureOfWhatMovedAndTheShape) {
  ASSERT_EQ(bless("spring/mysim/leapfrog").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/spring-shape.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "mine/spring-blessing-1.svg")) << "there was nothing before";
  std::string text = read(folder_ / "mine/spring.csv");
  const size_t row = text.find("mysim/leapfrog,,always,sag");
  ASSERT_NE(row, std::string::npos);
  text.replace(text.find(",m,", row) + 3, 1, "7");
  write("mine/spring.csv", text);
  const ProgramResult blessed = bless("spring/mysim/leapfrog", "the digit was wrong");
  EXPECT_EQ(blessed.status, 0) << blessed.err;
  EXPECT_TRUE(fs::exists(folder_ / "mine/spring-blessing-2.svg")) << blessed.out;
  EXPECT_NE(read(folder_ / "out/regress/index.html").find("1 quantities blessed: the digit was wrong"),
            std::string::npos);
}

TEST_F(CliRegress, AUsersOwnSceneHasBaselinesToo) {
  std::string scene = read(fs::path(CROSSCHECK_SOURCE) / "experiments/scenes/pendulum.toml");
  write("my-swing.toml", scene);
  const std::vector<std::string> ask{"my-swing.toml", "--method", "leapfrog"};
  EXPECT_EQ(regress(ask).status, 1) << "there is no baseline yet";
  ASSERT_EQ(regress({"my-swing.toml", "--method", "leapfrog", "--bless", "--reason", "mine", "--full"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/my-swing.csv"));
  EXPECT_EQ(regress(ask).status, 0);
  scene.replace(scene.find("-9.81"), 5, "-9.82");
  write("my-swing.toml", scene);
  const ProgramResult stale = regress(ask);
  EXPECT_EQ(stale.status, 1);
  EXPECT_NE(stale.out.find("stale      my-swing: baseline"), std::string::npos) << stale.out;
}

/// If a method was removed, its quantities must not look like a success.
TEST_F(CliRegress, WhatNobodyAsksAnyMoreIsSaid) {
  ASSERT_EQ(regress({"projectile", "--bless", "--full", "--reason", "all of it"}).status, 0);
  EXPECT_EQ(regress({"projectile"}).status, 0);
  std::string text = read(folder_ / "mine/projectile.csv");
  const size_t at = text.find("# rows: ");
  const int rows = std::stoi(text.substr(at + 8));
  text.replace(at + 8, std::to_string(rows).size(), std::to_string(rows + 1));
  text += "mysim/forgotten,,always,verdict,word,ok,0,1,word\n";
  write("mine/projectile.csv", text);
  const ProgramResult rot = regress({"projectile"});
  EXPECT_EQ(rot.status, 1);
  EXPECT_NE(rot.out.find("gone       projectile, mysim/forgotten: all: no longer measured"), std::string::npos)
      << rot.out;
  EXPECT_EQ(regress({"projectile", "--method", "leapfrog"}).status, 0) << "the requested part exists";
  ASSERT_EQ(regress({"projectile", "--bless", "--full", "--reason", "it was taken out"}).status, 0);
  EXPECT_EQ(regress({"projectile"}).status, 0);
}

/// Five of the mutants, each on a scene that reveals it; tests/mutants/prove.sh runs all.
TEST_F(CliRegress, MutantsAreCaughtAndTheOriginalIsNot) {
  const struct {
    const char *mutant, *scene;
  } some[] = {{"spring-softer", "spring"},
              {"leapfrog-drag", "chain"},
              {"friction-of-velocities-off", "slide"},
              {"restitution-sign", "bounce"},
              {"suzuki4-coefficient", "normal-modes"}};
  const std::string program = fs::path(CROSSCHECK_PROGRAM).replace_filename("crosscheck-mutants");
  for (const auto& [mutant, scene] : some) {
    SCOPED_TRACE(mutant);
    ASSERT_EQ(bless(scene).status, 0);
    const auto status = [&](const std::string& name) {
      return run_program({program, "regress", "--baselines", "mine", "--filter", scene, "--figures", "0"}, folder_,
                         {"ASAN_OPTIONS=detect_leaks=0", "CROSSCHECK_MUTANT=" + name})
          .status;
    };
    EXPECT_EQ(status(mutant), 1);
    EXPECT_EQ(status("none"), 0);
  }
}

/// Variants of sin, exp and pow that round twice instead of fusing must not raise false alarms.
TEST_F(CliRegress, OtherVariantsOfTheLibraryPass) {
  const ProgramResult same =
      run_program({CROSSCHECK_PROGRAM, "regress", "--filter", "spring/mysim/*"}, folder_,
                  {"ASAN_OPTIONS=detect_leaks=0", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F"});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
}

}  // namespace
}  // namespace crosscheck::testing_tools
