// No trick of cheats/ earns anything on the part that it attacks. Tests all tricks on one assignment, and a few tricks
// on all assignments.

#include <gtest/gtest.h>

#include <sstream>

#include "mysim/base/files.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/grade.h"
#include "tests/coursework/test/canaries.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/sandboxes.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

std::vector<std::string> cheats() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(COURSEWORK_FOLDER) / "cheats"))
    if (entry.path().extension() == ".cpp") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A few tests suffice, because a trick acts in each of them.
struct Few {
  Few() : assignment(find_assignment("a1-steppers")) {
    for (const Test& test : assignment.tests)
      for (const char* id : {"1.1", "1.4", "2.1", "3.1"})
        if (test.id == id) tests.push_back(test);
    assignment.tests = tests;
  }
  std::vector<Test> tests;
  Assignment assignment;
};

/// Rows {t, h, x, next}: inputs and answers of the public tests whose calls are one step of a linear system.
std::string public_table(const Assignment& assignment) {
  std::ostringstream out;
  out.precision(17);
  const auto list = [&out](const double* from, std::size_t n) {
    out << '{';
    for (std::size_t i = 0; i < n; ++i) out << from[i] << ", ";
    out << '}';
  };
  for (const Test& test : assignment.tests) {
    for (const Case& each : public_cases(assignment, test)) {
      if (each.call != "euler.linear") continue;
      const auto n = static_cast<std::size_t>(each.in[0]);
      out << '{' << each.in[2] << ", " << each.in[3] << ", ";
      list(&each.in[4], n);
      out << ", ";
      list(each.expected.data(), n);
      out << "},\n";
    }
  }
  return out.str();
}

class CheatTest : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  static std::string sandbox_name() { return std::get<0>(GetParam()); }
  static fs::path cheat() { return fs::path(COURSEWORK_FOLDER) / "cheats" / (std::get<1>(GetParam()) + ".cpp"); }

  /// The cheat as a student would submit it: one file, with everything that could be known about this machine.
  std::string source() const {
    std::string text = content_of_file(cheat());
    std::string shared = content_of_file(cheat().parent_path() / "cheat.h");
    shared = replaced(shared, "#pragma once", "");
    text = replaced(text, "#include \"cheat.h\"", shared);
    text = replaced(text, "#include \"public_table.inc\"", public_table(few_.assignment));
    return "#define RESULTS \"" + canaries_.results().string() + "\"\n#define HOME_FOLDER \"" +
           canaries_.home().string() + "\"\n#define TESTS \"" + canaries_.tests().string() + "\"\n" + text;
  }

  Few few_;
  Canaries canaries_;
};

/// Keys of the accepted texts, from the second line of a cheat. Where "differs" is accepted, "size" is accepted, too.
std::vector<std::string> expected(const fs::path& cheat) {
  std::istringstream lines(content_of_file(cheat));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::istringstream words(line.substr(std::string("// says: ").size()));
  std::vector<std::string> keys{std::istream_iterator<std::string>(words), {}};
  if (std::find(keys.begin(), keys.end(), "differs") != keys.end()) keys.insert(keys.end(), {"size", "shown_only"});
  return keys;
}

bool says(const Texts& common, const std::string& said, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    const std::string& text = common.of(common.has("how." + key) ? "how." + key : key);
    if (said.find(text.substr(0, text.find('{'))) != std::string::npos) return true;
  }
  return false;
}

TEST_P(CheatTest, EarnsNothingAndHarmsNothing) {
  adopt_orphans();
  std::unique_ptr<Sandbox> sandbox;
  try {
    sandbox = choose_sandbox(sandbox_name(), false);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  ASSERT_FALSE(sees(*sandbox, canaries_.tests()));
  ASSERT_FALSE(sees(*sandbox, canaries_.results()));
  Submission submission;
  submission.name = cheat().stem().string();
  submission.files["euler.cpp"] = source();
  for (const char* part : {"trapezoidal.cpp", "rk4.cpp"})
    submission.files[part] = content_of_file(canaries_.tests() / "solution" / part);
  GradeOptions options;
  options.seed = 7;
  options.least_cpu = 3;  // a small limit, because endless loops run up to any limit
  options.common = Texts::read((fs::path(COURSEWORK_FOLDER) / "check/common.en.txt").string());
  const Result result = grade(few_.assignment, submission, *sandbox, options);
  ASSERT_TRUE(result.complete);
  for (const TestResult& test : result.tests) {
    const bool cheated = test.part == "euler";
    EXPECT_EQ(test.earned, cheated ? 0 : test.points)
        << test.id << ' ' << (test.hidden ? "hidden: " : "public: ") << test.said;
    if (cheated) {
      EXPECT_TRUE(says(options.common, test.said, expected(cheat()))) << test.id << ": " << test.said;
    }
    EXPECT_EQ(test.said.find("root:"), std::string::npos) << test.said;
  }
  EXPECT_EQ(canaries_.harm(), "");
  EXPECT_EQ(leftover_processes(), std::set<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Each, CheatTest,
                         testing::Combine(testing::Values("bwrap", "uid"), testing::ValuesIn(cheats())),
                         [](const auto& of) { return std::get<0>(of.param) + "_" + std::get<1>(of.param); });

}  // namespace

// A few tricks on every assignment: they earn no more than the starter does, and harm nothing. The tests above check
// the messages, and many more tricks, on one assignment.

namespace {
namespace fs = std::filesystem;

struct Trick {
  const char* name;
  const char* before_main;  // code in which TESTS and RESULTS are files of the lecturer
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

/// The assignment with a single test of the attacked part. This is the first part if each part has a file of its own.
/// For a whole program it is the last part, which does not depend on classes that other parts need.
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

  /// The starter's part with the trick appended, and no other part.
  Submission submission(const std::string& at_the_end) const {
    const auto sandbox = choose_sandbox("bare", true);
    const std::string file = builder_for(whole(), *sandbox, *sandbox)->file_of(one_.part);
    Submission submission = read_submission(whole().folder() / "starter", wanted_files(whole()));
    for (const std::string& other : wanted_files(whole()))
      if (other != file) submission.files.erase(other), submission.missing[other] = {"file.missing", {other}};
    submission.files.at(file) += at_the_end;
    return submission;
  }

  Result graded(const Submission& submission) const {
    const auto sandbox = choose_sandbox("", false);
    GradeOptions options = options_for(whole(), 7);
    options.least_cpu = 3;
    return grade(one_.assignment, submission, *sandbox, options);
  }

  OnePart one_{whole()};
  PrivateFolder lecturers_{0700};
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
    EXPECT_EQ(leftover_processes(), std::set<std::string>{});
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
