// A lecturer's folders, and a check that nothing in them was touched.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/coursework/grader/staging.h"

namespace coursework {

/// A home folder that others may read, and, as on Gradescope, folders of mode 0700 with the results and with the course
/// (check/ and a1-steppers/). During the lifetime of this object, the grader uses this course.
class Canaries {
 public:
  Canaries();
  ~Canaries();
  std::filesystem::path home() const { return home_.path(); }
  std::filesystem::path results() const { return results_.path(); }
  std::filesystem::path tests() const;
  /// Everything that has been changed, added or removed in these folders, or left in world-writable folders, since
  /// construction.
  std::string harm() const;

 private:
  std::map<std::string, std::string> state() const;
  PrivateFolder home_, results_, course_;
  std::filesystem::path open_;  // a file of ours in a world-writable folder
  std::map<std::string, std::string> before_;
};

}  // namespace coursework
