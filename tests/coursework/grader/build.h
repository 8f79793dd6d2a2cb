// Programs around a part: the student's in a lane, ours from a cache.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/lane.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {

struct Built {
  std::filesystem::path program;   // empty: there is none
  Remark error = {};               // why
  bool missing = false;            // it was not handed in; else it does not compile
  std::vector<Remark> notes = {};  // what else is to be said before any test
};

/// How an assignment's submissions become one program per part. `trusted` runs the compiler on sources of ours, `lane`
/// on a student's.
class Builder {
 public:
  virtual ~Builder() = default;

  /// The part's program with this source of ours in the part's place (its solution, a known mistake). Compiled at most
  /// once for the same contents. Throws std::runtime_error with the compiler's words.
  virtual std::filesystem::path ours(const std::string& part, const std::string& source) const = 0;

  /// Every part's program with what the student wrote, compiled in the lane within `folder`, which need not exist;
  /// `jobs` compilers at a time.
  virtual std::map<std::string, Built> theirs(const Submission& submission, const std::filesystem::path& folder,
                                              unsigned jobs) const = 0;

  /// A part's file within the folder of a solution.
  virtual std::string file_of(const std::string& part) const { return part + ".cpp"; }
};

/// As the assignment says. Throws InputError when there is no C++ compiler.
std::unique_ptr<Builder> builder_for(const Assignment& assignment, const Lane& trusted, const Lane& lane);

std::filesystem::path solution_of(const Assignment& assignment, const Builder& builder, const std::string& part);

std::string content_of_file(const std::filesystem::path& file);

}  // namespace coursework
