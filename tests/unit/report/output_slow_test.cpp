// Tests reports that are killed, that meet a full disk, that run two at a time, or that run under other locales:
// earlier results remain, and bytes are identical.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <regex>

#include "mysim/base/manifest.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

class OutputOfReport : public Cli {
 protected:
  /// Command line of the smallest possible report.
  std::vector<std::string> report(const std::string& out) const {
    return {CROSSCHECK_PROGRAM, "report", "circle", "--quick", "--methods", "rk4,leapfrog", "--out", out};
  }
  ProgramResult start(std::vector<std::string> before, const std::vector<std::string>& words) const {
    before.insert(before.end(), words.begin(), words.end());
    return run_program(before, folder_, {"CROSSCHECK_LOCK=" + (folder_ / "lock").string()});
  }
  /// Succeeds if all files of one report are intact, and the user's file is still there.
  testing::AssertionResult whole(const fs::path& out) const {
    const auto manifest = read_manifest(out);
    if (!manifest || !manifest->finished) return testing::AssertionFailure() << "no finished result";
    for (const auto& [path, about] : manifest->files)
      if (!manifest->ours(out, path)) return testing::AssertionFailure() << path;
    for (const std::string& path : paths_in(out))
      if (!manifest->names(path) && path != "data/mine.txt")
        return testing::AssertionFailure() << "unexpected file " << path;
    if (read(out / "data/mine.txt") != "mine") return testing::AssertionFailure() << "the user's file is gone";
    return testing::AssertionSuccess() << manifest->files.size() << " files";
  }
};

TEST_F(OutputOfReport, KilledAtTenMomentsTheFirstIsWholeOrTheSecond) {
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult first = start({}, report("out"));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_EQ(first.status, 0) << first.err;
  write("out/data/mine.txt", "mine");
  ASSERT_TRUE(whole(folder_ / "out"));
  std::mt19937 random(22);
  int killed = 0;
  // one kill in each tenth of the run, so that gaps between kills are at most a fifth of the run
  for (int trial = 0; trial < 10; ++trial) {
    const double moment = std::uniform_real_distribution<>(trial, trial + 1)(random) / 10 * 1.05 * seconds;
    killed += start({"timeout", "-s", "KILL", fmt::format("{:.3f}", moment)}, report("out")).status == 128 + 9;
    EXPECT_TRUE(whole(folder_ / "out")) << "killed after " << moment << " s";
  }
  EXPECT_GT(killed, 2);
  EXPECT_EQ(start({}, report("out")).status, 0);
  EXPECT_TRUE(whole(folder_ / "out"));
  EXPECT_FALSE(fs::exists(folder_ / ".out.crosscheck"));
  EXPECT_EQ(call({"report", "--verify", "out"}).status, 0);
}

TEST_F(OutputOfReport, AFullDiskLeavesTheFirst) {
  if (run_program({"unshare", "-rm", "true"}, folder_).status != 0)
    GTEST_SKIP() << "this machine does not support mount namespaces (unshare -rm), needed for a small disk";
  fs::create_directories(folder_ / "disk");
  write("try.sh", R"sh(set -e
mount -t tmpfs -o size=40m tmpfs disk
sum() { (cd disk/out && find . -type f | sort | xargs sha256sum | sha256sum); }
"$@" > /dev/null
echo mine > disk/out/data/mine.txt
sum
dd if=/dev/zero of=disk/room bs=4k > /dev/null 2>&1 || true
truncate -s -500k disk/room
if "$@" > said 2>&1; then echo it was written; fi
sum
rm disk/room
"$@" > /dev/null
cat disk/out/data/mine.txt
)sh");
  const ProgramResult result = start({"unshare", "-rm", "sh", "try.sh"}, report("disk/out"));
  ASSERT_EQ(result.status, 0) << result.err << result.out;
  const size_t line = result.out.find('\n') + 1;
  EXPECT_EQ(result.out, result.out.substr(0, line) + result.out.substr(0, line) + "mine\n");
  EXPECT_NE(read(folder_ / "said").find("cannot be written"), std::string::npos) << read(folder_ / "said");
}

TEST_F(OutputOfReport, MountPointIsRefusedBeforeTheWork) {
  if (run_program({"unshare", "-rm", "true"}, folder_).status != 0)
    GTEST_SKIP() << "this machine does not support mount namespaces (unshare -rm)";
  fs::create_directories(folder_ / "disk");
  const ProgramResult refused = start(
      {"unshare", "-rm", "sh", "-c", "mount -t tmpfs -o size=40m tmpfs disk && exec \"$@\"", "sh"}, report("disk"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--out disk: a mount point cannot be replaced"), std::string::npos) << refused.err;
}

TEST_F(OutputOfReport, FoldersOfOthersAndTwoWritersAreRefused) {
  for (const char* out : {"foreign", "foreign/data"}) {
    fs::create_directories(folder_ / "foreign/data");
    write("foreign/data/report.json", "mine");
    const int before = files();
    const ProgramResult refused = start({}, report(out));
    EXPECT_EQ(refused.status, 2) << refused.out;
    EXPECT_NE(refused.err.find("holds files that crosscheck report did not write"), std::string::npos) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_EQ(files(), before);
    EXPECT_EQ(read(folder_ / "foreign/data/report.json"), "mine");
  }
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
    EXPECT_EQ(files(), 1) << "expected the folder for temporary files only";
  }
}

std::string without_clock(const std::string& text) {
  static const std::regex clock("[0-9]{4}-[0-9]{2}-[0-9]{2}( [0-9]{2}:[0-9]{2}:[0-9]{2} UTC)?");
  return std::regex_replace(text, clock, "TIME");
}

class LocaleCli : public Cli {
 protected:
  /// Runs the program in an environment that consists only of `entries`, PATH, HOME and the cache of truths.
  ProgramResult bare(const std::vector<std::string>& entries, const std::vector<std::string>& words) const {
    std::vector<std::string> call{"env", "-i", "HOME=" + folder_.string(), "ASAN_OPTIONS=detect_leaks=0"};
    for (const char* kept : {"PATH", "CROSSCHECK_CACHE"})
      if (const char* value = std::getenv(kept)) call.push_back(std::string(kept) + "=" + value);
    call.insert(call.end(), entries.begin(), entries.end());
    call.emplace_back(CROSSCHECK_PROGRAM);
    call.insert(call.end(), words.begin(), words.end());
    return run_program(call, folder_);
  }

  /// Figures and tables by name, with dates and times replaced in text files.
  std::map<std::string, std::string> made_in(const std::vector<std::string>& entries) const {
    fs::remove_all(folder_ / "out");
    write("mine.toml", own_scene);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"figures", "order", "mine-picture", "--scene", "mine.toml", "--out", "out"},
          {"run", "mine.toml", "--method", "rk4", "--out", "out/run"},
          {"render", "mine.toml", "--methods", "rk4", "--size", "320x180", "-o", "out/still.png"}}) {
      const ProgramResult made = bare(entries, words);
      EXPECT_EQ(made.status, 0) << words[0] << ": " << made.err;
      EXPECT_EQ(made.err.find("gnuplot warns"), std::string::npos) << made.err;
    }
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out"))
      // omit crosscheck.json, which contains the time of writing, and hashes of files with dates
      if (entry.is_regular_file() && entry.path().filename() != "crosscheck.json") {
        const std::string ending = entry.path().extension();
        const bool text = ending == ".csv" || ending == ".json" || ending == ".cff";
        files[fs::relative(entry.path(), folder_ / "out")] = text ? without_clock(read(entry)) : read(entry);
      }
    return files;
  }

  void expect_same(const std::map<std::string, std::string>& files,
                   const std::map<std::string, std::string>& expected) {
    EXPECT_EQ(files.size(), expected.size());
    for (const auto& [name, content] : expected) {
      ASSERT_TRUE(files.contains(name)) << name;
      EXPECT_TRUE(files.at(name) == content) << name << " differs";
    }
  }
};

/// Removes run.json, which contains CPU times.
std::map<std::string, std::string> without_costs(std::map<std::string, std::string> files) {
  files.erase("run/run.json");
  return files;
}

TEST_F(LocaleCli, ChangesNoByte) {
  const auto plain = without_costs(made_in({}));
  for (const char* file : {"mine-order.svg", "mine-order.pdf", "mine-order.png", "mine-order.csv", "mine-picture.pdf",
                           "mine-picture.png", "figures.json", "run/energy.csv", "still.png"})
    EXPECT_TRUE(plain.contains(file)) << file;
  // POSIX time zones need no database; the offsets include half an hour (St. John's) and three quarters of an hour
  // (Kathmandu)
  for (const std::vector<std::string>& entries :
       {std::vector<std::string>{"LC_ALL=C", "TZ=NPT-5:45"},
        {"LC_ALL=POSIX", "TZ=NST3:30NDT"},
        {"LC_ALL=C.UTF-8", "TZ=LINT-14"},
        {"LANG=tr_TR.UTF-8", "LC_NUMERIC=de_DE.UTF-8", "LANGUAGE=de", "TZ=:nowhere"}}) {
    SCOPED_TRACE(entries[0] + " " + entries.back());
    expect_same(without_costs(made_in(entries)), plain);
  }
}

TEST_F(LocaleCli, WithDecimalCommasChangesNoByte) {
  if (!fs::exists("/usr/share/i18n/locales/de_DE"))
    GTEST_SKIP() << "package locales is not installed: decimal commas are not tested";
  fs::create_directories(folder_ / "locales");
  const ProgramResult compiled =
      run_program({"localedef", "-i", "de_DE", "-f", "UTF-8", (folder_ / "locales/de_DE.UTF-8").string()}, folder_);
  ASSERT_TRUE(fs::exists(folder_ / "locales/de_DE.UTF-8")) << compiled.err;
  const std::vector<std::string> german{"LOCPATH=" + (folder_ / "locales").string(), "LC_ALL=de_DE.UTF-8"};
  // bash uses the locale to format numbers
  std::vector<std::string> comma{"env"};
  comma.insert(comma.end(), german.begin(), german.end());
  comma.insert(comma.end(), {"bash", "-c", "printf %.1f 0,5"});
  ASSERT_EQ(run_program(comma, folder_).out, "0,5");
  expect_same(without_costs(made_in(german)), without_costs(made_in({})));
}

TEST_F(LocaleCli, TimesInTablesAreUtc) {
  write("mine.toml", own_scene);
  for (const char* zone : {"TZ=LINT-14", "TZ=AoE12"}) {
    const std::time_t before = std::time(nullptr);
    const ProgramResult made = bare({zone}, {"run", "mine.toml", "--method", "rk4", "--out", "out"});
    ASSERT_EQ(made.status, 0) << made.err;
    const std::string table = read(folder_ / "out/energy.csv");
    const size_t at = table.find("# date: ");
    ASSERT_NE(at, std::string::npos) << table.substr(0, 500);
    std::tm time{};
    ASSERT_NE(strptime(table.c_str() + at + 8, "%Y-%m-%d %H:%M:%S UTC", &time), nullptr);
    EXPECT_NEAR(std::difftime(timegm(&time), before), 0, 3600) << zone << ": local time would be off by 14 or 12 hours";
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
