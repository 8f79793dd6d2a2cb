// A lecturer's folders, and a check that nothing in them was touched.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/coursework/grader/staging.h"

namespace coursework {

/// A home that others may read, and, as on Gradescope, folders of mode 0700 with the results and the course (check/ and
/// a1-steppers/), which the grader uses during the lifetime of this object.
class Canaries {
 public:
  Canaries();
  ~Canaries();
  std::filesystem::path home() const { return home_.path(); }
  std::filesystem::path results() const { return results_.path(); }
  std::filesystem::path tests() const;
  /// Everything changed, added or removed there, or left in world-writable folders, since construction.
  std::string harm() const;

 private:
  std::map<std::string, std::string> state() const;
  PrivateFolder home_, results_, course_;
  std::filesystem::path open_;  // a file of ours in a world-writable folder
  std::map<std::string, std::string> before_;
};

}  // namespace coursework
