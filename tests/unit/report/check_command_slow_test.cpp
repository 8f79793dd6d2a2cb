// check on the command line: exit statuses, files, and messages.

#include "mysim/base/json.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

class CliCheck : public Cli {};

TEST_F(CliCheck, PassesWhereOnlyKnownRelationsAreBrokenAndFailsElsewhere) {
  const ProgramResult known = call({"check", "xpbd"});
  EXPECT_EQ(known.status, 0) << known.out;
  EXPECT_TRUE(contains(known.out, "known"));
  EXPECT_TRUE(contains(known.out, "holds            turned"));

  const auto none = write("none.toml", "");
  const ProgramResult broken = call({"check", "xpbd", "--known", none.string(), "--out", "broken"});
  EXPECT_EQ(broken.status, 1);
  EXPECT_TRUE(contains(broken.out, "broken           extension"));
  EXPECT_TRUE(fs::exists(folder_ / "broken/extension-mysim-xpbd-chain-in-drag.png"));
  EXPECT_TRUE(contains(read(folder_ / "broken/index.html"), "alt=\"mysim/xpbd on chain-in-drag\""));

  const ProgramResult nothing = call({"check", "leapfrog", "circle"});
  EXPECT_EQ(nothing.status, 1);
  EXPECT_TRUE(contains(nothing.out, "cannot be asked"));
}

TEST_F(CliCheck, WritesATableJsonAndJUnit) {
  write("own.toml", own_scene);
  const ProgramResult result =
      call({"check", "leapfrog", "own.toml", "--json", "--junit", "check.xml", "--out", "results"});
  EXPECT_EQ(result.status, 0) << result.out;
  const JsonField json = JsonField::parse(result.out, "output");
  EXPECT_EQ(json["format"].whole(), 1);
  EXPECT_TRUE(json["passed"].boolean());
  EXPECT_GT(json["relations"].size(), 5U);
  EXPECT_EQ(json["relations"][0]["scene"].text(), "own");
  const std::string xml = read(folder_ / "check.xml");
  EXPECT_TRUE(contains(xml, "<testsuite name=\"check\""));
  EXPECT_TRUE(contains(xml, "<testcase classname=\"mysim/leapfrog\" name=\"turned: own\"/>"));
  const std::string table = rows(folder_ / "results/relations.csv");
  EXPECT_TRUE(begins(table, "method [1],relation [1],scene [1],mark [1]"));
  EXPECT_TRUE(contains(table, "mysim/leapfrog,turned,own,holds"));
  EXPECT_TRUE(contains(read(folder_ / "results/index.html"), "class=\"parity relations\""));
}

TEST_F(CliCheck, AsksPairs) {
  const ProgramResult result = call({"check", "leapfrog", "rk4", "spring", "--pairs"});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_TRUE(contains(result.out, "holds            agreement         mysim/leapfrog & mysim/rk4"));
}

TEST_F(CliCheck, HuntsGoesOnAndTellsWhatItFound) {
  const auto none = write("none.toml", "");
  // xpbd solves springs one after the other: their order matters on the first kind of scene
  const std::vector<std::string> hunt{"check", "xpbd",  "--known", "none.toml", "--hunt", "1",       "--jobs",
                                      "1",     "--out", "hunt",    "--seed",    "3",      "--shard", "1/12"};
  const ProgramResult first = call(hunt);
  EXPECT_EQ(first.status, 1) << first.err;
  EXPECT_TRUE(contains(first.out, "broken   spring-order"));
  const fs::path scene = folder_ / "hunt/spring-order-mysim-xpbd-springs.toml",
                 text = folder_ / "hunt/spring-order-mysim-xpbd-springs.md";
  ASSERT_TRUE(fs::exists(scene)) << first.out;
  EXPECT_TRUE(fs::exists(folder_ / "hunt/spring-order-mysim-xpbd-springs.png"));
  const std::string told = read(text);
  for (const std::string& part :
       {std::string("**Expected:**"), std::string("**Seen:**"), std::string("times the tolerance of"), read(scene),
        std::string("`crosscheck check mysim/xpbd spring-order-mysim-xpbd-springs.toml --seed "),
        std::string(" --known none.toml`"), std::string("- commit: ")})
    EXPECT_TRUE(contains(told, part));
  // the file shows it again
  const ProgramResult again = call({"check", "xpbd", scene.string(), "--known", "none.toml"});
  EXPECT_EQ(again.status, 1);
  EXPECT_TRUE(contains(again.out, "broken           spring-order"));
  // a second run keeps the cases of the first, and adds to them
  const auto cases = [&] {
    const std::string table = rows(folder_ / "hunt/hunt-cases.csv");
    return std::count(table.begin(), table.end(), '\n');
  };
  const std::string before = rows(folder_ / "hunt/hunt-cases.csv");
  const auto count = cases();
  EXPECT_EQ(call(hunt).status, 1);
  EXPECT_GT(cases(), count);
  EXPECT_TRUE(begins(rows(folder_ / "hunt/hunt-cases.csv"), before));
}

TEST_F(CliCheck, ShardsOfAHuntAreJoined) {
  write("none.toml", "");
  const auto hunt = [&](const char* shard, const char* out, const char* seed) {
    return call({"check", "xpbd", "--known", "none.toml", "--hunt", "0.3", "--jobs", "1", "--seed", seed, "--shard",
                 shard, "--out", out});
  };
  // both parts hold cases in which the order of springs matters
  EXPECT_EQ(hunt("1/24", "one", "3").status, 1);
  EXPECT_EQ(hunt("13/24", "two", "3").status, 1);
  const ProgramResult joined = call({"merge", "two", "one", "two", "--out", "all"});
  EXPECT_EQ(joined.status, 1) << joined.err;
  // the rows of both, each case once, in the order of their numbers
  const auto cases_in = [&](const char* folder) {
    std::vector<long> cases;
    std::istringstream lines(rows(folder_ / folder / "hunt-cases.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) cases.push_back(std::stol(line));
    return cases;
  };
  std::vector<long> both = cases_in("one");
  for (const long other : cases_in("two")) both.push_back(other);
  std::ranges::sort(both);
  EXPECT_GE(both.size(), 2U);
  EXPECT_EQ(cases_in("all"), both);
  const std::string told = read(folder_ / "all/spring-order-mysim-xpbd-springs.md");
  EXPECT_TRUE(contains(told, "cases of this hunt show")) << told;
  EXPECT_TRUE(contains(told, "--known none.toml`")) << told;
  EXPECT_TRUE(fs::exists(folder_ / "all/spring-order-mysim-xpbd-springs.png"));

  hunt("1/24", "other", "4");
  const ProgramResult mixed = call({"merge", "one", "other", "--out", "mixed"});
  EXPECT_EQ(mixed.status, 2);
  EXPECT_TRUE(contains(mixed.err,
                       "other/plan.json: expected cases of the hunt in one: the same methods, known breaks, "
                       "seed and program"))
      << mixed.err;
  fs::remove_all(folder_ / "one/points");
  const ProgramResult gone = call({"merge", "one", "--out", "gone"});
  EXPECT_EQ(gone.status, 2);
  EXPECT_TRUE(contains(gone.err, "the first is case 0")) << gone.err;
}

TEST_F(CliCheck, BadInputIsExitTwoWithAMessage) {
  for (const auto& [words, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"check", "leapfog"}, "leapfrog"},
           {{"check", "leapfrog", "cloth-hnag"}, "did you mean 'cloth-hang'?"},
           {{"check", "cloth-hang"}, "expected at least one method"},
           {{"check", "leapfrog", "gone.toml"}, "gone.toml"},
           {{"check", "leapfrog", "--known", "gone.toml"}, "gone.toml"},
           {{"check", "leapfrog", "--pairs"}, "check --pairs: expected at least two methods"},
           {{"check", "leapfrog", "spring", "--hunt", "1"},
            "expected methods alone, as it draws its scenes, got scene spring"},
           {{"check", "leapfrog", "--hunt", "0"}, "--hunt"},
           {{"check", "leapfrog", "--hunt", "1", "--shard", "3/2"}, "expected I/N with 1 <= I <= N"},
           {{"check", "leapfrog", "--shard", "1/2"}, "--hunt"}}) {
    const ProgramResult result = call(words);
    EXPECT_EQ(result.status, 2) << words.back();
    EXPECT_TRUE(contains(result.err, said));
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
