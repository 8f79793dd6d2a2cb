// Temporary folders of processes that are gone go; those of living ones stay.
#include "mysim/temporary_folder.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>

#include "mysim/supervised.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

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
  /// Does the work in a process of its own.
  template <class F>
  static pid_t in_child(F work) {
    const pid_t child = fork();
    if (child == 0) {
      // who started the tests in the background may have had them ignored, and a program leaves that as it is
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

/// A folder, and processes below that have one too: a worker, and one that has left its session.
int work_with_children() {
  const TemporaryFolder own("own");
  for (const bool leaves : {false, true})
    if (fork() == 0) {
      if (leaves)
        setsid();
      else
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // as workers do
      const TemporaryFolder folder("worker");
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
  fs::create_directory(folder_ / "crosscheck-mine-1.2.3-abcdef");  // of another system, as far as anybody can tell
  fs::create_directory(folder_ / "crosscheck-notes");
  sweep_temporary_folders();
  EXPECT_EQ(count(), 4) << "it lives";
  kill(child, SIGKILL);
  end_of(child);
  sweep_temporary_folders();
  EXPECT_EQ(count(), 3);
  EXPECT_TRUE(fs::exists(living.path));
}

TEST_F(TemporaryFolders, NothingIsLeftWhenASignalEndsTheProgram) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = in_child([] { return supervised(work_with_children); });
    wait_for(3);
    kill(child, number);
    const int status = end_of(child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << status;
    EXPECT_EQ(count(), 0) << strsignal(number);
  }
}

TEST_F(TemporaryFolders, WhatAKilledProgramLeavesTheNextStartRemoves) {
  const pid_t child = in_child([] { return supervised(work_with_children); });
  wait_for(3);
  kill(child, SIGKILL);
  end_of(child);
  // its processes die with it, but nobody here can wait for them
  const auto next = [] { return supervised([] { return 7; }); };
  int status = 0;
  for (int patience = 0; patience < 200; ++patience) {
    status = end_of(in_child(next));
    if (count() <= 1) break;
    usleep(20000);
  }
  EXPECT_EQ(WEXITSTATUS(status), 7);
  // one process had left its session and its parents: it was not ours to find
  EXPECT_LE(count(), 1);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename();
    kill(std::stoi(name.substr(name.find('-', 11) + 1)), SIGKILL);
  }
}

TEST_F(TemporaryFolders, TheWorkersEndIsTheProgramsEnd) {
  EXPECT_EQ(WEXITSTATUS(end_of(in_child([] { return supervised([] { return 3; }); }))), 3);
  const int status = end_of(in_child([] {
    return supervised([] {
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
