// What of a submission was not meant to be graded: backups, older copies, libraries; and the student's own word on it,
// the file grade.toml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coursework {

/// The path without what copying adds to its last name: "src/a - Copy (2).cpp", "src/Copy of a.cpp" and "src/a_old.cpp"
/// are all "src/a.cpp". The path itself where nothing was added.
std::string without_copy_marks(const std::string& path);
/// Whether the name says that it is a copy, or a folder above does ("old/", "backup/", "src (1)/").
bool is_backup(const std::string& path);
/// Whether a folder above holds somebody else's library ("glfw-3.1.2/", "eigen/") or what a build left.
bool in_library(const std::string& path);

/// The text as UTF-8 without a mark at its start; UTF-16 with such a mark is converted, as some editors save it, and
/// GB18030 (with it GBK and GB2312): in these the second byte of a letter may be the backslash that continues a
/// comment.
std::string plain_utf8(std::string text);

/// Of two files that take each other's place, the one that stands in the fuller copy of the whole. `weight` is how much
/// a path counts: a copy is all that lies in the folder where the two paths part.
class FullerCopy {
 public:
  explicit FullerCopy(std::map<std::string, double> weights) : weights_(std::move(weights)) {}
  /// No backup before backups, then the fuller copy, the shallower file, the alphabet.
  bool operator()(const std::string& a, const std::string& b) const;

 private:
  double weight_of(const std::string& folder, const std::string& apart_from) const;
  std::map<std::string, double> weights_;  // by path
};

/// grade.toml.
struct StudentChoice {
  std::string folder;                          // the one that counts, with '/' at its end; empty: all
  std::vector<std::string> left_out;           // files, or folders
  std::map<std::string, std::string> classes;  // role ("chain") -> class

  bool takes(const std::string& path) const;
};
constexpr const char* choice_file = "grade.toml";
constexpr std::size_t largest_choice = 1u << 14;  // byte

/// Throws crosscheck::InputError that names line and key: no TOML, a key that is none, a folder or file that is not
/// among `paths`, classes where `roles` is empty, a role that is none of them.
StudentChoice read_choice(const std::string& text, const std::vector<std::string>& paths,
                          const std::vector<std::string>& roles);

}  // namespace coursework
