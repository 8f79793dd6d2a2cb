// Tests each sandbox: limits hold and are not too strict, no files or processes remain, and secrets and the network are
// not accessible.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <atomic>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/coursework/test/sandboxes.h"

namespace coursework {
namespace fs = std::filesystem;

std::ostream& operator<<(std::ostream& out, End::How how) {
  constexpr const char* names[] = {"exited", "signal", "cpu", "wall", "idle", "memory", "output", "answers"};
  return out << names[static_cast<int>(how)];
}

namespace {

using How = End::How;

std::string show(const End& end) {
  return "code " + std::to_string(end.code) + ", output: " + end.captured_output.substr(0, 500);
}

bool done(const End& end) { return end.how == How::exited && end.code == 0 && end.answers.ends_with("done\n"); }

/// A limit, an amount below it with which a program finishes, and an amount above it with which the program is stopped
/// and reported.
struct Sides {
  std::string what, below, above;
  How how;
  Limits limits;
};

const std::vector<Sides> sides = {
    {"cpu", "0.5", "9", How::cpu, {.cpu = 1, .wall = 20}},
    {"swallow", "0.5", "9", How::cpu, {.cpu = 1, .wall = 20}},
    {"sleep", "0.1", "9", How::wall, {.wall = 1}},
    {"sleep", "0.1", "9", How::idle, {.wall = 60, .idle = 3}},
    {"memory", "100", "300", How::memory, {.memory = 256}},
    {"memory", "100", "100000", How::memory, {}},
    {"throw", "100", "100000", How::memory, {}},
    {"answers", "90", "200", How::answers, {.answers = 100}},
    {"output", "100", "101", How::output, {.output = 100}},
    {"output", "1", "100000", How::output, {.output = 100}},
    {"file", "1000", "1100", How::output, {.file = 1}},
};

TEST_P(SandboxTest, BelowALimitItEndsAndAboveItIsStoppedAndNamed) {
  for (const Sides& each : sides) {
    Job below = job(each.what, each.below), above = job(each.what, each.above);
    below.limits = above.limits = each.limits;
    if (each.what == "file") below.writable = above.writable = open_folder("own");
    const End held = sandbox().run(below), stopped = sandbox().run(above);
    EXPECT_TRUE(done(held)) << each.what << ' ' << each.below << ": " << held.how << ' ' << show(held);
    EXPECT_EQ(stopped.how, each.how) << each.what << ' ' << each.above << ": " << show(stopped);
    EXPECT_FALSE(done(stopped));
    EXPECT_LE(stopped.answers.size(), static_cast<std::size_t>(each.limits.answers) << 10);
  }
}

TEST_P(SandboxTest, SleepingIsOverAtOnceAndWhoNeedsAProcessorIsNotIdle) {
  Job napping = job("nap", "50");
  napping.limits.wall = 40;
  EXPECT_TRUE(done(sandbox().run(napping)));
  // four busy threads per processor let the observed program wait for most of the time
  std::vector<std::thread> busy;
  std::atomic<bool> stop = false;
  for (unsigned i = 0; i < 4 * std::thread::hardware_concurrency(); ++i)
    busy.emplace_back([&] {
      while (!stop) {
      }
    });
  Job burning = job("cpu", "1.5");
  burning.limits = {.cpu = 3, .wall = 120, .idle = 2};
  const End end = sandbox().run(burning);
  stop = true;
  for (std::thread& each : busy) each.join();
  EXPECT_TRUE(done(end)) << end.how << ' ' << show(end);
  EXPECT_GE(end.cpu, 1.5);
}

TEST_P(SandboxTest, ItStartsNoMoreProcessesThanItMay) {
  for (const long may : {0, 5}) {
    if (may > 0 && (GetParam() == "bare" || geteuid() != 0))
      continue;  // this sandbox limits processes only by the filter and the clock, as it states
    for (const long tries : {may, may + 1}) {
      Job starting = job("processes", std::to_string(tries));
      starting.limits.processes = may;
      const End end = sandbox().run(starting);
      EXPECT_EQ(done(end), tries == may) << tries << " of " << may << ": " << end.how << ' ' << show(end);
    }
  }
}

TEST_P(SandboxTest, ThreadsRunWhereNoProcessMayUpToTheirLimit) {
  EXPECT_TRUE(done(sandbox().run(job("threads", "40"))));
  Job waiting = job("worker", "4");  // the first thread waits for a busy one, so the program as a whole is not idle
  waiting.limits = {.cpu = 9, .wall = 60, .idle = 2};
  EXPECT_TRUE(done(sandbox().run(waiting)));
  if (GetParam() == "bare") return;  // this sandbox does not limit threads
  for (const long limit : {8, 9}) {
    Job counting = job("threads", "8");
    counting.limits.threads = limit;
    EXPECT_EQ(done(sandbox().run(counting)), limit == 9) << limit;
  }
}

TEST_P(SandboxTest, SignalsAreToldFromExitCodes) {
  for (const int number : {SIGSEGV, SIGABRT, SIGKILL, SIGFPE}) {
    const End end = sandbox().run(job("signal", std::to_string(number)));
    EXPECT_EQ(end.how, How::signal) << number;
    EXPECT_EQ(end.code, number);
  }
  const End end = sandbox().run(job("exit", "11"));
  EXPECT_EQ(end.how, How::exited);
  EXPECT_EQ(end.code, 11);
}

TEST_P(SandboxTest, NothingItStartedIsLeftRunning) {
  for (const char* what : {"leave", "killall", "sleep"}) {
    Job leaving = job(what, "9");
    leaving.limits.processes = 4;
    leaving.limits.wall = 1;
    if (GetParam() == "bare" && std::string(what) == "killall") continue;  // it would kill the test
    sandbox().run(leaving);
    EXPECT_EQ(leftover_processes(), std::set<std::string>{}) << what;
  }
}

TEST(LeftRunning, WhatOutlivesItsParentIsSeen) {
  adopt_orphans();
  ASSERT_EQ(std::system("sleep 60 & true"), 0);
  EXPECT_EQ(leftover_processes().size(), 1u);
  EXPECT_EQ(leftover_processes(), std::set<std::string>{});
}

TEST_P(SandboxTest, NothingItWroteIsLeft) {
  if (GetParam() == "bare") return;
  // the name is unique to this sandbox and process: another sandbox's test may be writing at the same time
  const std::string name = "litter-of-sandbox-test-" + std::string(GetParam()) + "-" + std::to_string(getpid());
  const auto own = open_folder("own");
  Job littering = job("litter", name);
  littering.writable = own;
  const End end = sandbox().run(littering);
  EXPECT_NE(end.answers.find("./" + name), std::string::npos) << show(end);
  for (const char* place : {"/tmp/", "/var/tmp/", "/dev/shm/", "/run/lock/"})
    EXPECT_FALSE(fs::exists(place + name)) << place;
  ASSERT_TRUE(fs::is_regular_file(own / name));
  EXPECT_FALSE(fs::exists(fs::symlink_status(own / "pipe")));
  EXPECT_FALSE(fs::exists(fs::symlink_status(own / "link")));
  struct stat about {};
  stat((own / name).c_str(), &about);
  EXPECT_EQ(about.st_uid, geteuid());
  EXPECT_EQ(about.st_mode & 0777u, 0644u);
}

TEST_P(SandboxTest, WithoutAFolderOfItsOwnItsFilesAreBoundedTogether) {
  if (GetParam() == "bare") return;
  Job filling = job("files", "100");
  filling.limits.file = 1;
  const End end = sandbox().run(filling);
  EXPECT_EQ(end.answers, GetParam() == "uid" ? "0\n" : "4\n") << show(end);
}

TEST_P(SandboxTest, OtherProcessesHaveNoMemoryForIt) {
  if (GetParam() == "bare") return;
  // 1 is a process of bwrap if there is a namespace, and the parent process belongs to the grader
  const End end = sandbox().run(shell("for p in 1 $PPID; do [ -w /proc/$p/mem ] && echo $p >&3; done"));
  EXPECT_EQ(end.answers, "");
}

TEST_P(SandboxTest, WhatReachesOutIsRefused) {
  if (GetParam() == "bare") return;
  const End end = sandbox().run(job("reach", "0"));
  EXPECT_TRUE(done(end)) << show(end);
  std::istringstream lines(end.answers);
  int count = 0;
  for (std::string line; std::getline(lines, line) && line != "done"; ++count) {
    const bool absent = line.starts_with("clone3");
    const bool unmapped = line == "setuid: Invalid argument";  // the namespace has no root user
    EXPECT_TRUE(unmapped || line.ends_with(absent ? "Function not implemented" : "Operation not permitted")) << line;
  }
  EXPECT_EQ(count, 17);
}

TEST_P(SandboxTest, SecretsAreNotSeen) {
  if (GetParam() == "bare") return;
  const PrivateFolder secret(0700);
  std::ofstream(secret.path() / "tests") << "42";
  EXPECT_FALSE(sees(sandbox(), secret.path()));
  EXPECT_FALSE(sees(sandbox(), secret.path() / "tests"));
  EXPECT_TRUE(sees(sandbox(), "/usr/bin"));
  EXPECT_FALSE(sees(sandbox(), "/etc/shadow"));
}

TEST_P(SandboxTest, EnvironmentInputAndDescriptorsAreItsOwn) {
  setenv("LANE_TEST_SECRET", "42", 1);
  Job asking = shell("read line; echo $line >&3; /usr/bin/env >&3");
  asking.input = "hello\n";
  asking.limits.processes = 2;
  const std::string answers = sandbox().run(asking).answers;
  EXPECT_TRUE(answers.starts_with("hello\n")) << answers;
  EXPECT_NE(answers.find("PATH=/usr/bin:/bin\n"), std::string::npos) << answers;
  EXPECT_EQ(answers.find("SECRET"), std::string::npos) << answers;
  // the shell inherits descriptors 0 to 3, and opens another one to list them
  Job listing = shell("cd /proc/self/fd; for n in *; do [ -e $n ] && echo $n >&3; done");
  listing.limits.processes = 1;
  EXPECT_EQ(sandbox().run(listing).answers, "0\n1\n2\n3\n");
}

TEST_P(SandboxTest, AnInputThatIsNotReadDoesNoHarmAndALongOneArrives) {
  Job ignoring = job("exit", "3");
  ignoring.input.assign(1 << 20, 'x');
  EXPECT_EQ(sandbox().run(ignoring).code, 3);
  Job counting = shell("/usr/bin/wc -c >&3");
  counting.input.assign(1 << 20, 'x');
  counting.limits.processes = 1;
  EXPECT_EQ(sandbox().run(counting).answers, "1048576\n");
}

TEST_P(SandboxTest, ManyRunAtOnceAndDoNotMix) {
  std::vector<std::thread> threads;
  std::vector<std::string> answers(8);
  for (std::size_t i = 0; i < answers.size(); ++i)
    threads.emplace_back([&, i] {
      Job saying = shell("read line; echo $line >&3");
      saying.input = std::to_string(i) + "\n";
      answers[i] = sandbox().run(saying).answers;
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < answers.size(); ++i) EXPECT_EQ(answers[i], std::to_string(i) + "\n");
}

/// The only child of the process, as soon as it has one.
pid_t child_of(pid_t parent) {
  pid_t child = 0;
  const std::string file = "/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children";
  while (!(std::ifstream(file) >> child)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return child;
}

// The supervisor of a killed grader kills all processes of its user. Until then, no other grader may use this user.
TEST_P(SandboxTest, ProgramsSurviveTheEndOfAKilledGrader) {
  adopt_orphans();
  const pid_t grader = fork();
  if (grader == 0) {
    sandbox().run(shell("while :; do :; done"));
    _exit(0);
  }
  const pid_t supervisor = child_of(grader);
  child_of(supervisor);
  kill(supervisor, SIGSTOP);
  kill(grader, SIGKILL);
  waitpid(grader, nullptr, 0);
  std::thread later([supervisor] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(supervisor, SIGCONT);
  });
  Job counting = shell("i=0; while [ $i -lt 500000 ]; do i=$((i+1)); done; echo done >&3");
  counting.limits = {.cpu = 30, .wall = 60};
  const End end = sandbox().run(counting);
  later.join();
  EXPECT_TRUE(done(end)) << end.how << ' ' << show(end);
  waitpid(supervisor, nullptr, 0);
}

TEST_P(SandboxTest, WhatCannotBeStartedSaysSo) {
  Job absent;
  absent.command = {"/usr/bin/no-such-program"};
  try {
    sandbox().run(absent);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("/usr/bin/no-such-program: "), std::string::npos) << said;
    EXPECT_TRUE(said.ends_with("No such file or directory")) << said;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, SandboxTest, testing::Values("bwrap", "uid", "bare"),
                         [](const auto& of) { return of.param; });

TEST(ChooseSandbox, UnsafeMustBeSaidTwiceAndNamesAreListed) {
  const auto message = [](const std::string& named, bool unsafe) -> std::string {
    try {
      return std::string(choose_sandbox(named, unsafe)->name());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("", true), "bare");
  EXPECT_EQ(message("bare", true), "bare");
  EXPECT_NE(message("bare", false).find("needs --no-sandbox"), std::string::npos);
  EXPECT_EQ(message("nosuch", false), "--lane nosuch: there is no such lane; expected one of: bwrap, uid, bare");
}

struct Stalled final : Sandbox {
  std::string_view name() const override { return "stalled"; }
  std::string_view says() const override { return ""; }
  End run(const Job& job) const override {
    EXPECT_GE(job.limits.wall, 60) << "on a machine under load even a shell takes seconds to start";
    return {How::wall, 0, "", "", 0};
  }
};

TEST(Sees, StalledSandboxIsAnErrorAndNoProofOfBlindness) { EXPECT_THROW(sees(Stalled(), "/x"), std::runtime_error); }

/// Output of choose_sandbox in a process that is started by the command `before`.
std::string elsewhere(const std::string& before) {
  const std::string command = before + " " SANDBOX_CHOICE;
  FILE* out = popen(command.c_str(), "r");
  char text[4096] = "";
  const std::size_t got = fread(text, 1, sizeof text, out);
  pclose(out);
  return std::string(text, got);
}

TEST(ChooseSandbox, WithoutNamespacesAnotherUserIsChosen) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  EXPECT_EQ(elsewhere(SANDBOX_NO_NAMESPACES), "uid\n");
}

TEST(ChooseSandbox, WhereNoneCanBeHadItRefusesAndSaysWhy) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root to start as nobody";
  const std::string said = elsewhere(SANDBOX_NO_NAMESPACES " setpriv --reuid 65534 --clear-groups");
  for (const char* part : {"so it is not run", "bwrap: ", "uid: it needs root", "--no-sandbox submissions run as you"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
}

}  // namespace

}  // namespace coursework
