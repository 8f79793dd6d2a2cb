// Whole programs that fail in one class: each failure has its message, and the other parts still earn points.
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

/// The assignment with only one test of each of the last two parts.
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
  std::vector<std::array<const char*, 3>> changes;  // file, text that occurs once, replacement
  const char* says;
};

// grade_test.cpp covers failures that may also occur in the smallest assignment.
TEST(Classic, EveryWayToFailHasItsMessageAndCostsItsOwnPart) {
  const Assignment& whole = find_assignment("classic");
  const Short few(whole);
  const auto sandbox = choose_sandbox("bare", true);
  const Submission solution = read_submission(whole.folder() / "solution", {});
  const Failing table[] = {
      {"a constructor that nobody can call",
       {{"ClothSystem.h", "ClothSystem();", "ClothSystem(const char* file);"},
        {"ClothSystem.cpp", "::ClothSystem()", "::ClothSystem(const char*)"}},
       "ClothSystem (ClothSystem.h) does not compile where the tests use it: "},
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

std::string said_of(const classic::Files& files, const std::string& part) {
  const crosscheck::TemporaryFolder scratch("test");
  const Compiler compiler;
  const auto sandbox = choose_sandbox("bare", true);
  std::vector<std::string> command = compiler.command();
  command.insert(command.end(), {"-c", (folder_of_coursework() / "check/child_main.cpp").string(), "-o",
                                 (scratch.path / "child.o").string()});
  compile_ours(*sandbox, command, scratch.path, "child_main.cpp");
  const classic::Programs programs = classic::build_programs(
      files, scratch.path / "tree", folder_of_coursework(), *sandbox,
      {compiler.command(), "/usr/bin/ar", scratch.path / "child.o"}, {part}, [](const auto&, const auto&) {
        return classic::Earned{0, 1};
      });
  std::string text;
  for (const Remark& note : programs.notes) text += said(common_texts(), note) + "\n";
  const Built& built = programs.of.at(part);
  return text + (built.program.empty() ? said(common_texts(), built.error) : "built");
}

classic::Files base_and(const std::string& name, const std::string& text) {
  const std::filesystem::path solution = find_assignment("classic").folder() / "solution";
  classic::Files files = {{name, text}};
  for (const char* shared : {"particleSystem.h", "particleSystem.cpp", "TimeStepper.hpp"})
    files[shared] = content_of_file(solution / shared);
  return files;
}

TEST(Classic, WhatKeepsAClassFromBeingUsedIsToldWithoutDenyingIt) {
  const std::string begin = "#include \"particleSystem.h\"\nclass SimpleSystem : public ParticleSystem {\n",
                    draws = " public:\n  void draw() {}\n", end = "};\n";
  const std::string evalF = "  vector<Vector3f> evalF(vector<Vector3f> state)";
  struct {
    std::string text, says;
  } const table[] = {
      {begin + "  SimpleSystem() {}\n" + draws + evalF + " { return state; }\n" + end,
       "no constructor that can be called"},
      {begin + draws + evalF + " const { return state; }\n" + end, "the class is abstract"},
      {begin + draws + "  SimpleSystem();\n" + evalF + " { return state; }\n" + end,
       "SimpleSystem::SimpleSystem() is declared, but no file of yours that compiles"},
      {begin + draws + evalF + ";\n" + end, "No file of yours that compiles"},
      {"template <class T> " + begin.substr(begin.find("class")) + draws + end,
       "SimpleSystem (simple.h) does not compile"},
      {begin + draws + "  vector<Vector3f> SimpleSystem::evalF(vector<Vector3f> state) { return state; }\n" + end,
       "built"},
  };
  for (const auto& [text, says] : table) {
    const std::string said = said_of(base_and("simple.h", text), "simple");
    EXPECT_NE(said.find(says), std::string::npos) << text << " " << said;
    EXPECT_EQ(said.find("No class called"), std::string::npos) << said;
    EXPECT_EQ(said.find("vtable"), std::string::npos) << said;
    EXPECT_EQ(said.find("simpleSystem.cpp"), std::string::npos) << "a file that was not handed in: " << said;
  }
  EXPECT_NE(said_of(base_and("other.h", "struct Other {};"), "simple").find("No class called SimpleSystem was found"),
            std::string::npos);
}

// The report names the actual mistake, even if its answers resemble those of another cause such as single precision.
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
