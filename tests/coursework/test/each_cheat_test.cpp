// A few tricks on every assignment: they earn no more than the starter does and harm nothing. What each trick says, and
// many more of them, cheat_test.cpp looks at on one assignment.
#include <gtest/gtest.h>

#include <fstream>

#include "mysim/files.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/lanes.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;

struct Trick {
  const char* name;
  const char* before_main;  // TESTS and RESULTS are files of the lecturer's
};

constexpr Trick tricks[] = {
    {"exits", "_exit(0);"},
    {"forges",
     R"(const char* text = "answer 3 0x1p+0 0x1p+0 0x1p+0\ntoken 0\n"; if (write(3, text, strlen(text)) > 0) _exit(0);)"},
    {"loops", "for (volatile int i = 0;;) i = i + 1;"},
    {"forks", "while (fork() >= 0) {}"},
    {"reads_tests",
     "char c; const int file = open(TESTS, O_RDONLY); while (file >= 0 && read(file, &c, 1) == 1) write(3, &c, 1);"},
    {"overwrites_results",
     R"(const int file = open(RESULTS, O_WRONLY | O_CREAT, 0666); if (file >= 0) write(file, "100", 3);)"},
};

/// The assignment with one test of the part that is cheated: of parts in a hand-out the first, of a whole program the
/// last, so that what others need of it stays out.
struct OnePart {
  explicit OnePart(const Assignment& whole) : assignment(whole) {
    part = whole.takes_whole_program() ? whole.parts.back().name : whole.parts.front().name;
    if (whole.takes_whole_program()) assignment.parts = whole.parts.last(1);
    for (const Test& test : whole.tests)
      if (tests.empty() && test.part == part && test.hidden > 0) tests.push_back(test);
    assignment.tests = tests;
  }
  std::string part;
  std::vector<Test> tests;
  Assignment assignment;
};

class EachCheat : public testing::TestWithParam<const Assignment*> {
 protected:
  static const Assignment& whole() { return *GetParam(); }

  /// The starter's part, the trick at its end, and no other part.
  Submission submission(const std::string& at_the_end) const {
    const auto lane = choose_lane("bare", true);
    const std::string file = builder_for(whole(), *lane, *lane)->file_of(one_.part);
    Submission submission = read_submission(whole().folder() / "starter", files_asked_for(whole()));
    for (const std::string& other : files_asked_for(whole()))
      if (other != file) submission.files.erase(other), submission.missing[other] = {"file.missing", {other}};
    submission.files.at(file) += at_the_end;
    return submission;
  }

  Result graded(const Submission& submission) const {
    const auto lane = choose_lane("", false);
    return grade(one_.assignment, submission, *lane, options_for(whole(), 7));
  }

  OnePart one_{whole()};
  OwnFolder lecturers_{0700};
};

TEST_P(EachCheat, EarnsNoMoreThanTheStarter) {
  adopt_orphans();
  const fs::path tests = lecturers_.path() / "tests", results = lecturers_.path() / "results";
  crosscheck::write_file(tests, "answer 1 0x1p+0\n");
  crosscheck::write_file(results, "0");
  const std::string places = "#define TESTS \"" + tests.string() + "\"\n#define RESULTS \"" + results.string() + "\"\n";
  const Result honest = graded(submission(""));
  ASSERT_TRUE(honest.complete);
  EXPECT_LT(honest.earned(), honest.points());
  for (const Trick& trick : tricks) {
    SCOPED_TRACE(trick.name);
    const Result cheated =
        graded(submission("\n#include <fcntl.h>\n#include <unistd.h>\n#include <cstring>\n" + places +
                          "namespace { struct Trick { Trick() { " + trick.before_main + " } } trick; }\n"));
    ASSERT_TRUE(cheated.complete);
    EXPECT_LE(cheated.earned(), honest.earned());
    for (const TestResult& test : cheated.tests)
      EXPECT_EQ(test.said.find("compile"), std::string::npos) << "it was not even tried: " << test.said;
    EXPECT_EQ(content_of_file(tests), "answer 1 0x1p+0\n");
    EXPECT_EQ(content_of_file(results), "0");
    EXPECT_EQ(left_running(), std::set<std::string>{});
  }
}

std::vector<const Assignment*> all_assignments() {
  std::vector<const Assignment*> all;
  for (const Assignment& assignment : assignments()) all.push_back(&assignment);
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, EachCheat, testing::ValuesIn(all_assignments()), [](const auto& of) {
  std::string name(of.param->name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace coursework
