// crosscheck advise as people call it, and five cases of the trials (advise_trials.cpp has all).
#include "tests/unit/advise_case.h"
#include "tests/unit/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Advise, FiveCasesMeetTheirTolerance) {
  const std::pair<Scene, double> cases[] = {{load_scene("pendulum"), 0.01},
                                            {load_scene("chain"), 0.001},
                                            {load_scene("circle"), 0.001},
                                            {random_contact_free_scene(3), 0.01},
                                            {random_contact_free_scene(8), 0.001}};
  for (const auto& [scene, part] : cases) {
    const AdviseCase c = advise_case(scene, part);
    EXPECT_TRUE(c.promised) << scene.name << ": " << c.why;
    EXPECT_TRUE(c.met) << scene.name;
    EXPECT_FALSE(c.cheaper) << scene.name;
  }
}

TEST_F(Cli, AdviseWritesAFileThatRuns) {
  const ProgramResult advised = call({"advise", "pendulum", "--tolerance", "1e-3", "--out", "a"});
  ASSERT_EQ(advised.status, 0) << advised.err;
  for (const auto part : {"method", "margin", "cost", "next best"}) EXPECT_TRUE(contains(advised.out, part));
  for (const auto file : {"advice.toml", "advice.json", "advice.csv", "advice-cost.csv", "pendulum-advice.svg"})
    EXPECT_TRUE(fs::exists(folder_ / "a" / file)) << file;
  const ProgramResult run = call({"run", "a/advice.toml", "--out", "r"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "ok"));
}

TEST_F(Cli, AdviseFitsAndRefuses) {
  std::string text = own_scene;
  for (const auto k : {"stiffness = 150", "stiffness = 90"})
    text.replace(text.find(k), std::string(k).size(), "stiffness = \"fit\"");
  write("wish.toml", text + "[wish]\nperiod = 1.5\n");
  const ProgramResult fitted = call({"advise", "wish.toml", "--out", "f"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_TRUE(contains(fitted.out, "stiffness = "));
  EXPECT_TRUE(contains(fitted.out, "period: wished 1.5 s"));
  EXPECT_EQ(call({"run", "f/advice.toml", "--out", "r"}).status, 0);
  const ProgramResult refused = call({"run", "wish.toml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "crosscheck advise"));
  const ProgramResult none = call({"advise", "pendulum"});
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(contains(none.err, "--tolerance: expected a length above zero"));
  const ProgramResult never = call({"advise", "pendulum", "--tolerance", "1e-18"});
  EXPECT_EQ(never.status, 1);
  EXPECT_TRUE(contains(never.err, "cannot promise on pendulum"));
}

}  // namespace
}  // namespace crosscheck
