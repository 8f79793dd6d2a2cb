// Parsers: untrusted answers, compiler output, files of mistakes, texts and public tests.

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/check/cases_file.h"
#include "tests/coursework/check/judge.h"
#include "tests/coursework/check/page.h"
#include "tests/coursework/check/plot.h"
#include "tests/coursework/check/random.h"
#include "tests/coursework/check/words.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/crashes.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/grader/suspects.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {

std::vector<How> hows(const std::string& lines, std::size_t count, End::How how = End::How::exited, int code = 0) {
  std::vector<How> all;
  for (const Answer& answer : answers_of({how, code, lines, ""}, "T", count, {})) all.push_back(answer.how);
  return all;
}

TEST(Answers, AreTakenOnlyWhenAllIsInOrder) {
  using Hows = std::vector<How>;
  const Hows none{How::no_token, How::no_token}, both{How::answered, How::answered};
  const std::string good = "answer 1 0x1p+0\nanswer 2 0x1p+0 nan\ntoken T\n";
  EXPECT_EQ(hows(good, 2), both);
  EXPECT_EQ(answers_of({End::How::exited, 0, good, ""}, "T", 2, {})[0].got, Numbers{1});
  EXPECT_EQ(hows("threw no\nanswer 0\ntoken T\n", 2), (Hows{How::threw, How::answered}));
  EXPECT_EQ(hows("threw std::bad_alloc\nanswer 0\ntoken T\n", 2), (Hows{How::out_of_memory, How::answered}));
  // if a program exits early, its earlier answers are kept, but earn nothing by themselves
  EXPECT_EQ(hows("answer 1 0x1p+0\n", 2), (Hows{How::answered, How::no_token}));
  for (const char* bad :
       {"", "token T\n", "answer 1 0x1p+0\nanswer 1 0x1p+0\n", "answer 1 0x1p+0\nanswer 1 0x1p+0\ntoken X\n",
        "answer 1 0x1p+0\nanswer 1 0x1p+0\nanswer 1 0x1p+0\ntoken T\n", "token T\nanswer 1 0x1p+0\nanswer 1 0x1p+0\n",
        "answer 1 0x1p+0\nanswer 1 0x1p+0\ntoken T\nmore\n", "answer 1 0x1p+0\nanswer 1 0x1p+0\ntoken T\nmore",
        "answer 2 0x1p+0\nanswer 1 0x1p+0\ntoken T\n", "answer 1 0x1p+0 0x1p+0\nanswer 1 0x1p+0\ntoken T\n",
        "answer -1\nanswer 1 0x1p+0\ntoken T\n", "answer 99999999999999999999\nanswer 1 0x1p+0\ntoken T\n",
        "answer 1 one\nanswer 1 0x1p+0\ntoken T\n", "answer\nanswer 1 0x1p+0\ntoken T\n", "answer 1  0x1p+0\nrubbish\n",
        "unknown\nunknown\ntoken T\n", "answer 1 0x1p+0x\nanswer 1 0x1p+0\ntoken T\n"})
    EXPECT_EQ(hows(bad, 2), none) << bad;
  using std::string_literals::operator""s;
  EXPECT_EQ(hows("answer 1 0x1p+0\0\nanswer 1 0x1p+0\ntoken T\n"s, 2), none);
  EXPECT_EQ(hows(good, 2, End::How::exited, 1), none);
}

TEST(Answers, EndsAreClassifiedBeforeTheExitCode) {
  const std::string one = "answer 1 0x1p+0\n", cut = one + "answer 1 0x1", good = one + one + "token T\n";
  const std::pair<End::How, How> table[] = {{End::How::signal, How::crashed},
                                            {End::How::cpu, How::out_of_time},
                                            {End::How::wall, How::waiting},
                                            {End::How::idle, How::waiting},
                                            {End::How::answers, How::too_much_answered},
                                            {End::How::memory, How::out_of_memory},
                                            {End::How::output, How::too_much_output}};
  for (const auto& [end, how] : table) {
    EXPECT_EQ(hows("", 2, end), (std::vector<How>{how, how}));
    for (const std::string& lines : {one, cut, good})
      EXPECT_EQ(hows(lines, 2, end), (std::vector<How>{How::answered, how}));
  }
}

TEST(Answers, LastWordsExplainAnEndAndProveNothing) {
  const auto last = [](const std::string& lines, End::How how, int code) {
    return answers_of({how, code, lines, ""}, "T", 2, {}).back();
  };
  const Answer slow = last("answer 1 0x1p+0\nslow step 3 f 1200\n", End::How::cpu, SIGXCPU);
  EXPECT_EQ(slow.how, How::out_of_time);
  EXPECT_EQ(slow.counts, (std::vector<std::pair<std::string, long>>{{"step", 3}, {"f", 1200}}));
  EXPECT_EQ(last("recursion\n", End::How::signal, SIGSEGV).how, How::recursion);
  // these lines are malformed, or do not fit the way in which the program ended
  EXPECT_TRUE(last("slow <b>step</b> 3\n", End::How::cpu, SIGXCPU).counts.empty());
  EXPECT_TRUE(last("slow step 123456789012345\n", End::How::cpu, SIGXCPU).counts.empty());
  for (const char* word : {"slow step 3\n", "recursion\n"})
    EXPECT_EQ(last(word, End::How::exited, 0).how, How::no_token);
  EXPECT_EQ(last("recursion\n", End::How::signal, SIGABRT).how, How::no_token);
  // messages of the calls that run the student's code
  const Answer unusable = answers_of({End::How::exited, 0, "unusable f_size 3 2\ntoken T\n", ""}, "T", 1, {})[0];
  const Case what;
  EXPECT_EQ(words(common_texts(), common_texts(), what, unusable, judge(what, unusable)),
            "The result of your code cannot be used: f was called with 3 numbers, but the system has 2.");
  const Answer unknown = answers_of({End::How::exited, 0, "unusable secret\ntoken T\n", ""}, "T", 1, {})[0];
  EXPECT_EQ(words(common_texts(), common_texts(), what, unknown, judge(what, unknown)).find("secret"),
            std::string::npos);
}

TEST(Answers, OfAnExceptionOnlyTheStudentsOwnWordsAreShown) {
  const std::map<std::string, std::string> files{{"a.cpp", "throw std::runtime_error(\"no such row: \" + text);"}};
  for (const char* shown : {"no such row: ", "no such row: 17",
                            "vector::_M_range_check: __n (which is 9) >= this->size() "
                            "(which is 8)",
                            "std::exception"})
    EXPECT_EQ(shown_exception(shown, files), shown);
  for (const char* hidden : {"f3 0f 1e fa 48 83 ec 08", "no such row: 1234567", "double k = stiffness / mass",
                             "\x48\x89\xe5", "no such row: 1no such row: 2no such row: 3no such row: 4no such row: 5"})
    EXPECT_EQ(shown_exception(hidden, files), "") << hidden;
}

TEST(Diagnostics, FirstErrorOfTheCompilerInPlainWords) {
  struct Row {
    const char *said, *key;
    std::vector<std::string> with;
  };
  const Row table[] = {
      {"/t/in/rk4.cpp: In function 'int f()':\n/t/in/rk4.cpp:5:3: error: 'y' was not declared in this scope\n",
       "build.compile",
       {"rk4.cpp", "5", "'y' was not declared in this scope"}},
      {"/t/in/rk4.cpp:1:10: fatal error: mine.h: No such file or directory\ncompilation terminated.\n",
       "build.include",
       {"rk4.cpp", "1", "mine.h"}},
      {"In file included from /t/in/rk4.cpp:3:\n/t/in/own.h:8:1: error: 'y' was not declared in this scope\n",
       "build.compile",
       {"own.h", "8", "'y' was not declared in this scope"}},
      {"In file included from /usr/include/c++/12/vector:61,\n                 from /t/in/rk4.cpp:3:\n"
       "/usr/include/c++/12/bits/x.h:9:1: error: static assertion failed\n",
       "build.compile",
       {"rk4.cpp", "3", "static assertion failed"}},
      {"/usr/include/c++/12/bits/x.h:9:1: error: no match\n/t/in/rk4.cpp:77:5:   required from here\n",
       "build.compile",
       {"rk4.cpp", "77", "no match"}},
      {"/usr/bin/ld: /tmp/x.o: in function `main':\nx.cpp:(.text+0x0): multiple definition of `main'; ours0.o: first "
       "defined here\ncollect2: error: ld returned 1 exit status\n",
       "build.main",
       {"rk4.cpp"}},
      {"/usr/bin/ld: x.cpp:(.text+0x0): multiple definition of `f(int)'; ours\n", "build.twice", {"rk4.cpp", "f(int)"}},
      {"/usr/bin/ld: ours0.o: undefined reference to `rk4_step(double)'\ncollect2: error: ld returned 1 exit status\n",
       "build.undefined",
       {"rk4.cpp", "rk4_step(double)"}},
      {"\n", "build.silent", {"rk4.cpp"}},
      {"something else\n", "build.other", {"rk4.cpp", "something else"}},
  };
  for (const Row& row : table) {
    const Remark remark = first_error("rk4.cpp", row.said, {"own.h"});
    EXPECT_EQ(remark.key, row.key) << row.said;
    EXPECT_EQ(remark.with, row.with) << row.said;
  }
  const std::string point =
      "no match for 'operator*' (operand types are '" + std::string(2000, 'T') + "' and 'double')";
  EXPECT_EQ(first_error("rk4.cpp", "/t/in/rk4.cpp:5:3: error: " + point + "\n").with.at(2), point);
}

std::string complaint(const std::string& content, bool pairs) {
  const crosscheck::TemporaryFolder here("test");
  std::ofstream(here.path / "file.txt") << content;
  try {
    if (pairs)
      read_pairs(here.path / "file.txt");
    else
      read_mistakes(here.path / "file.txt");
  } catch (const crosscheck::InputError& error) {
    const std::string what = error.what();
    return what.substr(what.find("file.txt"));
  }
  return "";
}

TEST(Mistakes, ErrorsNameFileAndLine) {
  const std::string good = "# words\n[a]\npart: p\nloses: 1.1 2.1\n<<<<\none\n\n two\n====\n>>>>\n";
  EXPECT_EQ(complaint(good, false), "");
  const std::pair<std::string, const char*> table[] = {
      {"part: p\n", "file.txt:1: expected a heading"},
      {"[a]\n<<<<\n", "file.txt:2: expected 'part: NAME'"},
      {"[a]\npart: p\nlooses: 1\n", "file.txt:3: expected 'part:', 'loses:' or '<<<<', got 'looses: 1'"},
      {"[a]\npart: p\n[b]\n", "file.txt:3: expected '<<<<' and the text of [a] first"},
      {"[a]\npart: p\n<<<<\none\n", "file.txt:4: expected '====' that ends the text from line 3"},
      {"[a]\npart: p\n<<<<\n====\n>>>>\n", "file.txt:5: the text to be replaced is empty"},
      {"[a]\npart: p\n", "file.txt:2: the text of [a] is missing"},
      {good + good, "file.txt:12: [a] stands there twice"},
  };
  for (const auto& [content, says] : table)
    EXPECT_EQ(complaint(content, false).find(says), 0u) << complaint(content, false);
  EXPECT_EQ(complaint("[x]\na: one\nb: two\n", true), "");
  EXPECT_EQ(complaint("[x]\na: one\n", true).find("file.txt:2: expected 'a: NAME' and 'b: NAME'"), 0u);
}

TEST(Mistakes, TheTextMustStandThereExactlyOnce) {
  const Mistake mistake{"m", "p", "x + 1", "x - 1", {}};
  EXPECT_EQ(with_mistake("y = x + 1;\n", mistake), "y = x - 1;\n");
  for (const char* source : {"y = x + 2;", "y = x + 1 + x + 1;"})
    EXPECT_THROW(with_mistake(source, mistake), crosscheck::InputError) << source;
}

TEST(Texts, ErrorsNameFileAndLineAndPlacesAreFilledOnce) {
  for (const auto& [content, says] : {std::pair{"# c\nwords\n", "n.txt:2: text before the first [key]"},
                                      std::pair{"[a]\nx\n[a]\n", "n.txt:3: the key [a] stands there twice"}}) {
    try {
      Texts::parse(content, "n.txt");
      FAIL() << content;
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), says);
    }
  }
  const Texts texts = Texts::parse("[a]\n{0} {1} {2} {x} {\n\n[b]\n", "n.txt");
  EXPECT_EQ(texts.fill("a", std::string("{1}"), std::string("two")), "{1} two {2} {x} {");
  EXPECT_EQ(texts.of("b"), "");
  EXPECT_THROW(texts.of("c"), std::out_of_range);
}

TEST(Texts, BothLanguagesSayTheSameThings) {
  std::set<std::string> english, chinese;
  const Texts en = common_texts("en"), zh = common_texts("zh");
  for (const auto& [key, text] : en.all()) english.insert(key);
  for (const auto& [key, text] : zh.all()) chinese.insert(key);
  EXPECT_EQ(english, chinese);
}

TEST(Judge, BothSidesOfTheTolerance) {
  const Case what{"call", {}, {1, 2, 3, 4}, 2, 0.5, "step", "state"};
  for (const double off : {0.0, 0.5, -0.5, 0.500001, -0.500001}) {
    const Judged judged = judge(what, {How::answered, {1, 2, 3 + off, 4}});
    const bool right = std::abs(off) <= 0.5;
    EXPECT_EQ(judged.right, right) << off;
    EXPECT_EQ(judged.row, right ? -1 : 1);
    EXPECT_EQ(judged.column, right ? -1 : 0);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) EXPECT_TRUE(judge(what, {How::answered, {1, bad, 3, 4}}).not_finite);
  EXPECT_TRUE(judge(what, {How::answered, {1, 2, 3}}).wrong_size);
  EXPECT_TRUE(judge(what, {How::answered, {1, 2, 3, 4, 5}}).wrong_size);
  EXPECT_FALSE(judge(what, {How::crashed, {1, 2, 3, 4}}).right);
}

TEST(Words, SayWhatWasExpectedWhatCameAndWhere) {
  const Texts own = Texts::parse("[row.step]\nstep\n\n[column.state]\nx\n", "own");
  const Case what{"call", {}, {1, 2, 3, 4}, 2, 1e-9, "step", "state"};
  auto say = [&](const Answer& answer, const std::string& language) {
    return words(common_texts(language), own, what, answer, judge(what, answer));
  };
  EXPECT_EQ(say({How::answered, {1, 2, 3, 5}}, "en"), "First difference at step 1, x[1]: expected 4, got 5.");
  EXPECT_EQ(say({How::answered, {1, 2, 3, 5}}, "zh"), "第一处不同：step 1 的 x[1] 应为 4，实得 5。");
  const Texts named = Texts::parse("[row.step]\nstep\n\n[row.step.first]\n1\n\n[column.state]\n(x, y)\n", "named");
  const Answer wrong{How::answered, {1, 2, 3, 5}};
  EXPECT_EQ(words(common_texts(), named, what, wrong, judge(what, wrong)),
            "First difference at step 2, y: expected 4, got 5.");
  // shows enough digits to see the difference
  EXPECT_EQ(say({How::answered, {1, 2, 3, 4.00000001}}, "en"),
            "First difference at step 1, x[1]: expected 4, got 4.00000001.");
  EXPECT_EQ(say({How::answered, {1}}, "en"), "Expected 4 numbers, got 1.");
  EXPECT_EQ(say({How::answered, {1, 2}}, "en"),
            "Expected 4 numbers, got 2. Number of results, one per step: expected 2, got 1.");
  // a legend is separate from the names
  const Texts legends = Texts::parse("[row.step.legend]\nStep 0 is the start.\n", "legends");
  EXPECT_EQ(words(common_texts(), legends, what, wrong, judge(what, wrong)),
            "First difference at step 1, state[1]: expected 4, got 5. Step 0 is the start.");
  EXPECT_EQ(say({How::answered, {1, 2, 3, 4}}, "en"), "");
}

TEST(Words, CountSharesAndJudgeThemExactly) {
  const Texts common = common_texts(), own = Texts::parse("[column.springs]\nsprings\n", "texts");
  Case what{"call", {}, {1}, 1, 0.01, "", "springs"};
  Answer answer{.how = How::answered, .got = {1739.0 / 1740}, .of = {1740}};
  EXPECT_EQ(words(common, own, what, answer, judge(what, answer)),
            "First difference at springs: expected 1740 (all of them), got 1739.");
  answer.got = {1};
  EXPECT_TRUE(judge(what, answer).right);
}

TEST(Words, SayWhatWasGiven) {
  const Texts common = common_texts();
  const Texts own = Texts::parse("[given.chain]\nf is linear. | n h A[n,n] k[n-1] n*( x[2] m )\n", "texts");
  const auto say = [&](const char* call, const Numbers& in) {
    return given_text(common, own, Case{call, in, {1}, 1, 0, "", ""}, {});
  };
  EXPECT_EQ(
      say("part.chain", {2, 0.5, 1, 2, 3, 4, 7, 5, 6, 8, 9, 10, 11}),
      "f is linear. Given: n = 2, h = 0.5, A = (1, 2; 3, 4), k = 7, x[0] = (5, 6), m[0] = 8, x[1] = (9, 10), m[1] = "
      "11.");
  EXPECT_EQ(say("part.chain", {2, 0.5, 1}), "");
  EXPECT_EQ(say("other", {1}), "");
}

// The text shows the item of a list that differs, and nothing of a list that is too long to read.
TEST(Words, OfAListTellTheOneThatDiffers) {
  const Texts common = common_texts();
  const Texts own = Texts::parse(
      "[given.list]\n| r n n@( x[2] m )\n[given.rest]\n| rule ~@( w angle! )\n[given.all]\n| n x[n]\n", "texts");
  Case list{"list", {9, 2, 1, 2, 3, 4, 5, 6}, {1, 1, 1, 1}, 2, 0, "", ""};
  Judged second;
  second.row = 1;
  EXPECT_EQ(given_text(common, own, list, second), "Given: r = 9, n = 2, x[1] = (4, 5), m[1] = 6.");
  // now each item has two rows, and the second row belongs to the first item
  list.columns = 1;
  EXPECT_EQ(given_text(common, own, list, second), "Given: r = 9, n = 2, x[0] = (1, 2), m[0] = 3.");
  const Case rest{"rest", {3, 1, 2, 4, 5}, {1, 1}, 1, 0, "", ""};
  EXPECT_EQ(given_text(common, own, rest, second), "Given: rule = 3, w[1] = 4, angle[1] = 5.");
  EXPECT_EQ(angles_in(own, rest), (std::vector<std::size_t>{2, 4}));
  EXPECT_TRUE(angles_in(own, list).empty());
  Case all{"all", Numbers(81, 1), {1}, 1, 0, "", ""};
  all.in[0] = 80;
  EXPECT_EQ(given_text(common, own, all, {}), "");
}

TEST(Words, OfASetTellWhatIsMissing) {
  const Texts common = common_texts(), own = Texts::parse("[set.spring]\nsprings\n", "texts");
  const Case what{"call", {}, {0, 1, 1, 2, 2, 3}, 2, 0, "spring", "pair"};
  const auto say = [&](const Numbers& got) {
    const Answer answer{.how = How::answered, .got = got};
    return words(common, own, what, answer, judge(what, answer));
  };
  EXPECT_EQ(say({0, 1, 1, 3, 2, 3}), "Missing springs: (1, 2). Too many springs: (1, 3).");
  EXPECT_EQ(
      say({0, 1, 2, 3}),
      "Expected 6 numbers, got 4. Number of results, one per spring: expected 3, got 2. Missing springs: (1, 2).");
}

TEST(Words, OfAnIndexTellWhichItWas) {
  const auto say = [](const std::string& detail) {
    const Answer answer{.how = How::threw, .detail = detail};
    const Case what{"call", {}, {1}};
    return words(common_texts(), Texts(), what, answer, judge(what, answer));
  };
  EXPECT_EQ(say("vector::_M_range_check: __n (which is 18446744073709551615) >= this->size() (which is 3)"),
            "Your code threw an exception: at() was called with index -1, but there are only 3 elements.");
  EXPECT_EQ(say("array::at: __n (which is 5) >= _Nm (which is 3)"),
            "Your code threw an exception: at() was called with index 5, but there are only 3 elements.");
  EXPECT_EQ(say("no such spring"), "Your code threw an exception: no such spring");
}

TEST(Crash, IsReadOffWhatChecksPrint) {
  std::vector<std::string> addresses;
  const Crash of_vector = crash_in(
      "/usr/include/c++/12/debug/vector:442:\nError: attempt to subscript container with out-of-bounds index 3, but \n"
      "container only holds 2 elements.\n\nat 0x4011a2 0x401200 \n",
      addresses);
  EXPECT_EQ(of_vector.why, Crash::Why::index);
  EXPECT_EQ(of_vector.index, 3);
  EXPECT_EQ(of_vector.size, 2);
  EXPECT_EQ(addresses, (std::vector<std::string>{"0x4011a2", "0x401200"}));
  addresses.clear();
  const Crash of_array =
      crash_in("a.cpp:5:69: runtime error: index -1 out of bounds for type 'double [3]'\n", addresses);
  EXPECT_EQ(of_array.why, Crash::Why::index);
  EXPECT_EQ(of_array.index, -1);
  EXPECT_EQ(crash_in("index out of bounds\nat 0x12; reboot", addresses).why, Crash::Why::other);
  EXPECT_TRUE(addresses.empty());
}

TEST(Words, OfSmallCasesTellTheFirstThatFails) {
  const Texts common = common_texts(), own = Texts::parse("[given.call]\n| x\n", "texts");
  const std::vector<Case> small = {{"call", {1}, {1}, 1, 0, "", "y"}, {"call", {2}, {2}, 1, 0, "", "y"}};
  const Answer right{.how = How::answered, .got = {1}}, wrong{.how = How::answered, .got = {7}};
  EXPECT_EQ(smaller_text(common, own, small, {right, wrong}),
            "The smallest case that also fails: First difference at y: expected 2, got 7. Given: x = 2.");
  EXPECT_EQ(smaller_text(common, own, small, {right, {.how = How::answered, .got = {2}}}), "");
  EXPECT_EQ(smaller_text(common, own, small, {{.how = How::out_of_time}}), "");
}

TEST(Suspects, SourcesThatWouldExhaustTheStackOrTheTimeAreNotSearched) {
  const auto filled = [](const std::string& before, std::size_t count, const std::string& with) {
    std::string text = before;
    for (std::size_t i = 0; i < count; ++i) text += with;
    return text + "*/ (x) / 2;";
  };
  EXPECT_TRUE(can_be_searched("double y = sin(x) / 2;"));
  EXPECT_TRUE(can_be_searched(filled("/*", 3000, "a"))) << "a long comment";
  EXPECT_FALSE(can_be_searched(filled("sin /*", 30000, "a")));
  EXPECT_FALSE(can_be_searched(filled("sin", 30000, "\n")));
  EXPECT_FALSE(can_be_searched(filled("x", 30000, "y")));
  EXPECT_FALSE(can_be_searched(filled("1", 30000, ".")));
  EXPECT_FALSE(can_be_searched(filled("", 100000, "a / 2; ")));
}

TEST(Suspects, WholeNumbersAreDividedWhereTheyLookIt) {
  const auto lines = [](const std::string& source) { return whole_divisions(source).size(); };
  EXPECT_EQ(whole_divisions("x * (1 / 2)"), (std::vector<std::size_t>{7}));
  EXPECT_EQ(lines("int n = 3; y = x * (1 / n);"), 1u);
  EXPECT_EQ(lines("y = v.size() / 2;"), 1u);
  EXPECT_EQ(lines("y = (a + b) / 2;"), 1u);
  EXPECT_EQ(lines("double n = 3; y = 1 / n; y = h / 2; y = 1.0 / 2; y = 1 / 2.; y = a / b; y /= 2;"), 0u);
  EXPECT_EQ(lines("// 1 / 2\n/* 1 / 2 */ const char* s = \"1 / 2\"; char c = '/';"), 0u);
}

TEST(Random, RoundNumbersHaveFewDigitsAndAreNeverZero) {
  Random random(1, true);
  for (const auto& [low, high] : {std::pair{0.2, 0.7}, std::pair{-1.0, 1.0}, std::pair{5.0, 60.0}, std::pair{0.1, 0.3}})
    for (int i = 0; i < 100; ++i) {
      const double value = random.uniform(low, high);
      EXPECT_GE(value, low);
      EXPECT_LE(value, high);
      EXPECT_NE(value, 0);
      EXPECT_EQ(std::round(value * 100) / 100, value);
    }
}

TEST(Words, NameTheColumn) {
  const Texts own = Texts::parse(
      "[column.state]\nstate\n[column.point]\n(x, y)\n[column.all]\n(x, v) of particle #\n[column.kind]\n"
      "kind (0 or 1) and step\n",
      "texts");
  Case what;
  const auto text = [&](const std::string& column, int columns, int at) {
    what.column = column, what.columns = columns;
    return column_text(own, what, at);
  };
  EXPECT_EQ(text("state", 1, 0), "state");
  EXPECT_EQ(text("state", 3, 2), "state[2]");
  EXPECT_EQ(text("unknown", 3, 2), "unknown[2]");
  EXPECT_EQ(text("point", 2, 1), "y");
  EXPECT_EQ(text("point", 2, -1), "(x, y)");
  EXPECT_EQ(text("point", 3, 1), "(x, y)[1]");
  EXPECT_EQ(text("all", 6, 5), "v of particle 2");
  EXPECT_EQ(text("all", 5, 4), "(x, v) of particle #[4]");
  EXPECT_EQ(text("kind", 2, 0), "kind (0 or 1) and step[0]");
}

TEST(Plot, DrawsBothCurvesAndSurvivesAnything) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case what{"call", {}, {1, 2, 3, 4, 5, 6}, 2, 1e-9, "step", "state", 0, 1};
  const PlotTexts texts{"right", "<yours>", "x", "y"};
  for (const Numbers& got : {Numbers{1, 2, 3, 4, 5, 6}, Numbers{nan, 1, 1e300, 1, 1, -1e300}, Numbers{}}) {
    const std::string svg = plot(what, got, texts);
    EXPECT_NE(svg.find("&lt;yours&gt;"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
  }
  // the plot has 298 x 162 pixels: the range of x is 298/162 of the range of y, around the same centre
  EXPECT_NE(plot(what, what.expected, texts).find(">8.89<"), std::string::npos);
  Case nothing = what;
  nothing.plot_y = -1;
  EXPECT_EQ(plot(nothing, what.expected, texts), "");
}

TEST(CheckPage, MarksStandBesideColours) {
  const std::string text =
      page("zh", "t", "", {{"p", "1.1", true, "", {}}, {"p", "1.2", false, "wrong", {}}}, "yes", "no");
  EXPECT_NE(text.find("<html lang=\"zh\">"), std::string::npos) << text;
  EXPECT_NE(text.find("<h3>&#10003; 1.1: yes"), std::string::npos) << text;
  EXPECT_NE(text.find("<h3>&#10007; 1.2: no"), std::string::npos) << text;
}

TEST(CasesFile, ReadsBackWhatWasWritten) {
  const double inf = std::numeric_limits<double>::infinity();
  Case c{"part.call", {0.1, -1e-310, 1e300, inf}, {1.0 / 3, 2, 3, 4}, 2, 1e-9, "step", "state", 0, 1, 0.25};
  PublicTests all{"a0",
                  "A title of words",
                  7,
                  {{"1.1", "part", "A heading, too", 3, {c, c}, {c}}, {"1.2", "part", "h", 2, {}, {}}}};
  all.tests[0].small[0].in = {5};
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
  EXPECT_EQ(d.in, c.in);
  EXPECT_EQ(d.expected, c.expected);
  EXPECT_EQ(std::tie(d.call, d.columns, d.tolerance, d.row, d.column, d.plot_x, d.plot_y, d.row_size),
            std::tie(c.call, c.columns, c.tolerance, c.row, c.column, c.plot_x, c.plot_y, c.row_size));
  EXPECT_TRUE(back.tests[0].cases[1].in.empty());
  ASSERT_EQ(back.tests[0].small.size(), 1u);
  EXPECT_EQ(back.tests[0].small[0].in, Numbers{5});
  EXPECT_EQ(back.tests[0].small[0].expected, c.expected);
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
