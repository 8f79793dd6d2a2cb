// Files of known mistakes, and which of them a student's answers look like.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/build.h"

namespace coursework {

// Files of mistakes: one place of a solution, replaced. mistakes.txt, novel.txt and double.txt of an assignment.

/// Paragraphs `[name]`, `part: NAME`, `loses: IDS` (may be left out), then `<<<<`, the text, `====`, its replacement,
/// `>>>>`. Throws InputError that names file, line and what was expected.
std::vector<Mistake> read_mistakes(const std::filesystem::path& file);

/// Paragraphs `[name]`, `a: NAME`, `b: NAME`: pairs of mistakes made together. Throws InputError likewise.
std::vector<std::pair<std::string, std::string>> read_pairs(const std::filesystem::path& file);

/// The source with the mistake made. Throws InputError that names the mistake unless its text stands there exactly
/// once.
std::string with_mistake(const std::string& source, const Mistake& mistake);

// Which known mistake a student's answers look like.

/// One test of a part: its calls, and the student's answers, reduced where the test reduces.
struct TestRun {
  const Test* test = nullptr;
  std::vector<Case> cases;
  std::vector<Answer> answers;
};

/// The answer as it is compared with what is right.
Answer reduced(const Test& test, const Case& what, Answer raw);

/// Whether two wrong answers are the same one: the tolerance grows with the answers where they are larger than the
/// right ones, so that two ways to write one mistake agree on a motion that blows up.
bool agree(const Case& what, const Answer& student, const Answer& mistake);

/// The mistakes of `known` whose programs answer all that was asked as the student's did: one is the cause, several are
/// told as either; none where more than three do, as they say nothing then. `runs` are all the tests of one part.
std::vector<std::string> likely_causes(const Assignment& assignment, const std::string& part,
                                       const std::vector<TestRun>& runs, const std::vector<Mistake>& known,
                                       const Builder& builder, const Sandbox& trusted, unsigned jobs);

/// Those mistakes in words, as the likely cause or as either; that none is known where there are none.
std::string cause_text(const Texts& common, const Texts& own, const std::vector<std::string>& names);

}  // namespace coursework
