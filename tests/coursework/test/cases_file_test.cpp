// The public tests as a file: to the last bit, and with the line that is wrong.
#include "tests/coursework/check/cases_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace coursework {
namespace {

TEST(CasesFile, ReadsBackWhatWasWritten) {
  const double inf = std::numeric_limits<double>::infinity();
  Case c{"part.call", {0.1, -1e-310, 1e300, inf}, {1.0 / 3, 2, 3, 4}, 2, 1e-9, "step", "state", 0, 1, 0.25};
  PublicTests all{
      "a0", "A title of words", 7, {{"1.1", "part", "A heading, too", 3, {c, c}}, {"1.2", "part", "h", 2, {}}}};
  all.tests[0].cases[1].in.clear();
  std::stringstream file;
  write_cases(file, all);
  const PublicTests back = read_cases(file);
  EXPECT_EQ(back.assignment, "a0");
  EXPECT_EQ(back.title, all.title);
  EXPECT_EQ(back.hidden, 7);
  ASSERT_EQ(back.tests.size(), 2u);
  EXPECT_EQ(back.tests[0].read, "A heading, too");
  EXPECT_EQ(back.tests[0].points, 3);
  ASSERT_EQ(back.tests[0].cases.size(), 2u);
  const Case& d = back.tests[0].cases[0];
  EXPECT_EQ(d.in, c.in);  // to the last bit
  EXPECT_EQ(d.expected, c.expected);
  EXPECT_EQ(std::tie(d.call, d.columns, d.tolerance, d.row, d.column, d.plot_x, d.plot_y, d.row_size),
            std::tie(c.call, c.columns, c.tolerance, c.row, c.column, c.plot_x, c.plot_y, c.row_size));
  EXPECT_TRUE(back.tests[0].cases[1].in.empty());
}

TEST(CasesFile, SaysWhichLineIsWrong) {
  const std::string test = "test 1.1 p 3\ncase p.c\n";
  const std::pair<std::string, std::string> wrong[] = {
      {"", "public cases: there are no tests"},
      {"case p.c\n", "public cases, line 1: 'case' is not known here"},
      {"test 1.1 p\n", "public cases, line 1: something is missing"},
      {"test 1.1 p 2.5\n", "public cases, line 1: no whole number"},
      {test + "in 2 1\n", "public cases, line 3: something is missing"},
      {test + "in 1 1x\n", "public cases, line 3: '1x' is no number"},
      {test + "in -1\n", "public cases, line 3: a negative count"},
      {test + "colour 3\n", "public cases, line 3: 'colour' is not known here"},
  };
  for (const auto& [text, message] : wrong) {
    std::istringstream in(text);
    try {
      read_cases(in);
      FAIL() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), message);
    }
  }
}

}  // namespace
}  // namespace coursework
