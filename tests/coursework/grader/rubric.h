// The lecturer's rubric: a TOML file that changes the points of tests, and sets points of individual students.
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
  std::map<std::string, double> points;  // test -> points, public and hidden together; other tests are unchanged
  std::vector<Override> overrides;

  /// Changes points, earned points and reasons. Returns the end of a sentence about overrides that could not be applied
  /// because the submission was not graded, or an empty string.
  std::string apply(Result& result) const;
};

/// Points of a test, public and hidden together, or sum of all tests if `test` is empty.
double points_of(const Assignment& assignment, const Rubric& rubric, const std::string& test = "");

/// Reads a rubric. Throws InputError with file, line and key, and with the closest match for an unknown test or
/// student. Students are identified by submission, id or name. Unless `whole_class`, skips students who are not among
/// `handed`.
Rubric read_rubric(const std::filesystem::path& file, const Assignment& assignment, const std::vector<Handed>& handed,
                   bool whole_class);

}  // namespace coursework
