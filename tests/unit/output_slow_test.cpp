// Reports that are killed, on a full disk, in folders of others, two at once: what was there before stays.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "mysim/manifest.h"
#include "tests/unit/cli.h"

namespace crosscheck::testing_tools {
namespace {

class OutputOfReport : public Cli {
 protected:
  /// The smallest report that there is.
  std::vector<std::string> report(const std::string& out) const {
    return {CROSSCHECK_PROGRAM, "report", "circle", "--quick", "--methods", "rk4,leapfrog", "--out", out};
  }
  ProgramResult start(std::vector<std::string> before, const std::vector<std::string>& words) const {
    before.insert(before.end(), words.begin(), words.end());
    return run_program(before, folder_, {"CROSSCHECK_LOCK=" + (folder_ / "lock").string()});
  }
  /// All that one report wrote is there as it was written, and beside it the user's file.
  testing::AssertionResult whole(const fs::path& out) const {
    const auto manifest = read_manifest(out);
    if (!manifest || !manifest->finished) return testing::AssertionFailure() << "no finished result";
    for (const auto& [path, about] : manifest->files)
      if (!manifest->ours(out, path)) return testing::AssertionFailure() << path;
    for (const std::string& path : paths_in(out))
      if (!manifest->names(path) && path != "data/mine.txt") return testing::AssertionFailure() << "also " << path;
    if (read(out / "data/mine.txt") != "mine") return testing::AssertionFailure() << "the user's file is gone";
    return testing::AssertionSuccess() << manifest->files.size() << " files";
  }
};

TEST_F(OutputOfReport, KilledAtTwentyMomentsTheFirstIsWholeOrTheSecond) {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult first = start({}, report("out"));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_EQ(first.status, 0) << first.err;
  write("out/data/mine.txt", "mine");
  ASSERT_TRUE(whole(folder_ / "out"));
  std::mt19937 random(22);
  int killed = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const double moment = std::uniform_real_distribution<>(0, 1.05 * seconds)(random);
    killed += start({"timeout", "-s", "KILL", fmt::format("{:.3f}", moment)}, report("out")).status == 128 + 9;
    EXPECT_TRUE(whole(folder_ / "out")) << "killed after " << moment << " s";
  }
  EXPECT_GT(killed, 5);
  EXPECT_EQ(start({}, report("out")).status, 0);
  EXPECT_TRUE(whole(folder_ / "out"));
  EXPECT_FALSE(fs::exists(folder_ / ".out.crosscheck"));
  EXPECT_EQ(call({"report", "--verify", "out"}).status, 0);
}

TEST_F(OutputOfReport, AFullDiskLeavesTheFirst) {
  if (run_program({"unshare", "-rm", "true"}, folder_).status != 0)
    GTEST_SKIP() << "this system makes no mount namespaces (unshare -rm), and so no small disk";
  // the disk itself is the folder too: then nothing can be exchanged
  for (const char* out : {"disk", "disk/out"}) {
    fs::create_directories(folder_ / "disk");
    write("try.sh", R"sh(set -e
mount -t tmpfs -o size=40m tmpfs disk
sum() { (cd "$OUT" && find . -type f -not -name room -not -path './.crosscheck/*' | sort | xargs sha256sum | sha256sum); }
"$@" > /dev/null
echo mine > "$OUT/data/mine.txt"
sum
dd if=/dev/zero of=disk/room bs=4k > /dev/null 2>&1 || true
truncate -s -500k disk/room
if "$@" > said 2>&1; then echo it was written; fi
sum
rm disk/room
"$@" > /dev/null
cat "$OUT/data/mine.txt"
)sh");
    std::vector<std::string> words = report(out);
    const ProgramResult result = start({"unshare", "-rm", "env", std::string("OUT=") + out, "sh", "try.sh"}, words);
    ASSERT_EQ(result.status, 0) << result.err << result.out;
    const size_t line = result.out.find('\n') + 1;
    EXPECT_EQ(result.out, result.out.substr(0, line) + result.out.substr(0, line) + "mine\n");
    EXPECT_NE(read(folder_ / "said").find("cannot be written"), std::string::npos) << read(folder_ / "said");
  }
}

TEST_F(OutputOfReport, FoldersOfOthersAndTwoWritersAreRefused) {
  for (const char* out : {"foreign", "foreign/data"}) {
    fs::create_directories(folder_ / "foreign/data");
    write("foreign/data/report.json", "mine");
    const int before = files();
    const ProgramResult refused = start({}, report(out));
    EXPECT_EQ(refused.status, 2) << refused.out;
    EXPECT_NE(refused.err.find("holds files that are not of crosscheck report"), std::string::npos) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_EQ(files(), before);
    EXPECT_EQ(read(folder_ / "foreign/data/report.json"), "mine");
  }
  // the second asks when the first is at it
  const ProgramResult two = start({"sh", "-c",
                                   "\"$@\" & first=$!; until test -s .out.crosscheck/lock; do sleep 0.01; done; "
                                   "\"$@\"; echo status $?; wait $first",
                                   "sh"},
                                  report("out"));
  EXPECT_EQ(two.status, 0) << two.err;
  EXPECT_NE(two.out.find("status 2"), std::string::npos) << two.out;
  EXPECT_NE(two.err.find("(crosscheck report) has been writing into it since 2"), std::string::npos) << two.err;
}

TEST_F(OutputOfReport, ASignalLeavesNothingBehind) {
  for (const char* number : {"INT", "TERM"}) {
    fs::create_directories(folder_ / "tmp");
    const ProgramResult ended =
        start({"env", "TMPDIR=" + (folder_ / "tmp").string(), "timeout", "-s", number, "2"},
              {CROSSCHECK_PROGRAM, "run", "chain", "--duration", "1e4", "--step", "1e-6", "--out", "out"});
    EXPECT_EQ(ended.status, 124) << ended.err;
    EXPECT_EQ(files(), 1) << "the folder for temporary files, and nothing else";
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
