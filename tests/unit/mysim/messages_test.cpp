// Suggestions for misspelt words, progress lines, system error messages, words quoted for a shell, and bytes as text.

#include <gtest/gtest.h>

#include <filesystem>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "mysim/base/process.h"
#include "mysim/base/progress.h"
#include "mysim/base/text.h"
#include "mysim/base/this_process.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(ClosestMatch, IsProposedForSlipsAndForNothingElse) {
  const std::vector<std::string> names{"duration",         "samples", "step",      "stiffness",
                                       "symplectic-euler", "rk4",     "mysim/xpbd"};
  struct Row {
    const char *word, *nearest;
  };
  constexpr Row table[] = {{"duratoin", "duration"},
                           {"Duration", "duration"},
                           {"stifness", "stiffness"},
                           {"sample", "samples"},
                           {"rk5", "rk4"},
                           {"symplectic_euler", "symplectic-euler"},
                           {"euler", "symplectic-euler"},
                           {"xpbd", "mysim/xpbd"},
                           {"time_step", "step"},
                           {"symplexity", "symplectic-euler"},
                           {"stiffness_structural", "stiffness"},
                           {"colour", ""},
                           {"x", ""},
                           {"", ""},
                           {"quite another thing", ""}};
  for (const Row& row : table) EXPECT_EQ(closest_match(row.word, names), row.nearest) << row.word;
  EXPECT_EQ(did_you_mean("stpe", names), "; did you mean 'step'?");
  EXPECT_EQ(did_you_mean("colour", names), "");
}

TEST(UnknownName, NamesTheNearestFirstInAtMost200Bytes) {
  const std::vector<std::string> names{"cloth-hang", "chain"};
  EXPECT_EQ(unknown_name("scene", "chian", names, "list"),
            "unknown scene 'chian'; did you mean 'chain'? (`list` shows all)");
  EXPECT_EQ(unknown_name("scene", "", names, "list"), "unknown scene ''; `list` shows all");
  std::string umlauts;  // two bytes each, so that every other length cuts inside a character
  for (int i = 0; i < 300; ++i) {
    for (const std::string& word : {std::string(i, 'x'), umlauts, "c" + umlauts, "chain" + umlauts}) {
      const std::string message = unknown_name("assignment", word, names, "crosscheck list assignments");
      EXPECT_LE(message.size(), 200u);
      for (size_t at = 0; at < message.size(); at += utf8_length(message, at)) ASSERT_GT(utf8_length(message, at), 0u);
    }
    umlauts += "\u00fc";
  }
}

TEST(ProgressLine, TellsNumberPartAndWhatIsLeft) {
  // a single step, a quarter done after 10 s
  EXPECT_EQ(progress_line({1, 1, 0.25, 10, 0, 10, "a run"}), "a run (25 %, 10 s, about 30 s left)");
  // three of four started, two of them finished: half done
  EXPECT_EQ(progress_line({3, 4, 0, 600, 0, 1, "x"}), "[3/4] x (10 min, about 10 min left)");
  // if nothing is done yet, uses the expected duration
  EXPECT_EQ(progress_line({1, 1, 0, 5, 65, 5, "x"}), "x (5 s, about 60 s left)");
  // the number of runs is unknown
  EXPECT_EQ(progress_line({5, 0, 0.5, 50, 0, 20, "x"}), "[5] x (50 %, 50 s, about 20 s left of this run)");
  EXPECT_EQ(progress_line({1, 0, 0, 50, 0, 50, "x"}), "x (50 s)");
  EXPECT_EQ(format_duration(3.2e9), "1e+02 years");
}

TEST(ErrorMessages, TheSystemsOwnWordsBecomeALineThatNamesThePath) {
  namespace fs = std::filesystem;
  const auto caught_message = [](auto thrower) {
    try {
      thrower();
    } catch (...) {
      return in_words(std::current_exception());
    }
    return std::string();
  };
  const std::string missing = caught_message([] { fs::create_directory("/proc/none/x"); });
  EXPECT_TRUE(begins(missing, "/proc/none/x: "));
  EXPECT_EQ(missing.find("filesystem error"), std::string::npos);
  const std::string full = caught_message(
      [] { throw fs::filesystem_error("cannot copy", "a", "b", std::make_error_code(std::errc::no_space_on_device)); });
  EXPECT_TRUE(contains(full, "a -> b: "));
  EXPECT_TRUE(contains(full, "expected more free space on the disk"));
  EXPECT_TRUE(contains(caught_message([] { throw std::bad_alloc(); }), "not enough memory"));
  EXPECT_EQ(caught_message([] { throw std::runtime_error("[json.exception.out_of_range.403] key 'x' not found"); }),
            "a JSON file has unexpected content: key 'x' not found");
  EXPECT_EQ(caught_message([] { throw InputError("f:3: x"); }), "f:3: x");
  EXPECT_EQ(run_reporting_errors("test", [] { return 1; }), 1);
  EXPECT_EQ(run_reporting_errors("test", []() -> int { throw std::runtime_error("a tool is missing"); }), 2);
}

TEST(FreeDiskSpace, IsThereAndIsReported) {
  EXPECT_GT(free_memory(), 1e6);
  EXPECT_GT(free_disk("not/there/yet"), 0);
  EXPECT_EQ(format_bytes(3.21e9), "3.21 GB");
  EXPECT_EQ(format_bytes(12), "12 B");
}

TEST(ShellWords, ComeBackFromAShellAndStandOnOneLine) {
  for (const std::string word : {"plain",
                                 "a/b-c_d.toml",
                                 "",
                                 " ",
                                 "two words",
                                 "it's",
                                 "\"quoted\"",
                                 "$HOME",
                                 "`date`",
                                 "a;b",
                                 "*",
                                 "line\nfeed",
                                 "tab\tand\rreturn",
                                 "back\\slash\n'",
                                 "\x01"
                                 "7",
                                 "\xff\xfe"
                                 "a",
                                 "größer",
                                 "größer\n",
                                 "#x",
                                 "~",
                                 "a&b",
                                 "!x"}) {
    const std::string line = shell_quote(word);
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(run_program({"bash", "-c", "printf %s " + line}, ".").out, word) << line;
  }
  const std::string words[] = {"crosscheck", "run", "my scene.toml"};
  EXPECT_EQ(shell_join(words), "crosscheck run 'my scene.toml'");
}

TEST(Base64, IsThatOfTheStandard) {
  // RFC 4648, section 10
  const char* const rows[][2] = {{"", ""},
                                 {"f", "Zg=="},
                                 {"fo", "Zm8="},
                                 {"foo", "Zm9v"},
                                 {"foob", "Zm9vYg=="},
                                 {"fooba", "Zm9vYmE="},
                                 {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : rows) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64(std::string("\xff\0\xfe", 3)), "/wD+");
}

}  // namespace
}  // namespace crosscheck
