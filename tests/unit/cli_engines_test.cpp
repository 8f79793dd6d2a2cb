// What compare and engine say of engines: parity, equal rules, trajectories from outside, adapters that do not build.
#include "tests/unit/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST_F(Cli, CompareStopsAtAMismatch) {
  const ProgramResult result =
      call({"compare", "spring", "--methods", "leapfrog,bullet/deformable-explicit+default-rest", "--out", "out"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("mismatch       springs: rest lengths"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("MISMATCH: bullet/deformable-explicit+default-rest was given another scene"),
            std::string::npos)
      << result.out;
  // the other side of it
  EXPECT_EQ(call({"compare", "spring", "--methods", "leapfrog,bullet/deformable-explicit", "--out", "out"}).status, 0);
}

TEST_F(Cli, CompareShowsParityAndThatEqualRulesAgree) {
  const ProgramResult result = call({"compare", "chain", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("parity of bullet/deformable-explicit"), std::string::npos);
  EXPECT_NE(result.out.find("same rule"), std::string::npos);
  EXPECT_EQ(result.out.find("NOT THE SAME"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/certificate-bullet-pbd.json"));
}

TEST_F(Cli, CompareTakesATrajectoryFromAFile) {
  ASSERT_EQ(call({"run", "chain", "--method", "symplectic-euler", "--out", "theirs"}).status, 0);
  const ProgramResult result = call({"compare", "chain", "--methods", "symplectic-euler,leapfrog", "--trajectory",
                                     "theirs/trajectory.npy", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  const size_t at = result.out.find("\nfile:trajectory.npy");
  ASSERT_NE(at, std::string::npos) << result.out;
  std::istringstream row(result.out.substr(at));
  std::string name, verdict, error, difference;
  row >> name >> verdict >> error >> difference;
  EXPECT_EQ(verdict, "ok");
  EXPECT_EQ(difference, "0") << "the same run";
  EXPECT_NE(result.out.find("parity of file:trajectory.npy"), std::string::npos);
  ASSERT_EQ(call({"run", "chain", "--duration", "1", "--out", "short"}).status, 0);
  const ProgramResult refused = call({"compare", "chain", "--trajectory", "short/trajectory.npy"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("expected shape (151, 4, 3)"), std::string::npos) << refused.err;
}

TEST_F(Cli, AnEngineThatDoesNotBuildSaysWhatTheCompilerSaid) {
  fs::create_directories(folder_ / "tree/include/bullet/BulletSoftBody");
  write("tree/include/bullet/btBulletDynamicsCommon.h", "");
  const ProgramResult result = call({"engine", "bullet", "--prefix", "tree", "-o", "engine"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("libBulletSoftBody"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("tree/lib*"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "engine"));
}

}  // namespace
}  // namespace crosscheck
