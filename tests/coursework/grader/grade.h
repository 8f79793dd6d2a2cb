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
  std::uint64_t seed = 0;                    // for the hidden tests
  bool secret = false;                       // derived from the lecturer's secret
  Texts common, own;                         // texts in check/common.LANGUAGE.txt; the assignment's texts
  unsigned jobs = 1;                         // number of parallel compilers
  double least_cpu = coursework::least_cpu;  // s, lower bound of the time limit for the calls of a test (run.h)
  std::string engines;  // output folder for parts as engines; empty if not wanted or not supported by the assignment
  std::set<std::string, std::less<>> parts = {};  // parts whose tests are run; all parts if empty
  /// Called with the partial result: before the first test, after every test, and at the end.
  std::function<void(const Result&)> on_progress = [](const Result&) {};
};

/// Runs all tests, public ones first; points start at 0. A student's errors are part of the result. Throws
/// std::runtime_error only for errors on our side.
Result grade(const Assignment& assignment, const Submission& submission, const Sandbox& sandbox,
             const GradeOptions& options);

/// The files that the assignment requires: one per part, or none if students hand in a whole program.
std::vector<std::string> wanted_files(const Assignment& assignment);

/// read_submission() with the assignment's parameters.
Submission submission_at(const std::filesystem::path& path, const Assignment& assignment);
Submission submission_of(const Handed& handed, const Assignment& assignment);

/// The public cases of a test, as in the hand-out, from a seed that depends only on the assignment and the test. If the
/// texts declare the layout of inputs, the first cases have round numbers, so that students can compute the first
/// failing case by hand.
std::vector<Case> public_cases(const Assignment& assignment, const Test& test);
/// Small cases of a test (see Test::small), first with round numbers, then with random ones, because an observation on
/// a single case may be due to chance.
std::vector<Case> small_cases(const Assignment& assignment, const Test& test);
std::uint64_t public_seed(const Assignment& assignment, const Test& test);
/// The seed of a hidden test, derived from the seed of all hidden tests.
std::uint64_t hidden_seed(std::uint64_t seed, const Test& test);

/// A remark as a sentence.
std::string said(const Texts& common, const Remark& remark);

}  // namespace coursework
