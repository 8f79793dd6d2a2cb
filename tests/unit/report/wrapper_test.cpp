// Tests the wrapper at the root of the tree: confirmation before installations, and location of the build. Scripts that
// record their arguments replace apt-get, cmake and ninja.

#include <unistd.h>

#include <set>

#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

class Wrapper : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directories(folder_ / "tree");
    fs::create_directories(folder_ / "bin");
    fs::create_directories(folder_ / "home");
    fs::permissions(folder_ / "home", fs::perms::all);
    fs::copy_file(std::string(CROSSCHECK_SOURCE) + "/crosscheck", folder_ / "tree/crosscheck");
    script("bin/dpkg-query", "[ -e \"$STUBS/missing\" ] || exec sed 's/$/ installed/' \"$STUBS/packages\"");
    script("bin/apt-get", "echo \"apt-get $*\" >>\"$STUBS/log\"");
    script("bin/apt-cache", "[ ! -e \"$STUBS/unknown\" ] || ! grep -qxF -- \"$2\" \"$STUBS/unknown\"");
    script(
        "bin/cmake",
        "for word; do case $word in -B) b=1;; *) [ -z \"$b\" ] || { mkdir -p \"$word\"; touch \"$word/build.ninja\"; "
        "b=; };; esac; done\n"
        "[ \"$1\" != --build ] || { echo '#!/bin/sh\necho \"$0 $*\"' >\"$2/crosscheck\"; chmod +x \"$2/crosscheck\"; "
        "}");
    script("bin/ninja", "[ -x \"$2/crosscheck\" ] && echo 'ninja: no work to do.'; true");
    std::string packages, text = read(folder_ / "tree/crosscheck");
    for (size_t at = 0; (at = text.find("\n  \"", at)) != std::string::npos; ++at)
      packages += text.substr(at + 4, text.find(':', at) - at - 4) + "\n";
    write("packages", packages);
    if (geteuid() == 0) {  // give other users access
      fs::permissions(folder_, fs::perms::owner_all | fs::perms::group_all | fs::perms::others_all);
      for (const auto& entry : fs::recursive_directory_iterator(folder_ / "tree"))
        fs::permissions(entry, fs::perms::others_read | fs::perms::others_exec, fs::perm_options::add);
    }
  }
  void script(const std::string& name, const std::string& text) const {
    fs::permissions(write(name, "#!/bin/sh\n" + text + "\n"), fs::perms(0755));
  }
  void build() const {
    fs::create_directories(folder_ / "tree/build/release");
    write("tree/build/release/build.ninja", "");
    script("tree/build/release/crosscheck", "echo \"$0 $*\"");
  }
  ProgramResult start(std::vector<std::string> words, const std::string& ci = "") const {
    return run_program(
        words, folder_,
        {"CI=" + ci, "HOME=" + (folder_ / "home").string(), "XDG_CACHE_HOME=", "STUBS=" + folder_.string(),
         "PATH=" + (folder_ / "bin").string() + ":/usr/bin:/bin:/usr/sbin"});
  }
  /// Starts a command as a user without write permission for the tree.
  ProgramResult start_as_other(std::vector<std::string> words) const {
    const std::vector<std::string> as{"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
    words.insert(words.begin(), as.begin(), as.end());
    return start(words);
  }
  std::string in_tree(const std::string& name) const { return (folder_ / "tree" / name).string(); }
  std::string log() const { return fs::exists(folder_ / "log") ? read(folder_ / "log") : ""; }
};

TEST_F(Wrapper, InstallsNothingUnasked) {
  write("missing", "");
  build();
  const ProgramResult result = start({in_tree("crosscheck"), "list"});
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("--yes installs them"), std::string::npos) << result.err;
  EXPECT_EQ(log().find("install -y"), std::string::npos) << log();
}

TEST_F(Wrapper, InstallsWithYesAndInContinuousIntegration) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who needs sudo to install";
  write("missing", "");
  build();
  start({in_tree("crosscheck"), "list", "--yes"});
  EXPECT_NE(log().find("apt-get install -y"), std::string::npos) << log();
  fs::remove(folder_ / "log");
  start({in_tree("crosscheck"), "list"}, "1");
  EXPECT_NE(log().find("apt-get install -y"), std::string::npos) << log();
}

TEST_F(Wrapper, InstallsEglWhereThereIsNoOsmesa) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who needs sudo to install";
  write("missing", "");
  write("unknown", "libosmesa6-dev\nlibclang-rt-dev-wasm32\n");
  build();
  const ProgramResult result = start({in_tree("crosscheck"), "report", "--yes"});
  const std::string told = log();
  EXPECT_EQ(told.find("libosmesa6-dev"), std::string::npos) << told;
  EXPECT_NE(told.find(" libegl-dev libgl-dev libegl-mesa0 libgl1-mesa-dri "), std::string::npos) << told;
  EXPECT_NE(told.find(" lld libc++-dev-wasm32 binaryen"), std::string::npos) << told;
  EXPECT_EQ(told.find("libclang-rt-dev-wasm32"), std::string::npos) << told;
}

TEST_F(Wrapper, LeavesOutTheLabWhereAsked) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who needs sudo to install";
  write("missing", "");
  build();
  write("tree/build/release/lab.wasm", "");
  start({in_tree("crosscheck"), "report", "--yes", "--no-lab"});
  EXPECT_NE(log().find(" fonts-dejavu-core\n"), std::string::npos) << log();
  EXPECT_FALSE(fs::exists(folder_ / "tree/build/release/lab.wasm")) << "otherwise the page would contain a lab";
}

TEST_F(Wrapper, RunsThroughASymbolicLink) {
  build();
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("../tree/crosscheck", folder_ / "elsewhere/crosscheck");
  fs::create_symlink(folder_ / "elsewhere/crosscheck", folder_ / "cc");
  const ProgramResult result = start({(folder_ / "cc").string(), "list", "scenes"});
  EXPECT_EQ(result.out, in_tree("build/release/crosscheck") + " list scenes\n") << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "build"));
}

TEST_F(Wrapper, UsesTheBuildOfATreeThatItMayNotWriteTo) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who cannot become another";
  build();
  write("missing", "");  // only the tree's owner could install missing packages
  const ProgramResult result = start_as_other({in_tree("crosscheck"), "list", "scenes"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, in_tree("build/release/crosscheck") + " list scenes\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(log(), "");
}

TEST_F(Wrapper, BuildsInTheCacheForATreeThatItMayNotWriteTo) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who cannot become another";
  const ProgramResult first = start_as_other({in_tree("crosscheck"), "list", "scenes"});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out.find((folder_ / "home/.cache/crosscheck/build").string()), std::string::npos) << first.out;
  EXPECT_NE(first.err.find("cannot be written to: building in "), std::string::npos) << first.err;
  EXPECT_FALSE(fs::exists(folder_ / "tree/build"));
  const ProgramResult second = start_as_other({in_tree("crosscheck"), "list", "scenes"});
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(second.err, "") << "the message must appear only once";
}

TEST_F(Wrapper, NamesACacheFolderThatCannotBeMade) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who cannot become another";
  fs::permissions(folder_ / "home", fs::perms(0555));
  const ProgramResult closed = start_as_other({in_tree("crosscheck"), "list"});
  EXPECT_EQ(closed.status, 2);
  EXPECT_NE(closed.err.find("release cannot be created; expected HOME or XDG_CACHE_HOME"), std::string::npos)
      << closed.err;
  const ProgramResult none = start_as_other({"env", "-u", "HOME", in_tree("crosscheck"), "list"});
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(none.err.starts_with("crosscheck: ")) << none.err;
  EXPECT_NE(none.err.find("neither HOME nor XDG_CACHE_HOME is set"), std::string::npos) << none.err;
}

TEST_F(Wrapper, BuildsTreesOfSimilarPathsApart) {
  if (geteuid() != 0) GTEST_SKIP() << "this machine runs tests as a user who cannot become another";
  std::set<std::string> programs;
  for (const char* tree : {"tree/a-b", "tree/a/b"}) {
    fs::create_directories(folder_ / tree);
    fs::copy_file(in_tree("crosscheck"), folder_ / tree / "crosscheck");
    const ProgramResult result = start_as_other({(folder_ / tree / "crosscheck").string(), "list"});
    EXPECT_EQ(result.status, 0) << result.err;
    programs.insert(result.out);
  }
  EXPECT_EQ(programs.size(), 2u);
}

}  // namespace
}  // namespace crosscheck
