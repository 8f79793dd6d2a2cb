// Misbehaving programs: each failure yields a verdict with a clear message, and never crashes the suite.

#include <signal.h>
#include <nlohmann/json.hpp>

#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "experiments/sweep/sweep.h"
#include "mysim/base/files.h"
#include "mysim/base/json.h"
#include "mysim/base/process.h"
#include "reference/certificate/certificate.h"
#include "reference/protocol/exec_engine.h"
#include "reference/protocol/trajectory_files.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/temporary.h"

namespace crosscheck {
namespace {

namespace fs = std::filesystem;

using namespace testing_tools;

class Exec : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    const Trajectory right = run_and_record("symplectic-euler", scene_, run_).trajectory;
    write("x.npy", npy_bytes(right.x));
    write("v.npy", npy_bytes(right.v));
    auto bad = right.x;
    bad[3](1, 1) = NAN;
    write("nan.npy", npy_bytes(bad));
    bad = right.x;
    bad[0](1, 1) += 0.01;
    write("shifted.npy", npy_bytes(bad));
    write("short.npy", npy_bytes(right.x).substr(0, 300));
    write("few-frames.npy", npy_bytes({right.x.begin(), right.x.end() - 1}));
    write("few-particles.npy", npy_bytes(std::vector<Points>(5, Points::Zero(3, 3))));
  }
  /// Shell command that copies a prepared file to the program's output folder.
  std::string deliver(const std::string& file, const std::string& as = "trajectory.npy") const {
    return "cp '" + (folder_ / file).string() + "' \"$2/" + as + "\"\n";
  }
  MethodRun run(const std::string& text, const std::string& options = "") const {
    return run_and_record("exec:" + script("engine", text) + options, scene_, run_);
  }
  const Scene scene_ = load_scene("chain");
  const crosscheck::Run run_{1e-3, 0.004, 4};  // one sample per step, because programs write no other states
};

TEST_F(Exec, AReadbackWithoutProbeDoesNotAttestTheLaw) {
  // An engine with correct parameters but another spring law: all numbers that it reads back are correct.
  Json readback{{"precision", "double"}};
  const Particles& p = scene_.model.particles;
  readback["mass"] = std::vector<double>(p.mass.begin(), p.mass.end());
  readback["pinned"] = std::vector<int>(p.pinned.begin(), p.pinned.end());
  for (const Spring& s : scene_.model.find<Springs>()->list)
    readback["links"].push_back({{"a", s.a}, {"b", s.b}, {"rest_length", s.rest}, {"stiffness", s.k}});
  write("run.json", dump(Json{{"readback", readback}}));
  const MethodRun delivered = run(deliver("x.npy") + deliver("run.json", "run.json"));
  ASSERT_EQ(delivered.outcome.verdict, Verdict::ok) << delivered.outcome.reason;
  const Certificate c = certify("engine", scene_, delivered.outcome);
  EXPECT_FALSE(c.mismatch());
  EXPECT_FALSE(c.fully_attested());
  EXPECT_TRUE(contains(summary_of(c),
                       "no mismatch; not attested: start, spring law, gravity, drag, nothing else, step, sleeping"));
}

TEST_F(Exec, EachMisbehaviourIsAVerdictWithAClearLine) {
  const std::string good = deliver("x.npy");
  const struct {
    std::string what, text, options;
    Verdict verdict;
    std::string reason;
  } cases[] = {
      {"hangs, and ignores SIGTERM", "trap '' TERM\necho warming up >&2\nwhile :; do sleep 1; done\n", "+timeout=1",
       Verdict::timeout, "did not end within 1 s and was killed; last line of its stderr: warming up"},
      {"dies of a signal", "kill -SEGV $$\n", "", Verdict::crash, "was ended by signal 11 (Segmentation fault)"},
      {"exits with a status", good + "echo no licence >&2\nexit 7\n", "", Verdict::crash,
       "ended with exit status 7; last line of its stderr: no licence"},
      {"delivers another shape", deliver("few-frames.npy"), "", Verdict::crash,
       "trajectory.npy: expected shape (5, 4, 3): 5 frames of 4 particles, got (4, 4, 3)"},
      {"delivers what is no number", deliver("nan.npy"), "", Verdict::nan, "failed at t = 0.003 s"},
      {"delivers a short file", deliver("short.npy"), "", Verdict::crash, "shorter than its header says"},
      {"delivers other particles", deliver("few-particles.npy"), "", Verdict::crash, "another number of particles"},
      {"delivers nothing", "exit 0\n", "", Verdict::crash, "trajectory.npy: missing"},
      {"dies and leaves a child that holds the pipe", "(trap '' TERM HUP; sleep 60) &\nexit 4\n", "", Verdict::crash,
       "exit status 4"},
      {"delivers a folder", "mkdir \"$2/trajectory.npy\"\n", "", Verdict::crash, "trajectory.npy: expected a file"},
      {"links to what never ends", good + "ln -s /dev/zero \"$2/run.json\"\n", "", Verdict::crash,
       "run.json: expected a file, got a symbolic link"},
      {"links to a file of the user's", "ln -s '" + (folder_ / "x.npy").string() + "' \"$2/trajectory.npy\"\n", "",
       Verdict::crash, "trajectory.npy: expected a file, got a symbolic link"},
      {"delivers a pipe", good + "mkfifo \"$2/velocities.npy\"\n", "", Verdict::crash,
       "velocities.npy: expected a file, got a device, pipe or socket"},
      {"claims a header of 4 GB and has it",
       "printf '\\223NUMPY\\002\\000\\377\\377\\377\\377' > \"$2/trajectory.npy\"\n"
       "truncate -s 5G \"$2/trajectory.npy\"\n",
       "", Verdict::crash, "trajectory.npy: expected a header of at most 65535 bytes"},
      {"speaks to the terminal",
       good + "printf '{\"verdict\": \"solver\", \"reason\": \"\\\\u001b[2Jno root\"}' > \"$2/run.json\"\n", "",
       Verdict::solver, "?[2Jno root"},
      {"starts from elsewhere", deliver("shifted.npy"), "", Verdict::crash, "got one that is 0.01 m off"},
      {"delivers velocities of another shape", good + deliver("few-frames.npy", "velocities.npy"), "", Verdict::crash,
       "velocities.npy: expected shape"},
      {"writes no JSON", good + "echo '{' > \"$2/run.json\"\n", "", Verdict::crash,
       "run.json: expected one JSON object"},
      {"writes other JSON", good + "echo '{\"steps\": \"many\"}' > \"$2/run.json\"\n", "", Verdict::crash,
       "run.json: steps: expected a number"},
      {"says that its springs are too long",
       good + "echo '{\"verdict\": \"stretch\", \"reason\": \"torn\"}' > \"$2/run.json\"\n", "", Verdict::stretch,
       "torn"},
      {"says that it failed", good + "echo '{\"verdict\": \"solver\", \"reason\": \"no root\"}' > \"$2/run.json\"\n",
       "", Verdict::solver, "no root"},
      {"lacks something", "echo ' warning'\necho 'no springs here' >&2\nexit 3\n", "", Verdict::unsupported,
       "no springs here"},
      {"lacks something in silence", "exit 3\n", "", Verdict::unsupported, "without a reason"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.what);
    const MethodRun a = run(c.text, c.options);
    EXPECT_EQ(name_of(a.outcome.verdict), name_of(c.verdict));
    EXPECT_TRUE(contains(a.outcome.reason, c.reason));
    EXPECT_EQ(a.outcome.reason.find('\n'), std::string::npos) << "expected one line";
    EXPECT_FALSE(a.outcome.readback);
  }
}

TEST_F(Exec, NoiseIsARemarkOnAGoodRun) {
  const std::string noise =
      "i=0\nwhile [ $i -lt 3000 ]; do echo 'noise noise noise noise noise noise' >&2; i=$((i+1)); "
      "done\nprintf 'bell \\007 and \\377 byte\\n\\n' >&2\n";
  const MethodRun a = run(noise + deliver("x.npy"));
  EXPECT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
  EXPECT_EQ(a.outcome.remark, "last line of its stderr: bell ? and ? byte");
  EXPECT_EQ(run(deliver("x.npy") + "echo fine\n").outcome.remark, "") << "stdout gives no remark";
}

TEST_F(Exec, WhatAProgramLeavesBehindIsKilled) {
  // In each case, a process remains that keeps writing until it is killed. Its standard output is either closed or
  // open.
  write("beat.sh", "while :; do echo >> '" + (folder_ / "beats").string() + "'; sleep 0.02; done\n");
  const std::string beat = "sh '" + (folder_ / "beat.sh").string() + "'", quiet = " > /dev/null 2>&1 &\n",
                    wait = "while ! [ -s '" + (folder_ / "beats").string() + "' ]; do sleep 0.01; done\n";
  const std::pair<const char*, std::string> cases[] = {
      {"a child with the output open", beat + " &\n"},
      {"a child with its own output", beat + quiet},
      {"a session of its own", "setsid " + beat + quiet},
      {"a double fork in a session of its own", "(setsid sh -c \"" + beat + " &\" &)" + quiet},
      {"deaf to signals", "(trap '' TERM HUP INT; " + beat + ")" + quiet}};
  for (const auto& [what, text] : cases) {
    SCOPED_TRACE(what);
    std::filesystem::remove(folder_ / "beats");
    const MethodRun a = run(deliver("x.npy") + text + wait);
    ASSERT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
    EXPECT_EQ(a.outcome.remark, "it left a process behind, which was killed");
    const auto beats = std::filesystem::file_size(folder_ / "beats");
    EXPECT_GT(beats, 0u);
    usleep(100000);  // in this time, the process would write five times
    EXPECT_EQ(std::filesystem::file_size(folder_ / "beats"), beats) << "the process is still alive";
  }
}

TEST_F(Exec, TemporaryFoldersOfAKilledProgramGoWithIt) {
  const std::string name = (folder_ / "name").string();
  const std::string text =
      "f=${TMPDIR:-/tmp}/crosscheck-kept-$$.tmp-$(head -c 3 /dev/urandom | od -An -tx1 | tr -d ' ')\n"
      "mkdir \"$f\"; echo \"$f\" > '" +
      name + "'\nsleep 60\n";
  EXPECT_EQ(run(text, "+timeout=0.5").outcome.verdict, Verdict::timeout);
  std::string made = read(name);
  ASSERT_FALSE(made.empty());
  made.pop_back();
  EXPECT_FALSE(std::filesystem::exists(made)) << made;
}

TEST_F(Exec, AProgramThatKillsItsParentHarmsNobody) {
  const MethodRun a = run("kill -KILL $PPID\n" + deliver("x.npy"));
  // The kill has no effect in a pid namespace. Elsewhere it ends the watcher, and this is reported.
  if (a.outcome.verdict == Verdict::ok)
    EXPECT_EQ(a.trajectory.frames(), 5);
  else
    EXPECT_TRUE(contains(a.outcome.reason, "killed its supervising process"));
}

TEST_F(Exec, AHugeRunJsonIsRefusedByItsSize) {
  const MethodRun a = run(deliver("x.npy") + "truncate -s 300M \"$2/run.json\"\n");
  EXPECT_EQ(a.outcome.verdict, Verdict::crash);
  EXPECT_TRUE(contains(a.outcome.reason,
                       "run.json: expected at most 1058476 bytes for a scene of this size, got "
                       "314572800"));
}

TEST_F(Exec, PositionsWhoseSquaresAreInfiniteAreAFailedRun) {
  for (const int particle : {0, 2}) {  // including a pin
    auto far = run_and_record("symplectic-euler", scene_, run_).trajectory.x;
    far[4](1, particle) = 1e300;
    write("far.npy", npy_bytes(far));
    EXPECT_EQ(run(deliver("far.npy")).outcome.verdict, Verdict::nan);
  }
}

TEST_F(Exec, APinThatIsLedAwayIsTold) {
  const Trajectory right = run_and_record("symplectic-euler", scene_, run_).trajectory;
  const struct {
    double off;
    std::string remark;
  } cases[] = {{1e-7, ""},  // allowed rounding in single precision: sixteen half ulps of 3 m, which are 3e-6 m
               {1e-3, "it moved the pinned particle 0 off its prescribed path: by 0.001 m at t = 0.002 s"}};
  for (const auto& [off, remark] : cases) {
    auto x = right.x;
    x[2](2, 0) += off;
    write("led.npy", npy_bytes(x));
    const Outcome out = run(deliver("led.npy")).outcome;
    EXPECT_EQ(out.verdict, Verdict::ok) << out.reason;
    EXPECT_TRUE(begins(out.remark, remark)) << out.remark;
    EXPECT_EQ(out.remark.empty(), remark.empty()) << out.remark;
  }
  // an engine that declares double precision is checked against it
  Json readback{{"mass", Json::array({1, 1, 1, 1})},
                {"pinned", Json::array({1, 0, 0, 0})},
                {"links", Json::array()},
                {"precision", "double"}};
  write("run.json", dump(Json{{"readback", readback}}));
  auto x = right.x;
  x[2](2, 0) += 1e-7;
  write("led.npy", npy_bytes(x));
  EXPECT_TRUE(
      contains(run(deliver("led.npy") + deliver("run.json", "run.json")).outcome.remark, "1e-07 m at t = 0.002"));
}

TEST_F(Exec, AProgramThatAttestedNothingIsSaidToHaveAttestedNothing) {
  for (const char* json : {"", "{}", "{\"steps\": 3}"}) {
    const Outcome out =
        run(deliver("x.npy") + (*json ? fmt::format("echo '{}' > \"$2/run.json\"\n", json) : "")).outcome;
    EXPECT_EQ(summary_of(certify("engine", scene_, out)), "nothing was read back; not attested: whole scene");
  }
}

TEST_F(Exec, SeesTheSceneAndIsSeenAsOtherMethodsAre) {
  const MethodRun a = run(deliver("x.npy") + deliver("v.npy", "velocities.npy") + "cp \"$1\" '" + folder_.string() +
                              "'\necho '{\"cpu_seconds\": 25, \"steps\": 80, "
                              "\"force_evaluations\": 80, \"different_law\": [\"drag: none\"]}' > \"$2/run.json\"\n",
                          "+fast+n=3+timeout=50");
  ASSERT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
  EXPECT_TRUE(identical(a.trajectory, run_and_record("symplectic-euler", scene_, run_).trajectory));
  EXPECT_TRUE(contains(read(folder_ / "scene.json"), "\"options\": [\"fast\",\"n=3\"]"));
  EXPECT_TRUE(contains(read(folder_ / "scene.json"), scene_.hash));
  EXPECT_EQ(a.outcome.cpu_seconds, 25);
  EXPECT_EQ(a.outcome.steps, 80);
  EXPECT_EQ(a.outcome.evaluations, 80);
  EXPECT_EQ(a.outcome.step, 1e-3);
  EXPECT_DOUBLE_EQ(a.outcome.end, 0.004);
  EXPECT_GT(a.outcome.process_seconds, 0);
  EXPECT_LT(a.outcome.process_seconds, 25);  // the shell's time; the time that the program states is not used
  EXPECT_EQ(a.outcome.different_law, std::vector<std::string>{"drag: none"});
}

TEST_F(Exec, WithoutVelocitiesThereIsNoEnergy) {
  Request request;
  request.scenes = {scene_, load_scene("slide")};
  for (Scene& scene : request.scenes) scene.duration = 0.004, scene.samples = 4;
  write("slide.npy",
        npy_bytes(run_and_record("symplectic-euler", request.scenes[1], default_run(request.scenes[1])).trajectory.x));
  const std::string which = "case $(cat \"$1\") in *'\"name\": \"slide\"'*) f=slide.npy;; *) f=x.npy;; esac\n";
  const std::string engine = script("engine", which + "cp '" + folder_.string() + "'/$f \"$2/trajectory.npy\"\n");
  request.methods = {find_method("symplectic-euler"), find_method("exec:" + engine)};
  TableSet result;
  MethodResults results;
  for (const Scene& scene : request.scenes) engines_on(request, scene, results, result);
  for (const MethodResult& a : results) {
    EXPECT_EQ(a.outcome.verdict, Verdict::ok) << a.outcome.reason;
    EXPECT_EQ(a.ledger.empty(), a.method != "mysim/symplectic-euler");
  }
  const Table& energies = *result.table("engines-energy");
  EXPECT_EQ(energies.rows.size(), 2u);  // rows of mysim on both scenes
  bool said = false;
  for (const std::string& note : result.notes) said |= note.find(": no velocities") != std::string::npos;
  EXPECT_TRUE(said);
  const Table& engines = *result.table("engines");
  for (size_t i = 0; i < engines.rows.size(); ++i)
    if (std::get<std::string>(engines.at(i, "method")).starts_with("exec:")) {
      EXPECT_TRUE(std::holds_alternative<std::monostate>(engines.at(i, "creep at end")));
      EXPECT_EQ(std::get<double>(engines.at(i, "largest difference")), 0);
    }
  const Table& cost = *result.table("engines-cost");
  for (size_t i = 0; i < cost.rows.size(); ++i) {
    const bool outside = std::get<std::string>(cost.at(i, "method")).starts_with("exec:");
    // The CPU time of the process has its own column. The program's own time is empty because it reported none.
    EXPECT_EQ(std::holds_alternative<double>(cost.at(i, "cpu of process")), outside);
    EXPECT_EQ(std::holds_alternative<double>(cost.at(i, "cpu")), !outside);
  }
}

TEST_F(Exec, ClosureIsClaimedOnlyWhereEveryStepIsSeen) {
  EXPECT_TRUE(Ledger(scene_.model, ContactLoss::sampled).contact_inferred());  // drag between samples is estimated
  EXPECT_FALSE(Ledger(without_drag(scene_).model, ContactLoss::sampled).contact_inferred());
  EXPECT_FALSE(Ledger(scene_.model, ContactLoss::inferred).contact_inferred());
}

TEST_F(Exec, NamesAreFilesFirstAndOptionsThen) {
  const std::string plain = script("engine", ""), odd = script("engine+n=2", "");
  EXPECT_EQ(find_program(plain).path, plain);
  EXPECT_EQ(find_program(odd).path, odd);  // a file with the full name exists
  EXPECT_TRUE(find_program(odd).options.empty());
  const Program more = find_program(odd + "+n=3+timeout=7.5+path=/a/b");
  EXPECT_EQ(more.path, odd);
  EXPECT_EQ(more.options, (std::vector<std::string>{"n=3", "path=/a/b"}));
  EXPECT_EQ(more.timeout, 7.5);
  EXPECT_EQ(find_program(plain).timeout, 600);
  EXPECT_TRUE(find_program("sh").path.is_absolute());  // bare names are looked up in PATH
  EXPECT_EQ(find_method("exec:" + plain + "+n=3").name, "exec:" + plain + "+n=3");
  EXPECT_EQ(find_methods("rk4,exec:" + plain).size(), 2u);
  EXPECT_TRUE(contains(refusal_of([&] { find_method("exec:" + script("a\n`touch PWNED`\n#", "")); }),
                       "expected a path without control and hidden characters"));
  write("data", "");
  const std::pair<std::string, std::string> cases[] = {
      {(folder_ / "none").string(), "none: no such file; expected the path of a program"},
      {(folder_ / "none+n=1").string(), "no such file"},
      {folder_.string(), "is a folder; expected a program"},
      {"", "no such file"},
      {"no-such-program-anywhere", "no such file"},
      {(folder_ / "data").string(), "is not executable"},
      {plain + "+timeout=0", "timeout: expected seconds above zero, got '0'"},
      {plain + "+timeout=soon", "got 'soon'"},
      {plain + "+timeout=", "got ''"}};
  for (const auto& [name, message] : cases) {
    try {
      find_method("exec:" + name);
      ADD_FAILURE() << name;
    } catch (const InputError& e) {
      EXPECT_TRUE(contains(e.what(), message));
      EXPECT_TRUE(begins(e.what(), "method exec:" + name));
    }
  }
}

TEST_F(Exec, WhatCannotBeStartedIsACrash) {
  std::filesystem::permissions(write("text", "no program\n"), std::filesystem::perms::owner_all);
  const Outcome out = run_and_record("exec:" + (folder_ / "text").string(), scene_, run_).outcome;
  EXPECT_EQ(out.verdict, Verdict::crash);
  EXPECT_TRUE(contains(out.reason, "cannot be started: Exec format error"));
}

TEST_F(Exec, ATrajectoryFromAFileIsAMethod) {
  const Method method = trajectory_method(folder_ / "x.npy", scene_, run_);
  EXPECT_EQ(method.name, "file:x.npy");
  Recorder r;
  EXPECT_EQ(run_method(method, scene_, run_, {&r}).verdict, Verdict::ok);
  EXPECT_EQ(r.trajectory.x, run_and_record("symplectic-euler", scene_, run_).trajectory.x);
  EXPECT_EQ(run_method(trajectory_method(folder_ / "nan.npy", scene_, run_), scene_, run_, {}).verdict, Verdict::nan);
  try {
    trajectory_method(folder_ / "few-frames.npy", scene_, run_);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_TRUE(contains(e.what(), "expected shape (5, 4, 3)"));
  }
}

// Serve mode. The program counts how often it is started. `answer` is the server's reaction to the request in $line,
// whose paths are in $scene and $out.
class ExecServer : public Exec {
 protected:
  Method server(const std::string& answer, const std::string& options = "") const {
    const std::string deliver_both = "deliver() { " + deliver("x.npy").substr(0, deliver("x.npy").size() - 1) +
                                     "; echo '{\"cpu_seconds\": 0.001, \"serves\": true}' > \"$2/run.json\"; }\n";
    return find_method("exec:" +
                       script("engine", "echo start >> '" + starts().string() + "'\n" + deliver_both +
                                            "[ \"$1\" = --serve ] || { deliver \"$1\" \"$2\"; exit 0; }\n"
                                            "while read -r line; do\n"
                                            "out=${line##*'\"out\":\"'}\nout=${out%%\\\"*}\n" +
                                            answer + "\ndone\n") +
                       options);
  }
  fs::path starts() const { return folder_ / "starts"; }
  long count_starts() const { return std::ranges::count(read(starts()), '\n'); }
  MethodRun run(const Method& method) const {
    Recorder r;
    MethodRun done{{}, run_method(method, scene_, run_, {&r})};
    done.trajectory = r.trajectory;
    return done;
  }
};

TEST_F(ExecServer, IsStartedOnceForManyRuns) {
  const Method method = server("deliver - \"$out\"; echo a word; echo '{\"status\": 0}'");
  const MethodRun first = run(method);
  ASSERT_EQ(first.outcome.verdict, Verdict::ok) << first.outcome.reason;
  for (int i = 0; i < 5; ++i) {
    const Method copy = method;  // shares the server process
    const MethodRun again = run(copy);
    ASSERT_EQ(again.outcome.verdict, Verdict::ok) << again.outcome.reason;
    for (size_t frame = 0; frame < first.trajectory.x.size(); ++frame)
      EXPECT_EQ(again.trajectory.x[frame], first.trajectory.x[frame]);
    EXPECT_GT(again.outcome.process_seconds, 0);
  }
  EXPECT_EQ(count_starts(), 2) << "expected one call, then one server";
}

TEST_F(ExecServer, IsNotStartedForAProgramThatDoesNotServeOrDoesNotTellItsTime) {
  for (const char* told :
       {"{\"cpu_seconds\": 0.001}", "{\"serves\": true}", "{\"serves\": false, \"cpu_seconds\": 1}"}) {
    fs::remove(starts());
    const Method method =
        find_method("exec:" + script("engine", "echo $1 >> '" + starts().string() + "'\n" + deliver("x.npy") +
                                                   "echo '" + told + "' > \"$2/run.json\"\n"));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(run(method).outcome.verdict, Verdict::ok);
    EXPECT_EQ(count_starts(), 3) << told;
    EXPECT_FALSE(contains(read(starts()), "--serve"));
  }
}

TEST_F(ExecServer, RefusesAndFailsInItsOwnWords) {
  const Method refuses = server("echo '{\"status\": 3, \"reason\": \"has no nets\"}'");
  run(refuses);
  const MethodRun refused = run(refuses);
  EXPECT_EQ(refused.outcome.verdict, Verdict::unsupported);
  EXPECT_EQ(refused.outcome.reason, "has no nets");
  const Method fails = server("echo '{\"status\": 1, \"reason\": \"out of luck\"}'");
  run(fails);
  const MethodRun failed = run(fails);
  EXPECT_EQ(failed.outcome.verdict, Verdict::crash);
  EXPECT_TRUE(contains(failed.outcome.reason, "out of luck"));
  const Method empty = server("echo '{\"status\": 0}'");
  run(empty);
  EXPECT_TRUE(contains(run(empty).outcome.reason, "trajectory.npy: missing"));
}

TEST_F(ExecServer, ThatDoesNotAnswerIsReplacedByACallForEachRun) {
  for (const char* answer : {"exit 0", "kill -9 $$", "echo '{\"status\": '", "echo '{}'", "exec cat /dev/zero"}) {
    fs::remove(starts());
    const Method method = server(answer);
    for (int i = 0; i < 3; ++i) {
      const MethodRun done = run(method);
      EXPECT_EQ(done.outcome.verdict, Verdict::ok) << answer << ": " << done.outcome.reason;
    }
    EXPECT_EQ(count_starts(), 4) << answer << ": expected three calls and one failed server";
  }
}

TEST_F(ExecServer, LeavesNothingBehindAtTheTimeLimitAndWithItsMethod) {
  const fs::path beats = folder_ / "beats";
  write("beat.sh", "while :; do echo >> '" + beats.string() + "'; sleep 0.02; done\n");
  const std::string detach = "setsid sh '" + (folder_ / "beat.sh").string() + "' < /dev/null > /dev/null 2>&1 &\n" +
                             "while ! [ -s '" + beats.string() + "' ]; do sleep 0.01; done\n";
  for (const bool hangs : {true, false}) {
    fs::remove(beats);
    {
      const Method method = server(detach + (hangs ? "sleep 1000" : "deliver - \"$out\"; echo '{\"status\": 0}'"),
                                   hangs ? "+timeout=0.5" : "");
      run(method);
      EXPECT_EQ(run(method).outcome.verdict, hangs ? Verdict::timeout : Verdict::ok);
    }
    const auto size = fs::file_size(beats);
    EXPECT_GT(size, 0u);
    usleep(100000);  // in this time, the process would write five times
    EXPECT_EQ(fs::file_size(beats), size) << "the process is still alive";
  }
}

}  // namespace
}  // namespace crosscheck
