// regress and speed on the command line. What is timed here differs by a factor of two at least.
#include <algorithm>

#include "tests/unit/cli.h"

namespace crosscheck::testing_tools {
namespace {

class CliSpeed : public Cli {
 protected:
  ProgramResult regress(std::vector<std::string> words) const {
    words.insert(words.begin(), {CROSSCHECK_PROGRAM, "regress", "--baselines", "mine"});
    return run_program(words, folder_, {"ASAN_OPTIONS=detect_leaks=0", "CI="});
  }
  std::string speeds() const { return read(folder_ / "mine/speed-cost.csv"); }
  /// The file with the ratio of its only row multiplied.
  void multiply_ratio(double factor) const {
    std::string text = speeds();
    const size_t begin = text.find(",mysim/leapfrog,") + std::string(",mysim/leapfrog,").size();
    const size_t end = text.find(',', begin);
    write("mine/speed-cost.csv",
          text.replace(begin, end - begin, std::to_string(factor * std::stod(text.substr(begin, end - begin)))));
  }
};

TEST_F(CliSpeed, IsBlessedAndComparedAndNamed) {
  ASSERT_EQ(regress({"--filter", "spring", "--bless", "--reason", "today", "--no-speed"}).status, 0);
  const ProgramResult none = regress({"--filter", "spring"});
  EXPECT_EQ(none.status, 0) << none.out;
  EXPECT_NE(none.out.find("speeds not compared: mine/speed-cost.csv: no such file"), std::string::npos) << none.out;
  const ProgramResult blessed = regress({"--filter", "spring", "--bless", "--reason", "speed, too"});
  EXPECT_EQ(blessed.status, 0) << blessed.err;
  EXPECT_NE(blessed.out.find("1 speeds blessed"), std::string::npos) << blessed.out;
  EXPECT_NE(speeds().find("| speed, too\n"), std::string::npos) << speeds();
  const std::string good = speeds();

  multiply_ratio(1. / 3);
  const ProgramResult slower = regress({"--filter", "spring"});
  EXPECT_EQ(slower.status, 1) << slower.out;
  EXPECT_NE(slower.out.find("slower     spring, mysim/leapfrog: slower at the same answer: "), std::string::npos)
      << slower.out;
  EXPECT_NE(read(folder_ / "out/regress/regress.json").find("\"state\": \"slower\""), std::string::npos);
  EXPECT_NE(read(folder_ / "out/regress/junit.xml").find("name=\"mysim/leapfrog: speed\"><failure"), std::string::npos);
  EXPECT_NE(rows(folder_ / "out/regress/speed-cost.csv").find("slower at the same answer"), std::string::npos);
  EXPECT_EQ(regress({"--filter", "spring", "--no-speed"}).status, 0);
  EXPECT_EQ(regress({"--filter", "spring", "--bisect"}).status, 0) << "speed is not what is looked for";
  EXPECT_EQ(regress({"--filter", "spring", "--bisect", "--speed"}).status, 1);

  write("mine/speed-cost.csv", good);
  multiply_ratio(3);
  const ProgramResult faster = regress({"--filter", "spring"});
  EXPECT_EQ(faster.status, 0) << faster.out;
  EXPECT_NE(faster.out.find("faster at the same answer: "), std::string::npos) << faster.out;

  std::string other = good;
  other.replace(other.find("# machine 1: ") + 13, 1, "another ");
  write("mine/speed-cost.csv", other);
  multiply_ratio(1. / 3);
  const ProgramResult elsewhere = regress({"--filter", "spring"});
  EXPECT_EQ(elsewhere.status, 0) << elsewhere.out;
  EXPECT_NE(elsewhere.out.find("1 of 1 speeds not compared: blessed on another processor (another "), std::string::npos)
      << elsewhere.out;

  write("mine/speed-cost.csv", good.substr(0, good.find("spring,")));
  const ProgramResult damaged = regress({"--filter", "spring"});
  EXPECT_EQ(damaged.status, 1);
  EXPECT_NE(damaged.out.find("speed-cost.csv:"), std::string::npos) << damaged.out;
}

TEST_F(CliSpeed, TwoMethodsBesideEachOther) {
  // four evaluations of the forces in each step, beside one
  const ProgramResult slower = regress({"--method", "rk4", "--against", "leapfrog", "--filter", "cloth-hang"});
  EXPECT_EQ(slower.status, 1);
  EXPECT_NE(slower.out.find("slower     cloth-hang, mysim/rk4: "), std::string::npos) << slower.out;
  const ProgramResult trade = regress({"--method", "leapfrog", "--against", "rk4", "--filter", "normal-modes"});
  EXPECT_NE(trade.out.find("faster     normal-modes, mysim/leapfrog: buys speed with accuracy: "), std::string::npos)
      << trade.out;
  const ProgramResult outside =
      regress({"--filter", "projectile", "--method", "exec:" CROSSCHECK_EXAMPLE, "--against", "symplectic-euler"});
  EXPECT_EQ(outside.status, 0) << outside.out;
  EXPECT_NE(outside.out.find("is no method inside this program"), std::string::npos) << outside.out;
}

TEST_F(CliSpeed, ABuildBesideItself) {
  // whether there is an alarm is for the long form to say, on a machine that does nothing else
  const ProgramResult proof = regress({"--prove-speed", "--filter", "spring", "--repetitions", "2"});
  EXPECT_NE(proof.out.find("2 repetitions of 1 speeds: "), std::string::npos) << proof.out << proof.err;
  EXPECT_EQ(regress({"--repetitions", "2"}).status, 2);
  EXPECT_EQ(regress({"--prove-speed", "--bless"}).status, 2);
}

}  // namespace
}  // namespace crosscheck::testing_tools
