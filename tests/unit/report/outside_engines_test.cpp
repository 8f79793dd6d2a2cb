// Tests external engines on the command line: conformance, reasons of failures, interrupts.

#include <fmt/format.h>

#include <filesystem>

#include "mysim/base/json.h"
#include "tests/unit/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class OutsideEngines : public Cli {
 protected:
  std::string script(const std::string& name, const std::string& text) const {
    const fs::path file = write(name, "#!/bin/sh\n" + text);
    fs::permissions(file, fs::perms::owner_all);
    return "exec:" + file.string();
  }
};

TEST_F(OutsideEngines, TheKitSaysLineByLineWhatLacks) {
  const ProgramResult good = call({"check", "--protocol", "exec:" CROSSCHECK_EXAMPLE});
  EXPECT_EQ(good.status, 0) << good.out << good.err;
  EXPECT_TRUE(contains(good.out, "ok       fall           first frame"));
  EXPECT_TRUE(contains(good.out, fmt::format("refuses  {:<14} {:<38} {}", "rod", "starts and ends",
                                             "this engine has no constraints\n")));
  EXPECT_TRUE(contains(good.out, " 0 lacking, of which 0 required, 7 refused"));

  const std::string dumb = script("dumb", CROSSCHECK_EXAMPLE " \"$1\" \"$2\" || exit $?\nrm \"$2/velocities.npy\"\n");
  const ProgramResult optional = call({"check", "--protocol", dumb});
  EXPECT_EQ(optional.status, 0) << "velocities are not required";
  EXPECT_TRUE(contains(optional.out, fmt::format("lacks    {:<14} {:<38} {}", "fall", "velocities",
                                                 "write velocities.npy too: without it there are no energies "
                                                 "[PROTOCOL.md, What it answers]\n")));

  const ProgramResult none = call({"check", "--json", "--protocol", script("none", "exit 7\n")});
  EXPECT_EQ(none.status, 1);
  const JsonField json = JsonField::parse(none.out, "check");
  EXPECT_EQ(json["format"].whole(), 1);
  EXPECT_FALSE(json["complete"].boolean());
  EXPECT_EQ(json["lines"][0]["state"].text(), "lacks");
  EXPECT_TRUE(json["lines"][0]["required"].boolean());
  EXPECT_EQ(json["lines"][0]["section"].text(), "What it answers");

  EXPECT_EQ(call({"check", "--protocol", "exec:./nobody"}).status, 2);
}

TEST_F(OutsideEngines, CompareGivesEachReasonAndFailsWhereAllFail) {
  const std::string crash = script("crash", "echo no licence >&2\nexit 7\n"),
                    solver = script("solver", CROSSCHECK_EXAMPLE
                                    " \"$1\" \"$2\"\necho '{\"verdict\": \"solver\", "
                                    "\"reason\": \"no root was found\"}' > \"$2/run.json\"\n");
  const ProgramResult all = call({"compare", "spring", "--methods", crash + "," + solver});
  EXPECT_EQ(all.status, 1);
  EXPECT_TRUE(contains(all.out, "    the program ended with exit status 7; last line of its stderr: no licence\n"));
  EXPECT_TRUE(contains(all.out, "    no root was found\n"));
  EXPECT_TRUE(contains(all.out, "no method has a result"));
  const ProgramResult one = call({"compare", "spring", "--methods", "leapfrog," + solver, "--out", "one"});
  EXPECT_EQ(one.status, 0);
  EXPECT_TRUE(contains(one.out, "    no root was found\n"));
  EXPECT_FALSE(contains(one.out, "no method has a result"));
}

TEST_F(OutsideEngines, AnInterruptLeavesNoFolderAndNoProcess) {
  for (const char* signal : {"INT", "TERM"}) {
    SCOPED_TRACE(signal);
    const fs::path temporary = folder_ / signal, beats = folder_ / (std::string(signal) + "-beats");
    fs::create_directories(temporary);
    const std::string engine = script(std::string("beating-") + signal, "trap '' INT TERM\nwhile :; do echo >> '" +
                                                                            beats.string() + "'; sleep 0.02; done\n");
    // Signals only the program, as kill would. Restores the default handlers, because shells ignore INT in background
    // processes, and this test's parent may ignore it, too.
    const std::string shell = "set -m\nenv --default-signal=INT,TERM \"$0\" \"$@\" &\nuntil [ -s '" + beats.string() +
                              "' ]; do sleep 0.01; done\nkill -" + signal + " $!\nwait $!\n";
    const ProgramResult ended =
        run_program({"bash", "-c", shell, CROSSCHECK_PROGRAM, "run", "spring", "--method", engine, "--out", "out"},
                    folder_, {"TMPDIR=" + temporary.string(), "ASAN_OPTIONS=detect_leaks=0"});
    EXPECT_NE(ended.status, 0);
    ASSERT_TRUE(fs::exists(beats)) << "the engine must have started: " << ended.err;
    // the program may still clean up after the processes are killed
    const auto left = [&] { return std::distance(fs::directory_iterator(temporary), fs::directory_iterator()); };
    for (int tries = 0; tries < 100 && left() > 0; ++tries) usleep(50000);
    EXPECT_EQ(left(), 0);
    const auto size = fs::file_size(beats);
    usleep(100000);
    EXPECT_EQ(fs::file_size(beats), size);
  }
}

TEST_F(OutsideEngines, JoltNamesThePackageThatItsToolsAreMissingFrom) {
  struct Row {
    std::vector<std::string> tools;  // the only programs in PATH; each fails
    std::string said;
  };
  for (const Row& row :
       {Row{{}, "node is missing; package nodejs is not installed"},
        {{"node"}, "npm is missing; package npm is not installed"},
        {{"node", "npm"}, "esbuild is missing; package esbuild is not installed"},
        {{"node", "npm", "esbuild"}, "engine jolt: npm failed; the last lines of its output:\nno registry\n"}}) {
    fs::create_directories(folder_ / "bin");
    for (const std::string& tool : row.tools) script("bin/" + tool, "echo no registry >&2\nexit 1\n");
    const ProgramResult result = run_program({CROSSCHECK_PROGRAM, "engine", "jolt", "-o", "jolt"}, folder_,
                                             {"PATH=" + (folder_ / "bin").string(), "ASAN_OPTIONS=detect_leaks=0"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, row.said));
    EXPECT_FALSE(fs::exists(folder_ / "jolt"));
  }
}

TEST_F(OutsideEngines, PackagesOfNpmArePinnedWithAChecksum) {
  const fs::path engines = fs::path(CROSSCHECK_SOURCE) / "reference/engines";
  int packages = 0;
  for (const fs::directory_entry& folder : fs::directory_iterator(engines / "npm")) {
    const std::string engine = folder.path().filename().string();
    SCOPED_TRACE(engine);
    const JsonField wanted = JsonField::parse(read(folder.path() / "package.json"), "package.json")["dependencies"];
    const JsonField lock = JsonField::parse(read(folder.path() / "package-lock.json"), "package-lock.json")["packages"];
    for (const auto& [name, version] : wanted.items()) {
      const JsonField locked = lock["node_modules/" + name];
      EXPECT_EQ(locked["version"].text(), version.text());
      EXPECT_TRUE(begins(locked["integrity"].text(), "sha512-"));
      EXPECT_TRUE(contains(read(engines / (engine + ".mjs")), " " + version.text() + "',")) << "the adapter's version";
      ++packages;
    }
  }
  EXPECT_EQ(packages, 4);
}

}  // namespace
}  // namespace crosscheck
