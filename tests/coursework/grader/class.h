// A class: all of it graded, a table and statistics.
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
  Result result;        // with the points of the rubric
  std::string failure;  // why it could not be graded
  std::string id;       // the student's, or those of a group; empty: unknown
  bool late = false;
  std::vector<std::string> moved;  // points of tests that were graded again, if they changed: "2.4 3 -> 5"
};

/// Grades all, options.jobs at a time. For each submission NAME.json (before the rubric) and NAME.html are written to
/// `out`; one that an earlier run of this program finished with the same seed, sandbox and assignment, and that was not
/// changed since, is read instead. `only`: tests that are graded again where an earlier result of the same files, seed
/// and sandbox exists, whatever program and assignment it is of; the rest of it stays, and all results are written at
/// the end. In the order of names.
std::vector<GradedSubmission> grade_class(const Assignment& assignment, const std::vector<Handed>& submissions,
                                          const Sandbox& sandbox, const GradeOptions& options,
                                          const std::filesystem::path& out, const Rubric& rubric = {},
                                          const std::set<std::string>& only = {});

/// The tests that one of the patterns of shells names, by number or part. Throws InputError "--only PATTERN: ...".
std::set<std::string> tests_named(const Assignment& assignment, const std::vector<std::string>& patterns);

/// One row per submission: whose, whether it came late, points in all and per part (public and hidden together), and
/// the first remark.
std::string class_csv(const Assignment& assignment, const std::vector<GradedSubmission>& all);
/// Points of the tests of a part, of all parts if it is empty; nothing if any of them could not be graded.
std::string points_in(const GradedSubmission& one, std::string_view part = "");
/// Why it or one of its tests was not graded, or what was said first of its files.
std::string remark_of(const GradedSubmission& one);

/// The same for the terminal, and below it the statistics.
std::string class_text(const Assignment& assignment, const std::vector<GradedSubmission>& all);

/// One row per test: how many passed, failed, were not graded, and the cause named most often.
std::string statistics_csv(const std::vector<GradedSubmission>& all);
/// The statistics as a page: tests, causes with those whose code shows them, what was not graded, and all
/// submissions.
std::string class_page(const Assignment& assignment, const std::vector<GradedSubmission>& all, const Texts& common);

/// A name for its files that no other submission has.
std::string file_name_for(const std::string& submission);

}  // namespace coursework
