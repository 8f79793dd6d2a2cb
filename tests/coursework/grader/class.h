// A class: who handed in what in a folder that was exported from somewhere, all of it graded, a table and statistics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/grade.h"

namespace coursework {

/// Who handed in what, in the order of names. What Moodle, Canvas and Gradescope put into names of files is taken off;
/// several files of one person are one submission. Otherwise every entry is a submission. Entries that begin with a dot
/// are none.
std::vector<Handed> submissions_in(const std::filesystem::path& folder);

/// Why a folder that should be one submission looks like a class ("Moodle", "Canvas", "Gradescope", "Git",
/// "folders"); empty: it does not.
std::string class_layout(const std::filesystem::path& folder, const std::vector<std::string>& wanted);

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
