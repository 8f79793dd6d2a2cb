// The page of recipes is true: its commands are run in one folder, one after the other, and print what it shows.

#include <fmt/format.h>

#include <regex>

#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/report/cli.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

constexpr auto dots = "…";

/// Whether the line is as it is shown, where dots stand for anything.
bool is_shown(const std::string& line, const std::string& shown) {
  std::string pattern;
  for (size_t i = 0; i < shown.size(); ++i) {
    if (shown.compare(i, 3, dots) == 0)
      pattern += ".*", i += 2;
    else
      pattern += (std::isalnum(static_cast<unsigned char>(shown[i])) || (shown[i] & 0x80) ? "" : "\\") +
                 std::string(1, shown[i]);
  }
  return std::regex_match(line, std::regex(pattern));
}

/// The first line shown that the output lacks, in this order; empty where it has all. A line of dots stands for any
/// number of lines, and without one the next line must follow.
std::string lacking(const std::vector<std::string>& output, const std::vector<std::string>& shown) {
  size_t at = 0;
  bool any = false;
  for (const std::string& line : shown) {
    if (line == dots) {
      any = true;
      continue;
    }
    const size_t from = at;
    while (at < output.size() && any && !is_shown(output[at], line)) ++at;
    if (at == output.size() || !is_shown(output[at], line))
      return fmt::format("'{}' instead of '{}'", from < output.size() ? output[from] : "nothing", line);
    ++at, any = false;
  }
  return any || at == output.size() ? "" : "more: " + output[at];
}

TEST(Recipes, DotsStandForAnything) {
  EXPECT_TRUE(is_shown("in 0.2 s (all)", "in … s (all)"));
  EXPECT_FALSE(is_shown("in 0.2 m (all)", "in … s (all)"));
  EXPECT_EQ(lacking({"a", "b", "c"}, {"a", dots}), "");
  EXPECT_EQ(lacking({"a", "b", "c"}, {dots, "b", "c"}), "");
  EXPECT_EQ(lacking({"a", "b", "c"}, {"a", "c"}), "'b' instead of 'c'");
  EXPECT_EQ(lacking({"a", "b", "c"}, {"a", "b"}), "more: c");
}

class RecipesCli : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_symlink(CROSSCHECK_PROGRAM, folder_ / "crosscheck");
    fs::create_symlink(CROSSCHECK_SOURCE "/reference", folder_ / "reference");
    page_ = read(CROSSCHECK_SOURCE "/report/recipes.md");
    const size_t scene = page_.find("```toml\n") + 8;
    write("two.toml", page_.substr(scene, page_.find("```", scene) - scene));
  }
  std::string page_;
};

TEST_F(RecipesCli, CommandsPrintWhatIsShown) {
  if (run_program({"/usr/bin/python3", "-c", "import numpy"}, "/").status != 0)
    GTEST_SKIP() << "package python3-numpy is not installed: the recipes are not tried";
  // the example's first line asks for any python3; Debian's is the one with Debian's numpy
  fs::create_symlink("/usr/bin/python3", folder_ / "python3");
  const std::vector<std::string> environment{"ASAN_OPTIONS=detect_leaks=0",
                                             "CROSSCHECK_LOCK=" + folder_.string() + ".lock",
                                             "PATH=" + folder_.string() + ":" + std::getenv("PATH")};
  int commands = 0;
  const std::vector<std::string> lines = lines_of(page_);
  bool console = false;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with("```")) console = lines[i] == "```console";
    if (!console || !lines[i].starts_with("$ ")) continue;
    std::vector<std::string> shown;
    for (size_t j = i + 1; !lines[j].starts_with("```") && !lines[j].starts_with("$ "); ++j) shown.push_back(lines[j]);
    SCOPED_TRACE(lines[i]);
    const ProgramResult end = run_program({"bash", "-c", lines[i].substr(2)}, folder_, environment);
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_EQ(lacking(lines_of(end.out), shown), "") << end.out;
    ++commands;
  }
  EXPECT_GE(commands, 14);
}

TEST_F(RecipesCli, PythonPrintsWhatIsShown) {
  if (run_program({"/usr/bin/python3", "-c", "import numpy"}, "/").status != 0)
    GTEST_SKIP() << "package python3-numpy is not installed: the recipes in Python are not tried";
  ASSERT_EQ(call({"run", "chain", "--method", "rk4"}).status, 0);
  ASSERT_EQ(call({"experiment", "order", "spring", "--methods", "rk4,leapfrog"}).status, 0);
  write("recipes.md", page_);
  const ProgramResult tried =
      run_program({"/usr/bin/python3", "-m", "doctest", "recipes.md"}, folder_,
                  {"CROSSCHECK=" CROSSCHECK_PROGRAM, "PYTHONPATH=" CROSSCHECK_SOURCE "/report/python",
                   "PYTHONDONTWRITEBYTECODE=1", "TMPDIR=" + folder_.string()});
  EXPECT_EQ(tried.status, 0) << tried.out << tried.err;
}

}  // namespace
}  // namespace crosscheck
