// Grades a whole class, and writes its table and statistics.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/layouts.h"
#include "tests/coursework/grader/rubric.h"

namespace coursework {

struct GradedSubmission {
  Result result;        // including the rubric's changes
  std::string failure;  // reason, if the submission could not be graded
  std::string id;       // the student's id, or the ids of a group; empty if unknown
  bool late = false;
  std::vector<std::string> moved;  // changed points of regraded tests: "2.4 3 -> 5"
};

/// Grades all submissions in the order of names, options.jobs in parallel. Writes NAME.json (before the rubric) and
/// NAME.html of each submission to `out`. If a submission is unchanged, reuses its complete result of an earlier run of
/// the same program with the same seed, sandbox and assignment. `only`: tests to grade again in submissions with an
/// earlier result for the same files, seed and sandbox (any version of program and assignment). Other tests keep their
/// results. Regraded results are written after all submissions have been graded.
std::vector<GradedSubmission> grade_class(const Assignment& assignment, const std::vector<Handed>& submissions,
                                          const Sandbox& sandbox, const GradeOptions& options,
                                          const std::filesystem::path& out, const Rubric& rubric = {},
                                          const std::set<std::string>& only = {});

/// The tests whose number or part matches one of the shell patterns. Throws InputError "--only PATTERN: ...".
std::set<std::string> tests_named(const Assignment& assignment, const std::vector<std::string>& patterns);

/// One row per submission: name, id, lateness, total points and points per part (public and hidden together), remark.
std::string class_csv(const Assignment& assignment, const std::vector<GradedSubmission>& all);
/// Text of the points in a part, or in all parts if `part` is empty; empty if any test could not be graded.
std::string points_in(const GradedSubmission& one, std::string_view part = "");
/// The reason why the submission or one of its tests was not graded, otherwise Result::remark.
std::string remark_of(const GradedSubmission& one);

/// The table for the terminal, followed by the statistics.
std::string class_text(const Assignment& assignment, const std::vector<GradedSubmission>& all);

/// One row per test: number of passed, failed and ungraded submissions, and the most frequent cause.
std::string statistics_csv(const std::vector<GradedSubmission>& all);
/// The statistics as a page: tests, causes with the submissions that show them, and all submissions.
std::string class_page(const Assignment& assignment, const std::vector<GradedSubmission>& all, const Texts& common);

/// A unique base name for the submission's files.
std::string file_name_for(const std::string& submission);

}  // namespace coursework
