// Content of the package, and the container in which it is rehearsed. The rehearsal itself takes minutes and is not
// tested here.
#include "tests/coursework/grader/pack.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <set>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/container.h"

namespace coursework {
namespace {

namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

TEST(SourcesNeeded, FollowsIncludesAndWhatBelongsToHeaders) {
  const TemporaryFolder tree("sources");
  const std::pair<const char*, const char*> files[] = {
      {"a/main.cpp", "#include \"a/x.h\"\n#include <vector>\n#include \"local.h\"\n"},
      {"a/local.h", ""},
      {"a/x.h", "#include \"b/y.h\"\n"},
      {"a/x.cpp", "#include \"a/x.h\"\n"},
      {"a/part.cpp", "#include \"a/x.h\"\n"},                         // belongs to x.h: has no header of its own
      {"a/other.h", ""},                                              // not included by any file
      {"a/other.cpp", "#include \"a/x.h\"\n"},                        // uses x.h, but belongs to other.h
      {"a/second.cpp", "#include \"a/x.h\"\nint main() {}\n"},        // another program
      {"a/calls.cpp", "#include \"a/x.h\"\n#include \"calls.h\"\n"},  // compiled elsewhere, with another calls.h
      {"b/y.h", ""},
      {"b/z.cpp", "#include \"b/y.h\"\n#include \"b/w.h\"\n"},
      {"b/w.h", ""},
      {"c/far.cpp", "#include \"b/y.h\"\n"},  // uses y.h from another folder
  };
  for (const auto& [name, content] : files) write_file(tree.path / name, content);
  const std::vector<std::string> expected = {"a/local.h", "a/main.cpp", "a/part.cpp", "a/x.cpp",
                                             "a/x.h",     "b/w.h",      "b/y.h",      "b/z.cpp"};
  EXPECT_EQ(sources_needed(tree.path, {"a/main.cpp"}), expected);
}

/// Names between `open` and `close` in the include lines of a text.
std::vector<std::string> included(const std::string& text, char open, char close) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const size_t at = line.find(open); line.starts_with("#include") && at != std::string::npos)
      names.push_back(line.substr(at + 1, line.find(close, at + 1) - at - 1));
  return names;
}

/// Expects that all includes of a package's sources, direct and indirect, are in the package.
void expect_includes_inside(const fs::path& in) {
  std::vector<std::string> todo;
  std::istringstream sources(content_of_file(in / "sources.txt"));
  for (std::string source; sources >> source;) todo.push_back(source);
  EXPECT_GT(todo.size(), 30u);
  std::set<std::string> seen(todo.begin(), todo.end());
  while (!todo.empty()) {
    const std::string file = todo.back(), text = content_of_file(in / file);
    todo.pop_back();
    SCOPED_TRACE(file);
    for (const std::string& name : included(text, '"', '"')) {
      const fs::path beside = (fs::path(file).parent_path() / name).lexically_normal();
      const std::string found = fs::exists(in / beside) ? beside.generic_string() : name;
      EXPECT_TRUE(fs::exists(in / found)) << name;
      if (fs::exists(in / found) && seen.insert(found).second) todo.push_back(found);
    }
    // headers of these libraries are neither in the package nor on the machine that builds it
    for (const std::string& name : included(text, '<', '>'))
      EXPECT_FALSE(name.starts_with("boost/") || name.starts_with("Spectra/")) << name;
  }
}

TEST(Package, HoldsScriptsSourcesAndSecretAndNoOtherAssignment) {
  ASSERT_GE(assignments().size(), 2u);
  for (const Assignment& assignment : assignments()) {
    SCOPED_TRACE(assignment.name);
    const TemporaryFolder scratch("package");
    write_package(assignment, "the secret", scratch.path / "p.zip");
    const fs::path in = scratch.path / "in";
    unpack_zip(scratch.path / "p.zip", in);
    for (const char* script : {"setup.sh", "run_autograder", "build.sh"}) {
      EXPECT_TRUE(fs::exists(in / script));
      EXPECT_NE(fs::status(in / script).permissions() & fs::perms::owner_exec, fs::perms::none) << script;
      EXPECT_EQ(content_of_file(in / script).find("{0}"), std::string::npos);
    }
    EXPECT_EQ(content_of_file(in / "secret.txt"), "the secret\n");
    EXPECT_TRUE(fs::exists(in / "headers/Eigen/Core"));
    EXPECT_TRUE(fs::exists(in / "tests/coursework" / assignment.name / "mistakes.txt"));
    std::istringstream sources(content_of_file(in / "sources.txt"));
    int programs = 0;
    for (std::string source; sources >> source;) {
      EXPECT_TRUE(fs::exists(in / source)) << source;
      programs += content_of_file(in / source).find("\nint main(") != std::string::npos;
    }
    EXPECT_EQ(programs, 1);
    expect_includes_inside(in);
    for (const Assignment& other : assignments())
      if (other.name != assignment.name) {
        EXPECT_FALSE(fs::exists(in / "tests/coursework" / other.name)) << other.name;
        std::string identifier(other.name);
        std::replace(identifier.begin(), identifier.end(), '-', '_');
        EXPECT_EQ(content_of_file(in / "tests/coursework/grader/assignments.cpp").find(identifier + "()"),
                  std::string::npos);
      }
  }
}

TEST(Zip, StaysInsideItsFolder) {
  const TemporaryFolder scratch("zip");
  for (const char* name : {"../out.txt", "/tmp/out.txt", "a/../../out.txt", "a/\x1b[2J"}) {
    write_zip(scratch.path / "p.zip", {{name, "x"}});
    EXPECT_THROW(unpack_zip(scratch.path / "p.zip", scratch.path / "in"), std::runtime_error) << name;
  }
  write_file(scratch.path / "no.zip", "no zip");
  EXPECT_THROW(unpack_zip(scratch.path / "no.zip", scratch.path / "in"), std::runtime_error);
  EXPECT_FALSE(fs::exists(scratch.path / "out.txt"));
}

TEST(Zip, ThatUnpacksToTooMuchIsRefused) {
  const TemporaryFolder scratch("zip");
  const std::string part((16u << 20) + 1, '\0');  // compresses to a thousandth
  write_zip(scratch.path / "bomb.zip", {{"1", part}, {"2", part}, {"3", part}, {"4", part}});
  EXPECT_THROW(unpack_zip(scratch.path / "bomb.zip", scratch.path / "in"), std::runtime_error);
}

TEST(Package, OfAnotherIsKnownBeforeAnyOfItRuns) {
  const TemporaryFolder scratch("pack");
  const Assignment& assignment = assignments()[0];
  const fs::path in = scratch.path / "in";
  write_package(assignment, "a secret", scratch.path / "p.zip");
  unpack_zip(scratch.path / "p.zip", in);
  EXPECT_EQ(foreign_file(assignment, in), "");
  for (const char* name : {"build.sh", "run_autograder", "sources.txt", "headers/fmt/core.h"}) {
    const std::string before = content_of_file(in / name);
    write_file(in / name, before + "\n");
    EXPECT_EQ(foreign_file(assignment, in), name) << "changed";
    fs::remove(in / name);
    EXPECT_EQ(foreign_file(assignment, in), name) << "missing";
    write_file(in / name, before);
  }
  write_file(in / "secret.txt", "another");
  EXPECT_EQ(foreign_file(assignment, in), "");
  write_file(in / "headers/vector", "#include </etc/passwd>");
  EXPECT_EQ(foreign_file(assignment, in), "headers/vector") << "one more";

  write_zip(scratch.path / "evil.zip", {{"build.sh", "#!/bin/sh\ntouch " + (scratch.path / "PWNED").string() + "\n"},
                                        {"setup.sh", ""},
                                        {"run_autograder", ""}});
  EXPECT_FALSE(rehearse(assignment, scratch.path / "evil.zip"));
  EXPECT_FALSE(fs::exists(scratch.path / "PWNED"));
}

/// Temporarily limits the size of files that this process may write; a write beyond it fails, as on a full disk.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Zip, IsWholeOrNotThere) {
  const TemporaryFolder scratch("zip");
  const fs::path zip = scratch.path / "p.zip";
  std::string noise;  // incompressible data
  for (unsigned i = 1; noise.size() < 100000; i = i * 1664525 + 1013904223) noise += static_cast<char>(i >> 24);
  for (const bool earlier : {false, true}) {
    if (earlier) write_file(zip, "an earlier one");
    {
      const SmallFiles small(50000);
      try {
        write_zip(zip, {{"noise", noise}});
        ADD_FAILURE() << "it was written";
      } catch (const crosscheck::InputError& error) {
        EXPECT_NE(std::string(error.what()).find("p.zip: cannot be written"), std::string::npos) << error.what();
      }
    }
    EXPECT_EQ(fs::exists(zip), earlier);
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path), {}), earlier) << "nothing half is left";
  }
  EXPECT_EQ(content_of_file(zip), "an earlier one");
  write_zip(zip, {{"noise", noise}, {"run.sh", "#!/bin/sh\n"}});
  unpack_zip(zip, scratch.path / "in");
  EXPECT_EQ(content_of_file(scratch.path / "in/noise"), noise);
}

struct Ran {
  Usage used;
  std::string log;
};
Ran shell(const std::string& script, const Container& container) {
  const TemporaryFolder scratch("watched");
  const fs::path log = scratch.path / "log";
  const Usage used = run_in_container({"/bin/sh", "-c", script}, {"PATH=/usr/bin:/bin"}, log, container);
  return {used, content_of_file(log)};
}

TEST(RunInContainer, ReportsStatusAndOutput) {
  const Ran ran = shell("echo out; echo err >&2; exit 7", {});
  EXPECT_EQ(ran.used.status, 7);
  EXPECT_EQ(ran.log, "out\nerr\n");
  EXPECT_FALSE(ran.used.too_late || ran.used.too_large);
  EXPECT_EQ(shell("kill -SEGV $$", {}).used.status, 128 + 11);
}

TEST(RunInContainer, StopsWhatTakesTooLongOrTooMuch) {
  EXPECT_TRUE(shell("sleep 60 & sleep 60", {.time = 0.3}).used.too_late);
  // a pipe whose last command holds 200 MB
  EXPECT_TRUE(
      shell("head -c 200000000 /dev/zero | tail -c 200000000 > /dev/null; sleep 60", {.memory = 100, .time = 30})
          .used.too_large);
}

TEST(RunInContainer, CountsTheWorkOfAllProcessesAtSoManyCpus) {
  // with so few `cpus`, `time` is CPU time divided by `cpus`: two shells that count in parallel take longer than one
  const std::string work = "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done";
  const auto time_of = [](const std::string& script) { return shell(script, {.cpus = 1e-3}).used.time; };
  // other load on the machine only lengthens a run: compares the shortest of three runs each, in alternation
  double both = INFINITY, one = INFINITY;
  for (int round = 0; round < 3; ++round) {
    both = std::min(both, time_of("(" + work + ") & (" + work + "); wait"));
    one = std::min(one, time_of(work));
  }
  EXPECT_GT(both, 1.3 * one);
}

TEST(RunInContainer, RefusesNewNamespaces) {
  EXPECT_NE(shell("unshare -U true", {}).used.status, 0);
  EXPECT_NE(shell("unshare -m true", {}).used.status, 0);
  EXPECT_EQ(shell("sh -c true; (true) & wait", {}).used.status, 0);  // other processes may be started
}

}  // namespace
}  // namespace coursework
