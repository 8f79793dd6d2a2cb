// Tests that the result of `cmake --install` works without the build folder and the source tree.

#include <gtest/gtest.h>

#include <set>

#include "mysim/base/files.h"
#include "mysim/base/text.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck::testing_tools {
namespace {

class Installed : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    all_ = new TemporaryFolder("installed");
    const ProgramResult end =
        run_program({CROSSCHECK_CMAKE, "--install", CROSSCHECK_BUILD, "--prefix", prefix().string()}, all_->path);
    ASSERT_EQ(end.status, 0) << end.out << end.err;
    fs::create_directory(work());
  }
  static void TearDownTestSuite() { delete all_; }

  static fs::path prefix() { return all_->path / "usr"; }
  static fs::path work() { return all_->path / "work"; }
  static fs::path program() { return prefix() / "bin/crosscheck"; }

  /// Runs a command while an empty mount hides the source tree.
  static ProgramResult unseen(const std::string& command) {
    std::vector<std::string> words{"unshare", "--mount"};
    if (geteuid() != 0) words.insert(words.end(), {"--user", "--map-root-user"});
    words.insert(words.end(), {"bash", "-c", "mount -t tmpfs none \"$0\" && cd \"$1\" && " + command,
                               std::string(CROSSCHECK_SOURCE), work().string()});
    return run_program(words, work(),
                       {"HOME=" + work().string(), "CROSSCHECK_CACHE=" + (work() / "cache").string(),
                        "CROSSCHECK_LOCK=" + (work() / "lock").string(), "ASAN_OPTIONS=detect_leaks=0"});
  }
  static std::string read(const fs::path& file) { return read_file(file, "a file"); }
  static bool can_hide() { return unseen("true").status == 0; }

 private:
  static TemporaryFolder* all_;
};
TemporaryFolder* Installed::all_ = nullptr;

TEST_F(Installed, NoFileNamesTheSourceTree) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(prefix())) {
    if (!entry.is_regular_file() || entry.is_symlink()) continue;
    ++files;
    EXPECT_EQ(read(entry.path()).find(CROSSCHECK_SOURCE "/"), std::string::npos) << entry.path();
  }
  EXPECT_GT(files, 300);
}

TEST_F(Installed, WorksWithoutTheSourceTree) {
  if (!can_hide()) GTEST_SKIP() << "this machine does not support mount namespaces, which hide the source tree";
  EXPECT_NE(unseen("cat " CROSSCHECK_SOURCE "/README.md").status, 0);
  const std::vector<std::string> calls = {
      "list scenes",
      "list assignments",
      "validate cloth-hang",
      "compare chain --methods leapfrog,bullet/deformable-explicit,bullet32/deformable-explicit",
      "render chain -o chain.png --size 320x180 --quality fast",
      "assignment a1-steppers --out handout",
      "check exec:" + (prefix() / "lib/crosscheck/example_engine").string() + " pendulum",
      "regress --filter pendulum/mysim/leapfrog --no-speed"};
  for (const std::string& words : calls) {
    const ProgramResult end = unseen(program().string() + " " + words);
    EXPECT_EQ(end.status, 0) << words << "\n" << end.out << end.err;
  }
  EXPECT_TRUE(fs::exists(work() / "handout"));
  // output goes to the working folder, because the installation is not writable
  const ProgramResult run = unseen(program().string() + " run chain --meshes obj");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(fs::exists(work() / "out/run/meshes/frame-0001.obj"));
  EXPECT_TRUE(contains(read(work() / "out/run/energy.csv"), "# commit: "));
}

TEST_F(Installed, WhatNeedsASourceTreeSaysSo) {
  const auto refused = [](const std::string& words) {
    const ProgramResult end = run_program({"bash", "-c", program().string() + " " + words}, work());
    EXPECT_EQ(end.status, 2) << words;
    return end.err;
  };
  EXPECT_TRUE(contains(refused("test"), "in a source tree"));
}

TEST_F(Installed, AProgramAwayFromItsFilesSaysSo) {
  fs::copy_file(prefix() / "lib/crosscheck/crosscheck", work() / "alone");
  const ProgramResult end = run_program({(work() / "alone").string(), "list", "scenes"}, work());
  EXPECT_EQ(end.status, 2);
  EXPECT_TRUE(contains(end.err, "found no file crosscheck.folders next to it")) << end.err;
}

TEST_F(Installed, TheLibraryIsFoundAndRuns) {
  write_file(work() / "rope/CMakeLists.txt",
             "cmake_minimum_required(VERSION 3.25)\nproject(rope CXX)\nfind_package(crosscheck 1.0 REQUIRED)\n"
             "add_executable(rope example.cpp)\ntarget_link_libraries(rope PRIVATE crosscheck::mysim)\n"
             "add_executable(engine example_engine.cpp)\ntarget_link_libraries(engine PRIVATE crosscheck::protocol)\n");
  for (const char* file : {"example.cpp", "example_engine.cpp"})
    fs::copy_file(prefix() / "share/doc/crosscheck/examples" / file, work() / "rope" / file);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{CROSSCHECK_CMAKE, "-S", "rope", "-B", "rope/build", "-G", "Ninja",
                                 "-DCMAKE_PREFIX_PATH=" + prefix().string()},
        {CROSSCHECK_CMAKE, "--build", "rope/build"}}) {
    const ProgramResult end = run_program(words, work());
    ASSERT_EQ(end.status, 0) << end.out << end.err;
  }
  const ProgramResult rope = run_program({"rope/build/rope"}, work());
  EXPECT_EQ(rope.status, 0) << rope.err;
  EXPECT_TRUE(rope.out.starts_with("ok after ")) << rope.out;
  // A shallow rope under the weight W = 0.883 N of nine particles is a parabola of depth d. Its tension is W L / (8 d),
  // and it is longer than L = 1 m by 8 d^2 / (3 L). For springs with E A = k l = 10 N it follows that d^3 = 3 W L^3 /
  // (64 E A). The slopes that this neglects, and the ten straight pieces, change the length by (4 d / L)^2 / 6, or 7 %.
  double depth = 0, lost = 0;
  ASSERT_EQ(std::sscanf(rope.out.c_str(), "ok after %*d steps of %*g s: it hangs %lf m deep and has lost %lf J", &depth,
                        &lost),
            2)
      << rope.out;
  EXPECT_NEAR(depth, std::cbrt(3 * 0.883 / 640), 0.1 * depth);
  EXPECT_GT(lost, 0);
}

TEST_F(Installed, ManualAndCompletionsKnowAllOfHelp) {
  const std::string page = run_program({"zcat", (prefix() / "share/man/man1/crosscheck.1.gz").string()}, work()).out;
  const fs::path completions = prefix() / "share/bash-completion/completions/crosscheck";
  const auto completed = [&](const std::string& line) {
    std::string words = "crosscheck";
    for (const std::string& word : split(line, ' ')) words += " '" + word + "'";
    const ProgramResult end = run_program(
        {"bash", "-c",
         "PATH=" + (prefix() / "bin").string() + ":$PATH; source '" + completions.string() + "'; COMP_WORDS=(" + words +
             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _crosscheck; printf '%s\\n' \"${COMPREPLY[@]}\""},
        work());
    EXPECT_EQ(end.err, "");
    const auto lines = split(end.out, '\n');
    return std::set<std::string>(lines.begin(), lines.end());
  };
  const std::set<std::string> commands = completed("");
  int options = 0;
  for (const std::string& command : commands) {
    if (command.empty() || command.starts_with("-")) continue;
    EXPECT_TRUE(contains(page, "\n.SS " + command + "\n")) << command;
    // check each line of --help that starts with an option
    const ProgramResult help = run_program({program().string(), command, "--help"}, work());
    EXPECT_EQ(help.status, 0) << command;
    const std::set<std::string> known = completed(command + " --");
    for (const std::string& line : split(help.out, '\n')) {
      const auto at = line.find("--");
      if (at == std::string::npos || line.find_first_not_of(' ') > 6 || line[line.find_first_not_of(' ')] != '-')
        continue;
      const std::string option = line.substr(at, line.find_first_of(" ,", at) - at);
      ++options;
      EXPECT_TRUE(known.contains(option)) << command << " " << option;
      std::string in_page;
      for (const char c : option) in_page += c == '-' ? std::string("\\-") : std::string(1, c);
      EXPECT_TRUE(option == "--help" || contains(page, in_page)) << command << " " << option;
    }
  }
  EXPECT_GT(options, 80);
  EXPECT_TRUE(commands.contains("compare"));
  EXPECT_FALSE(commands.contains("manual"));
  EXPECT_TRUE(completed("run cloth-h").contains("cloth-hang"));
  EXPECT_TRUE(completed("run chain --method mysim/leap").contains("mysim/leapfrog"));
  EXPECT_TRUE(completed("grade a1").contains("a1-steppers"));
}

}  // namespace
}  // namespace crosscheck::testing_tools
