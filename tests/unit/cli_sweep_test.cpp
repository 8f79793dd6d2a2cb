// Parts of an experiment on the command line, and their joining.
#include "tests/unit/cli.h"

#include <fmt/format.h>

#include <map>

namespace crosscheck::testing_tools {
namespace {

class CliSweep : public Cli {
 protected:
  /// Tables of a folder by name, without the provenance lines; costs aside.
  std::map<std::string, std::string> tables(const std::string& out) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_ / out))
      if (entry.path().extension() == ".csv" && !entry.path().stem().string().ends_with("-cost"))
        all[entry.path().filename()] = rows(entry.path());
    return all;
  }
};

TEST_F(CliSweep, MergedShardsAreTheWhole) {
  for (const char* part : {"1/2", "2/2"}) {
    const ProgramResult result = call({"experiment", "order", "engines", "spring", "circle", "--shard", part, "--out",
                                       std::string("part") + part[0]});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(tables(std::string("part") + part[0]).empty()) << "a part is no table";
  }
  ASSERT_EQ(call({"experiment", "order", "engines", "spring", "circle", "--out", "whole"}).status, 0);
  ASSERT_EQ(call({"merge", "part2", "part1", "--out", "merged"}).status, 0);
  EXPECT_EQ(tables("merged"), tables("whole"));
  EXPECT_GE(tables("whole").size(), 5u);

  const ProgramResult lacking = call({"merge", "part1", "--out", "lacking"});
  EXPECT_EQ(lacking.status, 1);
  EXPECT_NE(lacking.err.find("missing: order: circle"), std::string::npos) << lacking.err;
  EXPECT_FALSE(fs::exists(folder_ / "lacking"));
}

TEST_F(CliSweep, ResumeKeepsWhatIsFinishedAndOthersAreNotJoined) {
  ASSERT_EQ(call({"experiment", "order", "spring", "circle", "--out", "out"}).status, 0);
  const auto finished = [&] {
    std::map<std::string, fs::file_time_type> times;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/points"))
      times[entry.path().filename()] = entry.last_write_time();
    return times;
  };
  const auto before = finished();
  ASSERT_EQ(before.size(), 2u);
  fs::remove(folder_ / "out/points" / before.begin()->first);
  const ProgramResult again = call({"experiment", "order", "spring", "circle", "--resume", "--out", "out"});
  ASSERT_EQ(again.status, 0) << again.err;
  const auto after = finished();
  EXPECT_EQ(after.size(), 2u);
  EXPECT_EQ(after.rbegin()->second, before.rbegin()->second) << "kept";

  ASSERT_EQ(call({"experiment", "order", "spring", "--out", "other"}).status, 0);
  const ProgramResult mixed = call({"merge", "out", "other", "--out", "mixed"});
  EXPECT_EQ(mixed.status, 2);
  EXPECT_NE(mixed.err.find("expected the points of out: the same command, scenes and program"), std::string::npos)
      << mixed.err;
}

/// array.sbatch as Slurm starts it, with a program that says what it was called with.
class CliArray : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(folder_ / "build/release");
    fs::permissions(write("build/release/crosscheck", "#!/bin/sh\necho \"$@\"\n"), fs::perms::owner_all);
  }
  ProgramResult task(int id, int least, int most, int count, const std::string& parts = "") const {
    const auto variable = [](const char* name, const auto& value) { return fmt::format("{}={}", name, value); };
    return run_program({"bash", CROSSCHECK_SOURCE "/experiments/sweep/array.sbatch", "out", "order", "spring"}, folder_,
                       {variable("SLURM_ARRAY_TASK_ID", id), variable("SLURM_ARRAY_TASK_MIN", least),
                        variable("SLURM_ARRAY_TASK_MAX", most), variable("SLURM_ARRAY_TASK_COUNT", count),
                        variable("SLURM_CPUS_PER_TASK", 2), variable("CROSSCHECK_PARTS", parts)});
  }
};

TEST_F(CliArray, ATasksNumberIsItsPart) {
  const std::string third = "experiment order spring --shard 3/16 --resume --jobs 2 --out out/part-3\n";
  EXPECT_EQ(task(3, 1, 16, 16).out, third);      // --array=1-16
  EXPECT_EQ(task(3, 3, 7, 2, "16").out, third);  // --array=3,7, submitted again
  for (const int count : {1, 2}) {               // --array=3; --array=1,3
    const ProgramResult lost = task(3, count == 1 ? 3 : 1, 3, count);
    EXPECT_EQ(lost.status, 2);
    EXPECT_NE(lost.err.find("expected CROSSCHECK_PARTS=N"), std::string::npos) << lost.err;
  }
  EXPECT_EQ(task(15, 1, 15, 8).status, 2);  // --array=1-16:2
}

TEST_F(CliSweep, BadPartsAreRefused) {
  const ProgramResult shard = call({"experiment", "order", "spring", "--shard", "3/2", "--out", "out"});
  EXPECT_EQ(shard.status, 2);
  EXPECT_NE(shard.err.find("expected I/N"), std::string::npos) << shard.err;
  const ProgramResult none = call({"merge", "nowhere", "--out", "out"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("nowhere/plan.json: expected the plan of a sweep"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace crosscheck::testing_tools
