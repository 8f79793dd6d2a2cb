// Parts in Python: wrong programs, right but odd ones, cheats, and the hand-out's check.py, which gives the same
// verdicts.
#include "tests/coursework/grader/python.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"
#include "tests/coursework/check/judge.h"
#include "tests/coursework/grader/handout.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/test/helpers.h"
#include "tests/coursework/test/recalling_sandbox.h"

namespace coursework {
namespace {
namespace fs = std::filesystem;
using crosscheck::TemporaryFolder;
using crosscheck::write_file;

fs::path programs() { return folder_of_coursework() / "test/python"; }

std::string solution(const Assignment& assignment, const std::string& part) {
  return content_of_file(assignment.folder() / "solution" / (part + ".py"));
}

/// A submission of these files.
Submission python_of(const Assignment& assignment, const std::map<std::string, std::string>& files) {
  const TemporaryFolder folder("python");
  for (const auto& [name, content] : files) write_file(folder.path / name, content);
  return submission_at(folder.path, assignment);
}

/// Standard output of the command, without standard error, where warnings of NumPy would appear in the middle of a
/// line.
std::string said_by(const std::string& command) {
  FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
  std::string said;
  char block[4096];
  for (std::size_t got; (got = fread(block, 1, sizeof block, pipe)) > 0;) said.append(block, got);
  pclose(pipe);
  return said;
}

class PythonPrograms : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
    write_python_handout(assignment_, handout_.path / "given");
  }

  /// Ids of the part's tests that fail with public or, if `hidden`, hidden cases, all in one interpreter. Sets `runs`.
  std::set<std::string> lost(const std::string& part, const std::string& source, bool hidden,
                             std::vector<TestRun>& runs) {
    const TemporaryFolder scratch("built");
    const Built built = builder_->theirs(python_of(assignment_, {{part + ".py", source}}), scratch.path, 1).at(part);
    EXPECT_FALSE(built.program.empty()) << said(common_texts(), built.error);
    std::vector<Case> all;
    runs.clear();
    for (const coursework::Test& test : assignment_.tests) {
      if (test.part != part) continue;
      Random random(hidden_seed(1, test));
      runs.push_back({&test, hidden ? test.cases(random) : public_cases(assignment_, test), {}});
      all.insert(all.end(), runs.back().cases.begin(), runs.back().cases.end());
    }
    const std::vector<Answer> answers = run_calls(*sandbox_, built.program, all);
    std::set<std::string> ids;
    std::size_t at = 0;
    for (TestRun& run : runs)
      for (const Case& each : run.cases) {
        run.answers.push_back(reduced(*run.test, each, answers[at++]));
        if (!judge(each, run.answers.back()).right) ids.emplace(run.test->id);
      }
    return ids;
  }

  /// The public tests that fail according to check.py.
  std::set<std::string> lost_by_check(const std::string& part, const std::string& source) const {
    const fs::path given = handout_.path / "given", file = given / (part + ".py");
    for (const Part& other : assignment_.parts)
      write_file(given / (std::string(other.name) + ".py"), solution(assignment_, std::string(other.name)));
    write_file(file, source);
    const std::string said = said_by("/usr/bin/python3 -B " + (given / "check.py").string() + " " + part);
    std::set<std::string> ids;
    int verdicts = 0;
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("  ") && line[2] != ' ' && line.find(" points") != std::string::npos) {
        ++verdicts;
        if (line.find("   failed   ") != std::string::npos) ids.insert(line.substr(2, line.find(' ', 2) - 2));
      }
    int expected = 0;
    for (const PublicTest& test : public_tests(assignment_).tests) expected += test.part == part && !test.cases.empty();
    EXPECT_EQ(verdicts, expected) << said;
    return ids;
  }

  void expect_outcomes(const std::string& kind, std::size_t least) {
    const std::vector<Mistake> all = read_mistakes(programs() / (GetParam() + "." + kind + ".txt")),
                               known = mistakes_of(assignment_);
    EXPECT_GE(all.size(), least);
    for (const Mistake& one : all) {
      SCOPED_TRACE(one.name);
      const std::string source = with_mistake(solution(assignment_, one.part), one);
      const std::set<std::string> loses(one.loses.begin(), one.loses.end());
      std::vector<TestRun> runs;
      EXPECT_EQ(lost(one.part, source, true, runs), loses);
      const bool named = std::ranges::any_of(known, [&](const Mistake& other) { return other.name == one.name; });
      if (named) {
        EXPECT_EQ(likely_causes(assignment_, one.part, runs, known, *builder_, *trusted_, 2),
                  std::vector<std::string>{one.name});
      }
      std::set<std::string> shown = lost(one.part, source, false, runs);
      EXPECT_EQ(shown, loses);
      for (const coursework::Test& test : assignment_.tests)
        if (test.reduce) shown.erase(std::string(test.id));  // not in the hand-out
      EXPECT_EQ(lost_by_check(one.part, source), shown);
    }
  }

  const Assignment& assignment_ = find_assignment(GetParam());
  std::unique_ptr<Sandbox> sandbox_ = choose_sandbox("", true);
  std::unique_ptr<RecallingSandbox> trusted_ = std::make_unique<RecallingSandbox>(choose_sandbox("bare", true));
  std::unique_ptr<Builder> builder_ = python_builder(assignment_, *trusted_, *sandbox_);
  TemporaryFolder handout_{"handout"};
};

TEST_P(PythonPrograms, WithAMistakeLoseItsTestsAndAreToldTheCause) { expect_outcomes("wrong", 20); }

TEST_P(PythonPrograms, RightButOddLoseNothing) { expect_outcomes("odd", 10); }

TEST_P(PythonPrograms, OfTheHandOutCallOfficialPartsInPlaceOfWrongOnes) {
  std::map<std::string, std::string> files;
  for (const Part& part : assignment_.parts) {
    const std::string name(part.name);
    std::vector<TestRun> runs;
    EXPECT_EQ(lost(name, solution(assignment_, name), true, runs), std::set<std::string>()) << name;
    EXPECT_FALSE(lost(name, content_of_file(assignment_.folder() / "starter" / (name + ".py")), true, runs).empty());
  }
}

INSTANTIATE_TEST_SUITE_P(All, PythonPrograms, testing::Values("a1-steppers", "a2-pendulum"),
                         [](const auto& of) { return name_of_test(of.param); });

/// a1-steppers with two tests of its first part, which suffice for a cheat.
struct Few {
  Few() : assignment(find_assignment("a1-steppers")) {
    for (const Test& test : assignment.tests)
      if (test.id == "1.1" || test.id == "1.4") tests.push_back(test);
    assignment.tests = tests;
  }
  std::vector<Test> tests;
  Assignment assignment;
};

TEST(PythonCheats, EarnNothing) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  const Few few;
  GradeOptions options = options_for(find_assignment("a1-steppers"), 7);
  options.least_cpu = 5;
  for (const char* lane : {"bwrap", "uid"}) {
    std::unique_ptr<Sandbox> sandbox;
    try {
      sandbox = choose_sandbox(lane, false);
    } catch (const std::runtime_error&) {
      continue;
    }
    int cheats = 0;
    const int most = lane == std::string("bwrap") ? 100 : 3;  // the other lane differs in what the system allows
    for (const auto& entry : fs::directory_iterator(programs() / "cheats")) {
      if (++cheats > most) break;
      const std::string source = content_of_file(entry.path());
      const Submission submission =
          python_of(few.assignment, {{"euler.py", source}, {"numpy.py", source}, {"sitecustomize.py", source}});
      const Result result = grade(few.assignment, submission, *sandbox, options);
      EXPECT_EQ(result.earned(), 0) << lane << ", " << entry.path();
      EXPECT_EQ(result.tests.size(), 4u);
    }
    EXPECT_GE(cheats, std::min(most, 10));
  }
}

Result graded(const std::map<std::string, std::string>& files, double least_cpu = 30) {
  const Few few;
  GradeOptions options = options_for(find_assignment("a1-steppers"), 7);
  options.least_cpu = least_cpu;
  const auto sandbox = choose_sandbox("", true);
  return grade(few.assignment, python_of(few.assignment, files), *sandbox, options);
}

TEST(PythonSubmission, IsGradedFromNestedFoldersWithModulesOfItsOwn) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  const Result result = graded({{"work/euler.py",
                                 "from tools.sums import moved\n\n\ndef euler_step(f, t, x, h):\n"
                                 "    return moved(x, h, f(t, x))\n"},
                                {"work/tools/sums.py", "def moved(x, h, k):\n    return x + h * k\n"}});
  EXPECT_EQ(result.earned(), result.points());
}

/// Four lines that define an exception without a text.
const std::string unprintable =
    "class Unprintable(Exception):\n    def __str__(self):\n        raise SystemExit\n    __repr__ = __str__\n";

/// Modules with the names of ours and of Python's, which no code of ours may import.
std::map<std::string, std::string> shadows() {
  std::map<std::string, std::string> files;
  for (const char* name : {"argparse", "calls", "drawing_stubs", "importlib", "json", "loader", "math", "numbers",
                           "numpy", "os", "random", "secrets", "tokenize", "traceback", "types"})
    files[std::string(name) + ".py"] = "import sys\nsys.exit('imported')\n";
  return files;
}

TEST(PythonSubmission, MayHaveModulesNamedLikeOurs) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  std::map<std::string, std::string> files = shadows();
  files["euler.py"] =
      "from drawing_stubs import moved\n\n\ndef euler_step(f, t, x, h):\n    return moved(x, h, f(t, x))\n";
  files["drawing_stubs.py"] = "def moved(x, h, k):\n    return x + h * k\n";
  const Result result = graded(files);
  EXPECT_EQ(result.earned(), result.points()) << result.tests[0].said;
}

TEST(PythonSubmission, NamesFileLineAndValue) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  const std::string head = "def euler_step(f, t, x, h):\n";
  const std::pair<std::string, std::string> messages[] = {
      {head + "    i = 3\n    return x[7 * i]\n", "euler.py, line 3: IndexError: index 21 is out of bounds"},
      {head + "    i = 3\n    return x[7 * i]\n", "i = 3"},
      {head + "    x + h * f(t, x)\n",
       "euler.py, line 1: TypeError: euler_step returned something unusable: expected numbers, got None"},
      {head + "    return f(x, t)\n", "a value has 1 dimensions; it must have 0"},
      {head + "    return (x\n", "euler.py cannot be imported: euler.py, line 2: SyntaxError"},
      {"import scipy.integrate\n" + head + "    return x\n", "euler.py imports scipy, which cannot be used"},
      {"def euler(f, t, x, h):\n    return x\n", "euler.py does not define the function euler_step"},
      {head + "    import os\n    os._exit(0)\n", "Functions must return"},
      {head + "    return euler_step(f, t, x, h)\n", "RecursionError"},
      {head + "    return [10**400, 1]\n", "euler.py, line 1: OverflowError: euler_step returned something unusable"},
      {"i = 10**100\n" + head + "    k = i\n    return x[7 * k]\n", "euler.py, line 4: IndexError"},
      {unprintable + head + "    raise Unprintable\n", "euler.py, line 6: Unprintable"},
      {unprintable + head + "    i = [Unprintable()]\n    return x[i]\n", "euler.py, line 7: "},
      {unprintable + "raise Unprintable\n", "euler.py cannot be imported: euler.py, line 5: Unprintable"},
      {head + "    raise ValueError('\\ud800')\n", "euler.py, line 2: ValueError: ?"},
      {"eval('1 +')\n", "euler.py cannot be imported: euler.py, line 1: SyntaxError"},
      {"from math import sum\n", "euler.py cannot be imported: euler.py, line 1: ImportError"},
  };
  for (const auto& [source, said] : messages) {
    const Result result = graded({{"euler.py", source}});
    EXPECT_EQ(result.earned(), 0);
    EXPECT_NE(result.tests[0].said.find(said), std::string::npos) << said << "\n" << result.tests[0].said;
    EXPECT_TRUE(result.tests[2].said.find("index 21") == std::string::npos) << "an input of a hidden test";
  }
  const Result slow = graded({{"euler.py", head + "    while True:\n        f(t, x)\n"}}, 1);
  EXPECT_TRUE(slow.tests[0].ungraded) << slow.tests[0].said;
  EXPECT_NE(slow.tests[0].said.find("f "), std::string::npos);
}

TEST(PythonSubmission, IsNotGradedWithoutItsPackages) {
  setenv("CROSSCHECK_PYTHON", "/nonexistent/python3", 1);
  const Result none = graded({{"euler.py", "def euler_step(f, t, x, h):\n    return x\n"}});
  setenv("CROSSCHECK_PYTHON", "/bin/false", 1);
  const Result no_numpy = graded({{"euler.py", "def euler_step(f, t, x, h):\n    return x\n"}});
  unsetenv("CROSSCHECK_PYTHON");
  EXPECT_NE(none.not_graded.find("python3 "), std::string::npos);
  EXPECT_NE(no_numpy.not_graded.find("python3-numpy"), std::string::npos);
}

TEST(PythonHandout, HoldsNoLineOfTheSolution) {
  for (const char* name : {"a1-steppers", "a2-pendulum"}) {
    const Assignment& assignment = find_assignment(name);
    const TemporaryFolder folder("handout");
    write_python_handout(assignment, folder.path);
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path))
      if (entry.is_regular_file()) all += content_of_file(entry.path());
    for (const char* other : {".cpp", "std::", "[mistake."}) EXPECT_EQ(all.find(other), std::string::npos) << other;
    for (const Part& part : assignment.parts) {
      std::istringstream lines(solution(assignment, std::string(part.name)));
      for (std::string line; std::getline(lines, line);)
        if (line.starts_with("    ") && line.size() > 20) {
          EXPECT_EQ(all.find(line), std::string::npos) << line;
        }
    }
  }
}

/// The output of the hand-out's check.py for the solution with these files added or replaced.
std::string checked(const char* name, std::map<std::string, std::string> files, const std::string& options = "") {
  const Assignment& assignment = find_assignment(name);
  const TemporaryFolder folder("handout");
  write_python_handout(assignment, folder.path);
  for (const Part& part : assignment.parts)
    files.emplace(std::string(part.name) + ".py", solution(assignment, std::string(part.name)));
  for (const auto& [file, content] : files) write_file(folder.path / file, content);
  return said_by("(/usr/bin/python3 -B " + options + " " + (folder.path / "check.py").string() + " 2>&1)");
}

TEST(PythonHandout, ImportsOnlyItsOwnModules) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  std::map<std::string, std::string> files = shadows();
  for (const char* helper : {"calls", "drawing_stubs"}) {
    files["euler.py"] =
        fmt::format("import {0}\n\n\ndef euler_step(f, t, x, h):\n    return {0}.moved(x, h, f(t, x))\n", helper);
    files[std::string(helper) + ".py"] = "def moved(x, h, k):\n    return x + h * k\n";
    const std::string said = checked("a1-steppers", files);
    EXPECT_NE(said.find("All public tests passed"), std::string::npos) << said;
  }
}

TEST(PythonHandout, NamesTheStudentsLine) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  const std::string head = "def euler_step(f, t, x, h):\n";
  const std::pair<std::string, std::string> messages[] = {
      {"x = 1\nimport nothing_such\n", "euler.py, line 2: import nothing_such\n      ModuleNotFoundError: "},
      {"x = 1 / 0\n", "euler.py, line 1: x = 1 / 0\n      ZeroDivisionError: division by zero\n"},
      {head + "    return (x\n", "euler.py, line 2: return (x\n      SyntaxError: "},
      {"eval('1 +')\n", "euler.py, line 1: eval('1 +')\n      SyntaxError: "},
      {head + "    return x[7]\n", "euler.py, line 2: return x[7]\n      IndexError: index 7 is out of bounds"},
      {head + "    return f(t, 1.0)\n", "euler.py, line 2: return f(t, 1.0)\n      TypeError: the state given to f: "},
      {unprintable + head + "    raise Unprintable\n", "euler.py, line 6: raise Unprintable\n      Unprintable\n"},
      {head + "    raise ValueError('\\ud800')\n", "\n      ValueError: ?\n"},
  };
  for (const auto& [source, message] : messages) {
    const std::string said = checked("a1-steppers", {{"euler.py", source}});
    EXPECT_NE(said.find(message), std::string::npos) << message << "\n" << said;
    EXPECT_EQ(said.find("check.py"), std::string::npos) << said;
    EXPECT_NE(said.find("\nTotal: "), std::string::npos) << said;
  }
}

TEST(PythonHandout, NamesTheShapeOfAState) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  const std::string said =
      checked("a2-pendulum", {{"pendulum.py", "def pendulum_derivative(p, a):\n    return a[0]\n"}});
  EXPECT_NE(said.find("TypeError: the derivative: expected an array of shape (n, 3), got (3,)"), std::string::npos)
      << said;
}

TEST(PythonHandout, SaysHowToInstallNumPy) {
  if (const std::string package = missing_python_package(); !package.empty()) GTEST_SKIP() << package;
  EXPECT_EQ(checked("a1-steppers", {}, "-S"),
            "check.py needs NumPy. Debian and Ubuntu: apt install python3-numpy; elsewhere: pip install numpy\n");
}

TEST(PythonHandout, IsRefusedForOtherAssignments) {
  const TemporaryFolder folder("handout");
  EXPECT_THROW(write_python_handout(find_assignment("a3-cloth"), folder.path / "given"), crosscheck::InputError);
}

}  // namespace
}  // namespace coursework
