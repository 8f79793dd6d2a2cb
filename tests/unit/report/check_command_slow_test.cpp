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
  EXPECT_TRUE(contains(nothing.out, "not applicable"));
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

TEST_F(CliCheck, BadInputIsExitTwoWithAMessage) {
  for (const auto& [words, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"check", "leapfog"}, "leapfrog"},
           {{"check", "leapfrog", "cloth-hnag"}, "did you mean 'cloth-hang'?"},
           {{"check", "cloth-hang"}, "expected at least one method"},
           {{"check", "leapfrog", "gone.toml"}, "gone.toml"},
           {{"check", "leapfrog", "--known", "gone.toml"}, "gone.toml"}}) {
    const ProgramResult result = call(words);
    EXPECT_EQ(result.status, 2) << words.back();
    EXPECT_TRUE(contains(result.err, said));
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
