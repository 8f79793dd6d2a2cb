// Grades a submission.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/result.h"
#include "tests/coursework/grader/run.h"
#include "tests/coursework/grader/sandbox.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {

struct GradeOptions {
  std::uint64_t seed = 0;                    // of the hidden tests
  bool secret = false;                       // it was made from the lecturer's secret
  Texts common, own;                         // check/common.LANGUAGE.txt; the assignment's texts
  unsigned jobs = 1;                         // compilers at a time
  double least_cpu = coursework::least_cpu;  // s, that the calls of a test may take in any case (run.h)
  std::string engines;  // folder in which parts are left as engines, where the assignment has such; empty: nowhere
  std::set<std::string, std::less<>> parts = {};  // parts whose tests are run; empty: all
  /// Called with what there is so far: before the first test, after every test, and at the end.
  std::function<void(const Result&)> on_progress = [](const Result&) {};
};

/// Runs all tests, public ones first; points start at 0 and are earned. What a student may have done wrong is said in
/// the result; throws std::runtime_error only for what is wrong on our side.
Result grade(const Assignment& assignment, const Submission& submission, const Sandbox& sandbox,
             const GradeOptions& options);

/// The files that the assignment asks for: one per part; none where it takes a whole program.
std::vector<std::string> wanted_files(const Assignment& assignment);

/// read_submission() with what the assignment asks for.
Submission submission_at(const std::filesystem::path& path, const Assignment& assignment);
Submission submission_of(const Handed& handed, const Assignment& assignment);

/// The cases of a test as the hand-out has them: those of its seed, which depends on the assignment and the test alone;
/// before them, where the texts lay out what is given, the same in round numbers, so that the first that fails can be
/// worked out on paper.
std::vector<Case> public_cases(const Assignment& assignment, const Test& test);
/// What a test that fails is asked as well, in round numbers: see Test::small; then the same in others, for what is
/// seen in one case alone may be chance.
std::vector<Case> small_cases(const Assignment& assignment, const Test& test);
std::uint64_t public_seed(const Assignment& assignment, const Test& test);
/// The seed of a hidden test, from that of all hidden tests.
std::uint64_t hidden_seed(std::uint64_t seed, const Test& test);

/// A remark as a sentence.
std::string said(const Texts& common, const Remark& remark);

}  // namespace coursework
