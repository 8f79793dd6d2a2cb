// The documentation's commands, run one after the other in an empty folder, print the output that it shows.
// With CROSSCHECK_INSTALLED=/usr, the installed pages, program and Python package are tested.

#include <fmt/format.h>

#include <regex>

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

/// True if the line is as shown. Dots in `shown` stand for any text.
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

/// Returns the first shown line that is missing in the output, or "". A line of dots stands for any number of lines;
/// without it, shown lines must follow each other directly.
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

struct TypedCommand {
  std::string command;
  std::vector<std::string> shown;
};

/// Commands that readers are meant to type: lines after "$ " in ```console blocks, and whole ```sh blocks with the
/// ```text block that follows. A block that starts with "# takes" states its duration and is not run. The section "Ten
/// minutes" is ignored.
std::vector<TypedCommand> steps_of(const std::string& page) {
  const size_t path = page.find("\n## Ten minutes");
  const size_t end = path == std::string::npos ? path : page.find("\n## ", path + 1);
  std::vector<TypedCommand> steps;
  std::string kind;
  bool slow = false;
  for (const std::string& line : lines_of(page.substr(0, end))) {
    if (line.starts_with("```")) {
      if (line != "```" && line != "```text") slow = false;
      kind = line.substr(3);
      if (kind == "sh") steps.emplace_back();
    } else if (kind == "sh") {
      if (steps.back().command.empty() && line.starts_with("# takes")) {
        std::printf("not tried: %s\n", line.c_str());
        slow = true;
      }
      steps.back().command += line + "\n";
      if (slow) steps.back().command = "# takes";
    } else if (kind == "console" && line.starts_with("$ ")) {
      steps.push_back({line.substr(2), {}});
    } else if ((kind == "console" || kind == "text") && !steps.empty()) {
      steps.back().shown.push_back(line);
    }
  }
  std::erase_if(steps, [](const TypedCommand& step) { return step.command.starts_with("# takes"); });
  return steps;
}

TEST(Recipes, StepsAreWhatAReaderTypes) {
  const auto steps = steps_of(
      "```console\n$ a\nis\n$ b\n```\n## Ten minutes\n```sh\nc\nd\n```\n```text\nis\n```\n```sh\n# takes long\ne\n```\n"
      "```text\nnothing\n```\n```toml\nf\n```\n## Next\n```sh\ng\n```\n");
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps[0].command, "a");
  EXPECT_EQ(steps[0].shown, std::vector<std::string>{"is"});
  EXPECT_EQ(steps[2].command, "c\nd\n");
  EXPECT_EQ(steps[2].shown, std::vector<std::string>{"is"});
}

struct Document {
  const char *name, *file;
  size_t least;  ///< minimum number of commands
};

/// Gives tests their names in ctest.
void PrintTo(const Document& document, std::ostream* out) { *out << document.name; }

class Documents : public Cli, public testing::WithParamInterface<Document> {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("crosscheck-" + std::string(GetParam().name) + std::to_string(getpid()));
    programs_ = folder_.string() + "-programs";
    fs::create_directories(folder_);
    fs::create_directories(programs_);
    fs::create_symlink(program_, programs_ / "crosscheck");
    // use Debian's python3, which has NumPy; PATH may contain another one
    fs::create_symlink("/usr/bin/python3", programs_ / "python3");
  }
  void TearDown() override {
    Cli::TearDown();
    fs::remove_all(programs_);
  }
  static fs::path installation() {
    const char* prefix = std::getenv("CROSSCHECK_INSTALLED");
    return prefix ? prefix : "";
  }
  fs::path programs_;
  const fs::path pages_ = installation().empty() ? CROSSCHECK_SOURCE : installation() / "share/doc/crosscheck";
  const fs::path program_ = installation().empty() ? CROSSCHECK_PROGRAM : installation() / "bin/crosscheck";
};

// Commands find the program and the package as in an installation.
TEST_P(Documents, CommandsPrintWhatIsShown) {
  if (run_program({"/usr/bin/python3", "-c", "import numpy"}, "/").status != 0)
    GTEST_SKIP() << "package python3-numpy is not installed: the commands of " << GetParam().file << " are not tested";
  const std::string page = read(pages_ / GetParam().file);
  std::vector<std::string> environment{"ASAN_OPTIONS=detect_leaks=0", "CROSSCHECK_LOCK=" + folder_.string() + ".lock",
                                       "PYTHONDONTWRITEBYTECODE=1",
                                       "PATH=" + programs_.string() + ":" + std::getenv("PATH")};
  if (installation().empty())
    environment.insert(environment.end(),
                       {"CROSSCHECK=" CROSSCHECK_PROGRAM, "PYTHONPATH=" CROSSCHECK_SOURCE "/report/python"});
  const std::vector<TypedCommand> steps = steps_of(page);
  for (const TypedCommand& step : steps) {
    SCOPED_TRACE(step.command);
    // unset CI, because `--bless` is refused under CI; pages show a nonzero status by `echo $?`
    const ProgramResult end = run_program({"bash", "-c", "unset CI; " + step.command}, folder_, environment);
    if (end.err.find("Nothing here keeps a submission away") != std::string::npos) GTEST_SKIP() << end.err;
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_EQ(lacking(lines_of(end.out), step.shown), "") << end.out << end.err;
  }
  EXPECT_GE(steps.size(), GetParam().least);
  if (page.find("\n>>> ") == std::string::npos) return;
  write("page.md", page);
  const ProgramResult tried = run_program({"/usr/bin/python3", "-m", "doctest", "page.md"}, folder_, environment);
  EXPECT_EQ(tried.status, 0) << tried.out << tried.err;
}

INSTANTIATE_TEST_SUITE_P(ForPeople, Documents,
                         testing::Values(Document{"recipes", "report/recipes.md", 10},
                                         Document{"authors", "report/README.md", 4},
                                         Document{"lecturers", "tests/coursework/README.md", 5},
                                         Document{"engines", "reference/README.md", 5},
                                         Document{"scenes", "experiments/README.md", 5}),
                         [](const auto& page) { return std::string(page.param.name); });

}  // namespace
}  // namespace crosscheck
