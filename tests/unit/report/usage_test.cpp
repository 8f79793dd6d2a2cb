// Tests mistakes on the command line and in the environment: messages, suggestions, and exit status.

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

TEST_F(CliUsage, ProposesTheCommandThatWasMeant) {
  const struct {
    std::vector<std::string> words;
    const char* meant;
  } slips[] = {
      {{"run", "leapfrog", "chain"}, "did you mean `crosscheck run chain --method leapfrog`?"},
      {{"run", "chain", "rk4", "--step", "1e-3"}, "did you mean `crosscheck run chain --method rk4 --step 1e-3`?"},
      {{"run", "leapfrog"}, "did you mean `crosscheck run SCENE --method leapfrog`?"},
      {{"compare", "bullet/pbd", "chain"}, "did you mean `crosscheck compare chain --methods bullet/pbd`?"},
      {{"translate", "chain", "bullet/pbd"}, "did you mean `crosscheck translate chain --to bullet/pbd`?"},
      {{"advise", "chain", "1e-3"}, "did you mean `crosscheck advise chain --tolerance 1e-3`?"},
      {{"compare", "chain", "--methods", "leapfrog,", "rk4"}, "did you mean `--methods leapfrog,rk4`?"},
      {{"report", "chain", "--methods", "leapfrog,", "rk4"}, "did you mean `--methods leapfrog,rk4`?"},
      {{"experiment", "chain", "order"}, "did you mean `crosscheck experiment order chain`?"},
      {{"help"}, "did you mean `crosscheck --help`?"},
      {{"version"}, "did you mean `crosscheck --version`?"},
      {{"run", "chain", "-o", "x"}, "did you mean '--out'?"},
      {{"render", "chain", "--out", "x.png"}, "did you mean '-o'?"},
      {{"regress", "chain", "--methods", "rk4"}, "did you mean '--method'?"},
      {{"run", "chain", "--stpe", "1e-3"}, "did you mean '--step'?"},
      {{"run", "chain", "--step", "0,001"}, "did you mean '0.001'?"},
      {{"run", "chain", "--step", "0,5ms"}, "did you mean '0.5ms'?"},
      {{"run", "chain", "--step", "1kg"}, "as in 0.001, 1ms or 1/1000, got '1kg'"},
      {{"run", "chain", "--tol", "1ms"}, "expected a finite number above zero, got '1ms'"},
      {{"run", "chain", "--step", "1/0"}, "expected a finite number above zero (s)"},
      {{"translate", "chain", "--to", "jolts"},
       "translate also knows jolt, rapier, box3d, mujoco, godot; did you mean 'jolt'?"},
      {{"advise", "chain", "--tolerance", "1kg"}, "such as 0.001 or 1mm"},
  };
  for (const auto& [words, meant] : slips) expect_one_line(call(words), 2, meant);
  EXPECT_EQ(files(), 0);
}

TEST_F(CliUsage, ProposesAnAssignmentInItsPlace) {
  const ProgramResult result = call({"grade", "alice.zip", "a1-steppers"});
  expect_one_line(result, 2, "did you mean `crosscheck grade a1-steppers alice.zip`?");
}

TEST_F(CliUsage, TakesTimesWithUnitsAndFractions) {
  write("own.toml", own_scene);
  for (const char* step : {"0.002", "2ms", "2 ms", "2000us", "1/500", "0.002s"}) {
    const ProgramResult result = call({"run", "own.toml", "--step", step, "--duration", "100ms"});
    ASSERT_EQ(result.status, 0) << step << ": " << result.err;
    const auto run = JsonField::parse(read(folder_ / "out/run/run.json"), "run.json");
    EXPECT_EQ(run["step"].number(), 0.002) << step;
    EXPECT_EQ(run["end"].number(), 0.1) << step;
  }
}

TEST_F(CliUsage, FailsIfStandardOutputCannotBeWritten) {
  write("own.toml", own_scene);
  for (const char* words : {"list scenes", "list methods --json", "validate own.toml", "run own.toml", "--version"})
    expect_one_line(shell(fmt::format("\"$PROGRAM\" {} >/dev/full", words)), 2, "standard output: ");
}

TEST_F(CliUsage, NamesAMissingFolderForTemporaryFiles) {
  make_engine("engine", "#!/bin/sh\nexec \"$EXAMPLE\" \"$@\"\n");
  expect_one_line(shell("\"$PROGRAM\" run chain --method exec:./engine", {"TMPDIR=/no/such/folder"}), 2,
                  "TMPDIR /no/such/folder: ");
}

TEST_F(CliUsage, NamesACarriageReturnInAnEnginesFirstLine) {
  write("own.toml", own_scene);
  for (const char* first : {"#!/bin/sh\r\n", "#!/usr/bin/env python3\r\n"}) {
    make_engine("engine", first);
    const ProgramResult result = call({"run", "own.toml", "--method", "exec:./engine"});
    EXPECT_NE(result.out.find("its first line ends with a carriage return"), std::string::npos) << result.out;
  }
}

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

TEST_F(CliUsage, AnInterruptedExperimentSaysHowToContinue) {
  const ProgramResult result =
      shell("timeout --preserve-status --signal=INT 0.4 \"$PROGRAM\" experiment stability --full --out o");
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.err.find("interrupted; `crosscheck experiment stability --full --out o --resume` continues it"),
            std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace crosscheck
