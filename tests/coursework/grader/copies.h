// Recognises backups, older copies and libraries in a submission, and reads grade.toml, the student's choice of files.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace coursework {

/// The path without copy marks in its last component: "src/a - Copy (2).cpp", "src/Copy of a.cpp" and "src/a_old.cpp"
/// all become "src/a.cpp". Other paths are returned unchanged.
std::string without_copy_marks(const std::string& path);
/// True if the file's name, or the name of a folder above it ("old/", "backup/", "src (1)/"), marks a copy.
bool is_backup(const std::string& path);
/// True if a folder above the file contains a third-party library ("glfw-3.1.2/", "eigen/") or build output.
bool in_library(const std::string& path);

bool is_utf8(std::string_view text);
/// The text as UTF-8 without a byte-order mark. Converts UTF-16 with a byte-order mark, which some editors write, and
/// GB18030 (which includes GBK and GB2312). Unconverted, the second byte of a GB18030 character may be a backslash,
/// which would extend a comment to the next line.
std::string plain_utf8(std::string text);

/// Order of two versions of a file: prefers the version in the copy with more files. The copy of a version is its
/// topmost folder that the other version's path does not share, with everything in it.
class FullerCopy {
 public:
  explicit FullerCopy(std::vector<std::string> paths) : paths_(std::move(paths)) {}
  /// Returns true if `a` is preferred. Criteria in order: not a backup, fuller copy, fewer folders, alphabetical order.
  bool operator()(const std::string& a, const std::string& b) const;

 private:
  std::ptrdiff_t files_in(const std::string& folder, const std::string& apart_from) const;
  std::vector<std::string> paths_;
};

/// Contents of grade.toml.
struct StudentChoice {
  std::string folder;                          // the folder to grade, with a trailing slash; empty for all folders
  std::vector<std::string> left_out;           // files or folders
  std::map<std::string, std::string> classes;  // role ("chain") -> class

  bool takes(const std::string& path) const;
};
constexpr const char* choice_file = "grade.toml";
constexpr std::size_t largest_choice = 1u << 14;  // byte

/// Parses the text of grade.toml. Throws crosscheck::InputError with line and key for invalid TOML, an unknown key, a
/// folder or file that is not among `paths`, classes if `roles` is empty, or an unknown role.
StudentChoice read_choice(const std::string& text, const std::vector<std::string>& paths,
                          const std::vector<std::string>& roles);

}  // namespace coursework
