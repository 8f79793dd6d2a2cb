// Slips on the command line and in its surroundings: one line that says what was meant, and an exit status that tells.

#include <fmt/format.h>

#include <algorithm>

#include "mysim/base/json.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class CliUsage : public Cli {
 protected:
  ProgramResult shell(const std::string& line, const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> all = environment;
    all.insert(all.end(), {"PROGRAM=" CROSSCHECK_PROGRAM, "EXAMPLE=" CROSSCHECK_EXAMPLE, "ASAN_OPTIONS=detect_leaks=0",
                           "CROSSCHECK_LOCK=" + (folder_.string() + ".lock")});
    return run_program({"/bin/sh", "-c", line}, folder_, all);
  }
  void make_engine(const std::string& name, const std::string& text) const {
    fs::permissions(write(name, text), fs::perms::owner_all);
  }
  static void expect_one_line(const ProgramResult& result, int status, const std::string& part) {
    SCOPED_TRACE(result.err);
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
    EXPECT_LE(result.err.size(), 201u);
    EXPECT_NE(result.err.find(part), std::string::npos) << part;
  }
};

TEST_F(CliUsage, DoesNotCountWhatAnEngineDoesNotReport) {
  write("own.toml", own_scene);
  make_engine("engine", "#!/bin/sh\n\"$EXAMPLE\" \"$@\" && rm -f \"$2/run.json\"\n");
  const ProgramResult result = shell("\"$PROGRAM\" run own.toml --method exec:./engine");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.find(" 0 "), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("number not reported"), std::string::npos) << result.out;
}

TEST_F(CliUsage, NothingMeasuredIsANegativeAnswer) {
  expect_one_line(call({"experiment", "order", "chain", "--methods", "dopri5"}), 1, "nothing was measured");
  fs::create_directory(folder_ / "class");
  const ProgramResult graded = call({"grade", "a1-steppers", "class", "--all", "--no-sandbox"});
  EXPECT_EQ(graded.status, 1) << graded.out;
  EXPECT_NE(graded.err.find("no submissions found"), std::string::npos) << graded.err;
}

TEST_F(CliUsage, RefusesScenesOfOneNameForALab) {
  for (const char* name : {"a", "b"})
    fs::create_directory(folder_ / name), write(std::string(name) + "/s.toml", own_scene);
  expect_one_line(call({"lab", "a/s.toml", "b/s.toml", "-o", "x.html"}), 2, "expected scenes of different names");
}

}  // namespace
}  // namespace crosscheck
