// The lecturer's rubric: a TOML file that changes the points of tests, and sets those of single students.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/result.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {

struct Rubric {
  struct Override {
    std::string submission, test;
    double points = 0;
    std::string reason;
  };
  std::map<std::string, double> points;  // by test, public and hidden together; others are unchanged
  std::vector<Override> overrides;

  /// Changes points, earned points and reasons. Returns the end of a sentence on overrides that could not be applied
  /// because the submission was not graded; empty: none.
  std::string apply(Result& result) const;
};

/// Points of a test, public and hidden together, or of all tests if `test` is empty.
double points_of(const Assignment& assignment, const Rubric& rubric, const std::string& test = "");

/// Throws InputError with file, line and key, and the closest match for an unknown test or student. Students are
/// addressed by submission, id or name; unless `whole_class`, students who are not among `handed` are skipped.
Rubric read_rubric(const std::filesystem::path& file, const Assignment& assignment, const std::vector<Handed>& handed,
                   bool whole_class);

}  // namespace coursework
