// The lecturer's own points: a TOML file that changes the points of tests, and sets those of single students.
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
  std::map<std::string, double> points;  // by test, public and hidden together; others keep theirs
  std::vector<Override> overrides;

  /// Changes points, earned points and reasons. Returns what could not be done, since nothing of the submission was
  /// graded, as the end of a sentence; empty: nothing.
  std::string apply(Result& result) const;
};

/// Points of a test, public and hidden together, or of all tests.
double points_of(const Assignment& assignment, const Rubric& rubric, const std::string& test = "");

/// Throws InputError that names file, line and key, with the closest match for an unknown test or student. Students are
/// named by submission, id or name; unless `whole_class`, those who are not among `handed` are skipped.
Rubric read_rubric(const std::filesystem::path& file, const Assignment& assignment, const std::vector<Handed>& handed,
                   bool whole_class);

}  // namespace coursework
