// Folders of a lecturer, and whether anything in them was touched.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/coursework/grader/staging.h"

namespace coursework {

/// A home that others may read, and as Gradescope has them folders of mode 0700 with the results and with the course
/// (check/ and a1-steppers/), which the grader uses while this lives.
class Canaries {
 public:
  Canaries();
  ~Canaries();
  std::filesystem::path home() const { return home_.path(); }
  std::filesystem::path results() const { return results_.path(); }
  std::filesystem::path tests() const;
  /// What was changed, added or removed there or left in the folders open to all since the beginning; empty: nothing.
  std::string harm() const;

 private:
  std::map<std::string, std::string> state() const;
  PrivateFolder home_, results_, course_;
  std::filesystem::path open_;  // a file of ours in a folder that is open to all
  std::map<std::string, std::string> before_;
};

}  // namespace coursework
