// Files of known mistakes, and the mistakes that explain a student's answers.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/build.h"

namespace coursework {

// Files of mistakes: mistakes.txt, novel.txt and double.txt of an assignment.

/// Reads paragraphs `[name]`, `part: NAME`, `loses: IDS` (optional), then `<<<<`, the text, `====`, its replacement,
/// `>>>>`. Throws InputError with file, line and the expected syntax.
std::vector<Mistake> read_mistakes(const std::filesystem::path& file);

/// Reads paragraphs `[name]`, `a: NAME`, `b: NAME`: pairs of simultaneous mistakes. Throws InputError like
/// read_mistakes().
std::vector<std::pair<std::string, std::string>> read_pairs(const std::filesystem::path& file);

/// The source with the mistake applied. Throws InputError with the mistake's name unless the text to replace occurs
/// exactly once.
std::string with_mistake(const std::string& source, const Mistake& mistake);

/// One test of a part: its calls, and the student's answers after the test's reduction.
struct TestRun {
  const Test* test = nullptr;
  std::vector<Case> cases;
  std::vector<Answer> answers;
};

/// The answer in the form that is compared with the expected answer.
Answer reduced(const Test& test, const Case& what, Answer raw);

/// True if two wrong answers agree. The tolerance is larger if the answers exceed the right ones, so that two
/// implementations of the same mistake agree even if the motion blows up.
bool agree(const Case& what, const Answer& student, const Answer& mistake);

/// The mistakes of `known` whose programs give all of the student's answers. A single mistake is the cause; several are
/// reported as alternatives. Empty if more than three match, because so many do not help. `runs` are all tests of one
/// part.
std::vector<std::string> likely_causes(const Assignment& assignment, const std::string& part,
                                       const std::vector<TestRun>& runs, const std::vector<Mistake>& known,
                                       const Builder& builder, const Sandbox& trusted, unsigned jobs);

/// Text that reports the mistakes `names` as the likely cause or as alternatives, or, if there are none, that no known
/// mistake matches.
std::string cause_text(const Texts& common, const Texts& own, const std::vector<std::string>& names);

}  // namespace coursework
