// Result folders and temporary folders: user files are never lost, a finished result stays until the next one is
// complete, there is only one writer, and leftovers of dead processes are removed.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <map>
#include <optional>
#include <random>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/output_folder.h"
#include "mysim/base/this_process.h"
#include "tests/unit/helpers.h"
#include "tests/unit/temporary.h"

namespace {

bool exchange_is_refused = false;

}  // namespace

/// Replaces the C library's function to emulate a file system that cannot exchange names, such as NFS.
extern "C" int renameat2(int from, const char* old_name, int to, const char* new_name, unsigned flags) noexcept {
  if (!exchange_is_refused) return static_cast<int>(syscall(SYS_renameat2, from, old_name, to, new_name, flags));
  errno = EINVAL;
  return -1;
}

namespace crosscheck {

namespace {

using namespace testing_tools;
namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

/// With parameter true, the file system cannot exchange names.
class Output : public InFolder, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    target_ = folder_ / "out";
    exchange_is_refused = GetParam();
  }
  void TearDown() override {
    exchange_is_refused = false;
    InFolder::TearDown();
  }
  void put(const Files& files, const std::string& command = "report") const {
    OutputFolder folder(target_, command);
    for (const auto& [path, text] : files) write_file(folder.path() / path, text);
    folder.finish();
  }
  /// Everything below a folder except the manifest.
  static Files in(const fs::path& folder) {
    Files files;
    for (const std::string& path : paths_in(folder)) files[path] = path.ends_with("/") ? "" : read(folder / path);
    return files;
  }
  std::string refusal(const std::string& command = "report") const {
    try {
      OutputFolder folder(target_, command);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_no_working_folder() const { EXPECT_FALSE(fs::exists(folder_ / ".out.crosscheck")); }
  fs::path target_;
};

INSTANTIATE_TEST_SUITE_P(ExchangedAndRenamed, Output, testing::Bool());

TEST_P(Output, AResultIsListedWithItsHashes) {
  put({{"index.html", "page"}, {"data/a.csv", "1"}});
  EXPECT_EQ(in(target_), (Files{{"index.html", "page"}, {"data/a.csv", "1"}}));
  const Manifest manifest = *read_manifest(target_);
  EXPECT_EQ(manifest.command, "report");
  EXPECT_TRUE(manifest.finished);
  EXPECT_EQ(manifest.process, getpid());
  EXPECT_EQ(manifest.files.at("data/a.csv").bytes, 1u);
  EXPECT_EQ(manifest.files.at("data/a.csv").hash, "af63ac4c86019afc");  // FNV-1a of "1"
  expect_no_working_folder();
}

TEST_P(Output, WhatIsTheUsersSurvives) {
  put({{"index.html", "one"}, {"data/a.csv", "1"}, {"data/gone.csv", "1"}, {"old/b", "1"}});
  const auto user = [&](const char* path, const char* text) {
    fs::create_directories((target_ / path).parent_path());
    std::ofstream(target_ / path) << text;
  };
  user("data/notes.txt", "mine");
  user("mine/deep/er.txt", "mine");
  user("data/a.csv", "1, and what I think of it");
  user("data/gone.csv", "changed");
  user("data/new.csv", "mine under a name of the next");
  user("figures", "mine, where a folder will be");
  fs::create_directories(target_ / "empty");
  fs::create_symlink("nowhere", target_ / "link");
  put({{"index.html", "two"}, {"data/a.csv", "2"}, {"data/new.csv", "2"}, {"figures/f.svg", "2"}});
  Files now = in(target_);
  EXPECT_TRUE(fs::is_symlink(target_ / "link"));
  now.erase("link");
  EXPECT_EQ(now, (Files{{"index.html", "two"},
                        {"data/a.csv", "2"},
                        {"data/a.csv.yours", "1, and what I think of it"},
                        {"data/gone.csv.yours", "changed"},
                        {"data/new.csv", "2"},
                        {"data/new.csv.yours", "mine under a name of the next"},
                        {"data/notes.txt", "mine"},
                        {"mine/deep/er.txt", "mine"},
                        {"figures/f.svg", "2"},
                        {"figures.yours", "mine, where a folder will be"},
                        {"empty/", ""}}));
  user("data/a.csv", "again");
  put({{"index.html", "three"}, {"data/a.csv", "3"}});
  EXPECT_EQ(read(target_ / "data/a.csv.yours"), "1, and what I think of it");
  EXPECT_EQ(read(target_ / "data/a.csv.yours-2"), "again");
  EXPECT_EQ(read(target_ / "mine/deep/er.txt"), "mine");
  EXPECT_FALSE(fs::exists(target_ / "figures")) << "contains no user files, so it must be removed";
  expect_no_working_folder();
}

TEST_P(Output, AForeignFolderIsRefusedAndNothingInItChanges) {
  for (const char* name : {"notes.txt", "report.json", "plan.json", "data.csv", "points/x.json", "crosscheck.txt"}) {
    write_file(target_ / name, "mine");
    const Files before = in(target_);
    const auto time = fs::last_write_time(target_);
    const std::string said = refusal();
    EXPECT_TRUE(contains(said, "--out " + target_.string() + ": holds files that crosscheck report did not write"));
    EXPECT_TRUE(contains(said, name));
    EXPECT_TRUE(contains(said, "nothing in it was changed; give an empty or a new folder, or move them away"));
    EXPECT_EQ(in(target_), before);
    EXPECT_EQ(fs::last_write_time(target_), time);
    expect_no_working_folder();
    for (const auto& entry : fs::directory_iterator(target_)) fs::remove_all(entry);
  }
}

TEST_P(Output, AnotherCommandsFolderAndADamagedManifestAreRefused) {
  put({{"run.json", "{}"}}, "run");
  EXPECT_TRUE(
      contains(refusal(), "holds a result of crosscheck run, and nothing in it was changed; give another folder"));
  EXPECT_EQ(refusal("run"), "");
  for (const char* text : {"", "{}", "[1]", "{\"format\": 2}"}) {
    std::ofstream(target_ / Manifest::file_name) << text;
    EXPECT_TRUE(contains(refusal("run"), "crosscheck.json: expected a list of results that this version"));
    EXPECT_EQ(read(target_ / "run.json"), "{}");
  }
}

TEST_P(Output, AManifestThatIsAPipeOrALinkIsRefusedAndNotRead) {
  fs::create_directories(target_);
  ASSERT_EQ(mkfifo((target_ / Manifest::file_name).c_str(), 0600), 0);
  EXPECT_TRUE(contains(refusal(), "crosscheck.json: expected a list of results that this version"));
  fs::remove(target_ / Manifest::file_name);
  fs::create_symlink("/dev/zero", target_ / Manifest::file_name);
  EXPECT_TRUE(contains(refusal(), "crosscheck.json: expected a list of results that this version"));
}

TEST_P(Output, AFileAndAPlaceThatCannotBeWrittenAreNoFolders) {
  write("file", "");
  for (const fs::path& path : {folder_ / "file", folder_ / "file/below", fs::path("/proc/out"), fs::path("")}) {
    target_ = path;
    EXPECT_TRUE(contains(refusal(), "--out " + path.string() + ": expected a folder that can be made and written to"));
  }
}

TEST_P(Output, TheSecondWriterIsToldWhoIsTheFirst) {
  put({{"index.html", "one"}});
  {
    OutputFolder first(target_, "report");
    const std::string said = refusal();
    EXPECT_TRUE(
        contains(said, fmt::format("process {} (crosscheck report) has been writing into it since 2", getpid())));
    EXPECT_TRUE(contains(said, "wait for it, or give another folder"));
    EXPECT_THROW(ResumableOutput(target_, "report"), InputError);
    EXPECT_EQ(read(target_ / "index.html"), "one");
  }
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(read(target_ / "index.html"), "one") << "an unfinished result must not change anything";
  expect_no_working_folder();
}

/// Whenever the process is killed, one of the two results is complete.
TEST_P(Output, KilledAtAnyMomentTheFirstIsWholeOrTheSecond) {
  Files one, two;
  for (int i = 0; i < 60; ++i) {
    one[fmt::format("data/{}.csv", i)] = "one";
    two[fmt::format("data/{}.csv", i + 20)] = "two";
  }
  const auto with_mine = [](Files files) {
    files["data/mine.txt"] = "mine";
    files["crosscheck.json.mine.part"] = "mine";  // resembles the name of a partial manifest
    return files;
  };
  put(one);
  std::ofstream(target_ / "data/mine.txt") << "mine";
  std::ofstream(target_ / "crosscheck.json.mine.part") << "mine";
  std::mt19937 random(22);
  int undisturbed = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const pid_t child = fork();
    while (child == 0) {  // endless, so that the kill interrupts a write on any machine
      put(two);
      put(one);
    }
    usleep(std::uniform_int_distribution<useconds_t>(0, 60000)(random));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << trial;
    const Files at_once = in(target_);
    const bool whole = at_once == with_mine(one) || at_once == with_mine(two);
    if (!GetParam()) {  // with two renames, the folder may be absent until recovery
      EXPECT_TRUE(whole) << trial;
    }
    undisturbed += whole;
    recover_output(target_);
    const Files now = in(target_);
    std::string others;
    for (const auto& [name, content] : now)
      if (!with_mine(one).contains(name) && !with_mine(two).contains(name))
        others += " " + name + "=" + content.substr(0, 40);
    EXPECT_TRUE(now == with_mine(one) || now == with_mine(two)) << trial << ": " << now.size() << " files," << others;
    expect_no_working_folder();
  }
  EXPECT_GT(undisturbed, 10);
  put(two);
  EXPECT_EQ(in(target_), with_mine(two));
}

TEST_P(Output, ManifestThatListsPathsOutsideIsRefusedAndNothingChanges) {
  write_file(folder_ / "mine", "mine");
  write_file(folder_ / "out/mine", "theirs");
  for (const char* path : {"../mine", "a/../../mine", "/etc/hostname", "a//b", "./a", "a/", "", "a\\u0000b", "a\\nb"}) {
    write_file(folder_ / "out/crosscheck.json",
               fmt::format(R"({{"format":1,"command":"report","state":"finished","process":{{"id":1,"since":""}},)"
                           R"("files":{{"{}":{{"bytes":6,"hash":null}}}}}})",
                           path));
    EXPECT_TRUE(contains(refusal(), "crosscheck.json: expected a list of results that this version")) << path;
    EXPECT_THROW(read_manifest(target_), InputError) << path;
  }
  EXPECT_EQ(read(folder_ / "mine"), "mine");
  EXPECT_EQ(read(target_ / "mine"), "theirs");
}

TEST_P(Output, ListedFilesBehindALinkAreNotTouched) {
  put({{"data/a.csv", "1"}, {"index.html", "one"}});
  write_file(folder_ / "elsewhere/a.csv", "1");
  fs::remove_all(target_ / "data");
  fs::create_symlink("../elsewhere", target_ / "data");
  put({{"data/a.csv", "2"}});
  EXPECT_EQ(read(target_ / "data/a.csv"), "2");
  EXPECT_EQ(fs::read_symlink(target_ / "data.yours"), "../elsewhere");
  write_file(folder_ / "out/index.html", "mine now");
  fs::remove_all(target_ / "data");
  fs::rename(target_ / "data.yours", target_ / "data");
  ResumableOutput growing(target_, "report");
  growing.announce({"data/a.csv"});
  growing.finish();
  EXPECT_TRUE(fs::is_symlink(target_ / "data.yours"));
  EXPECT_EQ(in(folder_ / "elsewhere"), (Files{{"a.csv", "1"}}));
}

TEST_P(Output, JournalOfAnEarlierVersionIsNotFollowed) {
  const std::string manifest = R"({"format":1,"command":"report","state":"finished","process":{"id":1,"since":""},)"
                               R"("files":{"index.html":{"bytes":6,"hash":null}}})";
  for (const char* work : {"out/.crosscheck", ".out.crosscheck"}) {
    put({{"index.html", "one"}});
    write_file(folder_ / (std::string(work) + "/journal/crosscheck.json"), manifest);
    write_file(folder_ / (std::string(work) + "/new/index.html"), "theirs");
    recover_output(target_);
    EXPECT_EQ(read(target_ / "index.html"), "one");
    put({{"index.html", "two"}});
    EXPECT_EQ(read(target_ / "index.html"), "two");
    fs::remove_all(target_), fs::remove_all(folder_ / ".out.crosscheck");
  }
}

TEST_P(Output, LinkToNothingIsRefusedAndStays) {
  fs::create_symlink("scratch/not-mounted", target_);
  EXPECT_TRUE(contains(refusal(), "out is a link to scratch/not-mounted, which does not exist"));
  EXPECT_THROW(ResumableOutput(target_, "report"), InputError);
  EXPECT_TRUE(fs::is_symlink(target_));
  fs::create_directories(folder_ / "scratch/not-mounted");
  put({{"index.html", "one"}});
  EXPECT_EQ(read(folder_ / "scratch/not-mounted/index.html"), "one");
  EXPECT_TRUE(fs::is_symlink(target_));
}

TEST_P(Output, WorkingFolderOfAnotherUserIsRefused) {
  put({{"index.html", "one"}});
  fs::create_symlink("elsewhere", folder_ / ".out.crosscheck");
  EXPECT_TRUE(contains(refusal(), ".out.crosscheck is not a folder of yours"));
  fs::remove(folder_ / ".out.crosscheck");
  write_file(folder_ / ".out.crosscheck/old/index.html", "theirs");
  if (chown((folder_ / ".out.crosscheck").c_str(), 12345, 12345) != 0)
    GTEST_SKIP() << "this machine does not let its user change the owner of a folder";
  EXPECT_TRUE(contains(refusal(), ".out.crosscheck is not a folder of yours"));
  recover_output(target_);
  EXPECT_EQ(in(target_), (Files{{"index.html", "one"}}));
  EXPECT_TRUE(fs::exists(folder_ / ".out.crosscheck/old/index.html"));
}

TEST_P(Output, LinksInTheWorkingFolderAreRefusedAndWhatTheyLeadToStays) {
  const fs::path work = folder_ / ".out.crosscheck", theirs = folder_ / "theirs";
  for (const char* manifest : {"", "{}"})
    for (const char* name : {"new", "old"}) {
      fs::create_directories(target_);
      write_file(theirs / "sub/precious.txt", "precious");
      if (*manifest) write_file(theirs / Manifest::file_name, manifest);
      fs::create_directories(work);
      fs::create_directory_symlink(theirs, work / name);
      EXPECT_TRUE(contains(refusal(), "is not a folder that crosscheck made"));
      EXPECT_THROW(recover_output(target_), InputError);
      EXPECT_EQ(read(theirs / "sub/precious.txt"), "precious");
      EXPECT_TRUE(fs::is_empty(target_));
      fs::remove(work / name);
    }
}

TEST_P(Output, NextWriterPutsTheEarlierResultBack) {
  put({{"index.html", "one"}});
  write_file(folder_ / "out/mine", "mine");
  fs::create_directory(folder_ / ".out.crosscheck");
  fs::rename(target_, folder_ / ".out.crosscheck/old");  // killed between the two renames
  EXPECT_EQ(refusal("run"), "--out " + target_.string() +
                                ": holds a result of crosscheck report, and nothing in it was changed; give another "
                                "folder");
  EXPECT_EQ(in(target_), (Files{{"index.html", "one"}, {"mine", "mine"}}));
  expect_no_working_folder();
}

TEST_P(Output, CanBeReplacedFromWithin) {
  put({{"index.html", "one"}});
  const fs::path before = fs::current_path();
  fs::current_path(target_);
  put({{"index.html", "two"}});
  EXPECT_EQ(read("index.html"), "two");
  fs::current_path(before);
}

TEST_P(Output, APartOfAResultIsKeptBesideAFinishedOne) {
  const auto grow = [&](const std::string& rows, bool whole) {
    ResumableOutput folder(target_, "check");
    for (size_t n = 1; n <= rows.size(); ++n) write_file(folder.growing("rows.csv"), rows.substr(0, n));
    if (!whole) return;
    folder.announce({"rows.csv"});
    write_file(target_ / "rows.csv", rows);
    folder.finish();
  };
  grow("ab", false);
  EXPECT_EQ(in(target_), (Files{{"rows.csv", "ab"}}));
  EXPECT_FALSE(read_manifest(target_)->finished);
  grow("abc", true);
  for (const char* rows : {"d", "e"}) grow(rows, false);
  EXPECT_EQ(in(target_), (Files{{"rows.csv", "abc"}, {"unfinished-rows.csv", "e"}}));
  grow("de", true);
  EXPECT_EQ(in(target_), (Files{{"rows.csv", "de"}}));
  EXPECT_TRUE(read_manifest(target_)->finished);
}

TEST_P(Output, AResultGrowsInPlaceAndGoesOn) {
  const auto grow = [&](bool resume, const std::vector<std::string>& points, const std::string& table, bool whole) {
    ResumableOutput folder(target_, "experiment");
    if (resume) folder.keep("points");
    std::vector<std::string> names{"plan.json"};
    for (const std::string& point : points) names.push_back("points/" + point);
    folder.announce(names);
    for (const std::string& name : names)
      if (!fs::exists(target_ / name)) write_file(target_ / name, name);
    if (!whole) return;
    folder.announce({table});
    write_file(target_ / table, table);
    folder.finish();
  };
  grow(false, {"a", "b"}, "", false);  // interrupted after the existing files were announced
  EXPECT_FALSE(read_manifest(target_)->finished);
  std::ofstream(target_ / "points/mine") << "mine";
  grow(true, {"a", "b", "c"}, "one.csv", true);
  EXPECT_TRUE(read_manifest(target_)->finished);
  EXPECT_EQ(read_manifest(target_)->files.size(), 5u);
  std::ofstream(target_ / "two.csv") << "mine";
  std::ofstream(target_ / "points/b") << "changed";
  grow(false, {"d"}, "two.csv", true);
  EXPECT_EQ(in(target_), (Files{{"plan.json", "plan.json"},
                                {"points/d", "points/d"},
                                {"points/mine", "mine"},
                                {"points/b.yours", "changed"},
                                {"two.csv", "two.csv"},
                                {"two.csv.yours", "mine"}}));
  expect_no_working_folder();
}

namespace fs = std::filesystem;

class TemporaryFolders : public testing_tools::InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    if (const char* now = std::getenv("TMPDIR")) before_ = now;
    setenv("TMPDIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    if (before_)
      setenv("TMPDIR", before_->c_str(), 1);
    else
      unsetenv("TMPDIR");
    InFolder::TearDown();
  }
  long count() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }
  void wait_for(long folders) const {
    while (count() != folders) usleep(1000);
  }
  /// Runs the work in a child process.
  template <class F>
  static pid_t in_child(F work) {
    const pid_t child = fork();
    if (child == 0) {
      // Signals may be ignored if the tests were started in the background, and child processes inherit this.
      for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_DFL);
      _exit(work());
    }
    return child;
  }
  static int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }
  std::optional<std::string> before_;
};

/// Creates a temporary folder and two child processes, each with a temporary folder of its own: a worker, and a process
/// that leaves the session.
int work_with_children() {
  const TemporaryFolder own("own");
  for (const bool leaves : {false, true})
    if (fork() == 0) {
      close_range(3, ~0U, 0);  // as exec does
      if (leaves)
        setsid();
      else
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // as workers do
      const TemporaryFolder folder("worker");
      std::ofstream(folder.path / "process") << getpid();
      for (;;) pause();
    }
  for (;;) pause();
}

TEST_F(TemporaryFolders, ThoseOfKilledProcessesAreSweptAndNoOthers) {
  const pid_t child = in_child([] {
    const TemporaryFolder folder("killed");
    for (;;) pause();
    return 0;
  });
  wait_for(1);
  const TemporaryFolder living("living");
  // owned by other programs or by the user
  const std::vector<std::string> foreign = {"crosscheck-mine-abcdef", "crosscheck-notes", "crosscheck-report.backup",
                                            "crosscheck-1.latest", "crosscheck-run-2.backup"};
  for (const std::string& name : foreign) fs::create_directory(folder_ / name);
  const long others = std::ssize(foreign) + 1;
  remove_stale_temporary_folders();
  EXPECT_EQ(count(), others + 1) << "its process is still alive";
  kill(child, SIGKILL);
  end_of(child);
  remove_stale_temporary_folders();
  EXPECT_EQ(count(), others);
  EXPECT_TRUE(fs::exists(living.path));
  for (const std::string& name : foreign) EXPECT_TRUE(fs::exists(folder_ / name)) << name;
}

TEST_F(TemporaryFolders, NothingIsLeftWhenASignalEndsTheProgram) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = in_child([] { return run_supervised(work_with_children); });
    wait_for(3);
    kill(child, number);
    const int status = end_of(child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << status;
    EXPECT_EQ(count(), 0) << strsignal(number);
  }
}

TEST_F(TemporaryFolders, WhatAKilledProgramLeavesTheNextStartRemoves) {
  const pid_t child = in_child([] { return run_supervised(work_with_children); });
  wait_for(3);
  kill(child, SIGKILL);
  end_of(child);
  // The processes die with their parent. Nothing here can wait for them, so the next start is repeated.
  const auto next = [] { return run_supervised([] { return 7; }); };
  int status = 0;
  for (int attempt = 0; attempt < 200; ++attempt) {
    status = end_of(in_child(next));
    if (count() <= 1) break;
    usleep(20000);
  }
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_LE(count(), 1) << "only a process that left its session and has no parent may remain";
  for (const auto& entry : fs::directory_iterator(folder_))
    if (fs::exists(entry.path() / "process")) kill(std::stoi(read(entry.path() / "process")), SIGKILL);
}

TEST_F(TemporaryFolders, TheWorkersEndIsTheProgramsEnd) {
  EXPECT_EQ(WEXITSTATUS(end_of(in_child([] { return run_supervised([] { return 3; }); }))), 3);
  const int status = end_of(in_child([] {
    return run_supervised([] {
      const TemporaryFolder folder("crashed");
      std::abort();
      return 0;
    });
  }));
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
  EXPECT_EQ(count(), 0);
}

}  // namespace
}  // namespace crosscheck
