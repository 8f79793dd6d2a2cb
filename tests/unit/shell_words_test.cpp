// Words that a shell reads back, whatever is in them.
#include "mysim/shell_words.h"

#include <gtest/gtest.h>

#include "report/run_program.h"

namespace crosscheck {
namespace {

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
    const std::string line = shell_word(word);
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(run_program({"bash", "-c", "printf %s " + line}, ".").out, word) << line;
  }
  const std::string words[] = {"crosscheck", "run", "my scene.toml"};
  EXPECT_EQ(shell_line(words), "crosscheck run 'my scene.toml'");
}

}  // namespace
}  // namespace crosscheck
