// A class: every entry of a folder is a submission.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/grade.h"

namespace coursework {

struct Graded {
  Result result;
  std::string failure;  // why it could not be graded
};

/// Grades all, options.jobs at a time. For each submission NAME.json and NAME.html are written to `out`; one that an
/// earlier run of this program finished with the same seed, lane and assignment, and that was not changed since, is
/// read instead. In the order of names.
std::vector<Graded> grade_class(const Assignment& assignment, const std::filesystem::path& folder, const Lane& lane,
                                const GradeOptions& options, const std::filesystem::path& out);

/// One row per submission: points in all, per part (public and hidden together), and the first remark.
std::string class_csv(const Assignment& assignment, const std::vector<Graded>& all);
std::string class_text(const Assignment& assignment, const std::vector<Graded>& all);

/// A name for its files that no other submission has.
std::string file_name_for(const std::string& submission);

}  // namespace coursework
