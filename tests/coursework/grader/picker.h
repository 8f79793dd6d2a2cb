// Chooses among the names in a submission those that were asked for, or all C++ files where none was. Knows neither
// folders nor archives.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/grader/submission.h"

namespace coursework {

class Picker {
 public:
  explicit Picker(std::vector<std::string> wanted) : wanted_(std::move(wanted)) {}
  /// Whether the file at this path ("src/rk4.cpp") is one that was asked for and stands where it is looked for.
  bool wants(const std::string& path) const { return !match(path).empty(); }
  void take(const std::string& path, std::string content);
  void refuse(const std::string& path, const std::string& key) { found_[match(path)].push_back({path, key, {}}); }
  /// Why a whole program is refused as soon as it is too large; never where files are wanted by name.
  std::optional<Remark> too_large() const;
  /// Folders below the top one that need not be looked into.
  int deepest() const { return wanted_.empty() ? 8 : 3; }
  /// Fills in files, missing and remarks.
  void into(Submission& submission) const;

 private:
  struct Found {
    std::string path, refused, content;
  };
  std::string match(const std::string& path) const;
  std::vector<std::string> wanted_;
  std::map<std::string, std::vector<Found>> found_;  // by wanted name, in the order met
  std::size_t taken_ = 0;                            // byte
};

/// By its ending.
bool is_cpp(const std::string& path);

/// Steps below the top folder; src/ counts for nothing.
int depth_of(const std::string& path);

}  // namespace coursework
