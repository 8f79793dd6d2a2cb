// A class: all of it graded, a table and statistics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/grade.h"
#include "tests/coursework/grader/layouts.h"

namespace coursework {

struct GradedSubmission {
  Result result;
  std::string failure;  // why it could not be graded
};

/// Grades all, options.jobs at a time. For each submission NAME.json and NAME.html are written to `out`; one that an
/// earlier run of this program finished with the same seed, sandbox and assignment, and that was not changed since, is
/// read instead. In the order of names.
std::vector<GradedSubmission> grade_class(const Assignment& assignment, const std::filesystem::path& folder,
                                          const Sandbox& sandbox, const GradeOptions& options,
                                          const std::filesystem::path& out);

/// One row per submission: points in all, per part (public and hidden together), and the first remark.
std::string class_csv(const Assignment& assignment, const std::vector<GradedSubmission>& all);
/// The same for the terminal, and below it the statistics.
std::string class_text(const Assignment& assignment, const std::vector<GradedSubmission>& all);

/// One row per test: how many passed, failed, were not graded, and the cause named most often.
std::string statistics_csv(const std::vector<GradedSubmission>& all);
/// The statistics as a page: tests, causes with those whose code shows them, and what was not graded.
std::string class_page(const Assignment& assignment, const std::vector<GradedSubmission>& all, const Texts& common);

/// A name for its files that no other submission has.
std::string file_name_for(const std::string& submission);

}  // namespace coursework
