// Whole programs that fail in one class: each way has its message, and the other parts still earn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "mysim/base/files.h"
#include "tests/coursework/classic/whole_program.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/test/helpers.h"

namespace coursework {
namespace {

/// One test of the cloth, which fails, and of the part before it, which does not.
struct Short {
  explicit Short(const Assignment& whole) : assignment(whole) {
    assignment.parts = whole.parts.last(2);
    for (const Part& part : assignment.parts)
      for (const Test& test : whole.tests)
        if (test.part == part.name) {
          tests.push_back(test);
          break;
        }
    assignment.tests = tests;
  }
  std::vector<Test> tests;
  Assignment assignment;
};

struct Failing {
  const char* what;
  std::vector<std::array<const char*, 3>> changes;  // file, what stands there once, what in its place
  const char* says;
};

// What the smallest assignment can fail in as well, grade_test.cpp tries there.
TEST(Classic, EveryWayToFailHasItsMessageAndCostsItsOwnPart) {
  const Assignment& whole = find_assignment("classic");
  const Short few(whole);
  const auto sandbox = choose_sandbox("bare", true);
  const Submission solution = read_submission(whole.folder() / "solution", {});
  const Failing table[] = {
      {"a constructor that nobody can call",
       {{"ClothSystem.h", "ClothSystem();", "ClothSystem(const char* file);"},
        {"ClothSystem.cpp", "::ClothSystem()", "::ClothSystem(const char*)"}},
       "The tests cannot use ClothSystem.cpp as the starter's program would: "},
      {"does not compile", {{"ClothSystem.cpp", "evalF(", "evalF(int, "}}, "ClothSystem.cpp, line "},
      {"crashes",
       {{"ClothSystem.cpp", "evalF(vector<Vector3f> state) {", "evalF(vector<Vector3f> state) { *(int*)8 = 1;"}},
       "crashed (segmentation fault)"},
  };
  for (const Failing& one : table) {
    Submission submission = solution;
    for (const auto& [file, from, to] : one.changes)
      submission.files.at(file) = with_mistake(submission.files.at(file), {one.what, "cloth", from, to, {}});
    const Result result = grade(few.assignment, submission, *sandbox, options_for(whole, 7));
    for (const TestResult& test : result.tests) {
      const bool failing = test.part == "cloth";
      EXPECT_EQ(test.earned, failing ? 0 : test.points) << one.what << ", " << test.id << ": " << test.said;
      if (failing) {
        EXPECT_NE(test.said.find(one.says), std::string::npos) << one.what << ": " << test.said;
      }
    }
  }
}

TEST(Classic, OutputAndAMissingFileCostNothingElse) {
  const Assignment& whole = find_assignment("classic");
  const Short few(whole);
  const auto sandbox = choose_sandbox("bare", true);
  Submission submission = read_submission(whole.folder() / "solution", {});
  std::string& pendulum = submission.files.at("pendulumSystem.cpp");
  const std::string from = "evalF(vector<Vector3f> state) {", to = from + " std::cout << \"all passed\\n\";";
  pendulum = "#include <iostream>\n" + with_mistake(pendulum, {"output", "pendulum", from, to, {}});
  submission.files.erase("ClothSystem.cpp");
  submission.files.erase("ClothSystem.h");
  const Result result = grade(few.assignment, submission, *sandbox, options_for(whole, 7));
  for (const TestResult& test : result.tests) {
    const bool missing = test.part == "cloth";
    EXPECT_EQ(test.earned, missing ? 0 : test.points) << test.id << ": " << test.said;
    if (missing) {
      EXPECT_EQ(test.said, "ClothSystem is missing, so its tests cannot run.");
    }
  }
}

// Names leave a choice, and one class does not even compile where it is used: the compiler says why.
TEST(Classic, AClassThatCannotBeTriedIsToldTheCompilersFirstError) {
  const Assignment& whole = find_assignment("classic");
  const auto sandbox = choose_sandbox("bare", true);
  classic::Files files;
  for (const char* name : {"particleSystem.h", "particleSystem.cpp", "simpleSystem.h", "simpleSystem.cpp"})
    files[name] = content_of_file(whole.folder() / "solution" / name);
  files["Spare.h"] =
      "#include \"particleSystem.h\"\nclass Spare : public ParticleSystem {\n  Spare() {}\n public:\n"
      "  vector<Vector3f> evalF(vector<Vector3f> state) { return state; }\n  void draw() {}\n};\n";
  const crosscheck::TemporaryFolder scratch("test");
  crosscheck::write_file(scratch.path / "child.o", "");  // nothing is run
  const Compiler compiler;
  const classic::Programs programs =
      classic::build_programs(files, scratch.path / "tree", folder_of_coursework(), *sandbox,
                              {compiler.command(), "/usr/bin/ar", scratch.path / "child.o"}, {"simple"},
                              [](const auto&, bool) { return classic::Fits(); });
  std::string notes;
  for (const Remark& note : programs.notes) notes += said(common_texts(), note) + "\n";
  EXPECT_NE(notes.find("Spare was tried, since names leave a choice, and cannot be used: static assertion failed: no "
                       "constructor that can be called with a count, or without arguments"),
            std::string::npos)
      << notes;
}

// Whatever a fault is like, it is told as what it is: features of answers say nothing of precision.
TEST(Classic, AKnownMistakeIsNamedAsTheCause) {
  const Assignment& whole = find_assignment("classic");
  std::vector<coursework::Test> tests;
  for (const coursework::Test& test : whole.tests)
    if (test.part == "pendulum") tests.push_back(test);
  Assignment pendulum = whole;
  pendulum.tests = tests;
  const std::vector<Mistake> known = mistakes_of(whole);
  const auto mistake = std::find_if(known.begin(), known.end(), [](const Mistake& m) { return m.part == "pendulum"; });
  ASSERT_NE(mistake, known.end());
  Submission submission = read_submission(whole.folder() / "solution", {});
  std::string& source = submission.files.at("pendulumSystem.cpp");
  source = with_mistake(source, *mistake);
  const GradeOptions options = options_for(whole, 7);
  const Result result = grade(pendulum, submission, *choose_sandbox("bare", true), options);
  int named = 0;
  for (const TestResult& test : result.tests)
    if (!test.cause.empty()) {
      ++named;
      EXPECT_NE(test.cause.find(options.own.of("mistake." + mistake->name)), std::string::npos)
          << test.id << test.cause;
    }
  EXPECT_GT(named, 0);
}

}  // namespace
}  // namespace coursework
