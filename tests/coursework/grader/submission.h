// A submission is a folder or an archive, from which only the wanted files are read, and what they include.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/grader/copies.h"

namespace coursework {

/// A sentence to be said: a key of check/common.LANGUAGE.txt and what fills it in.
struct Remark {
  std::string key;
  std::vector<std::string> with;
};

struct Submission {
  std::string name;
  std::map<std::string, std::string> files;  // contents: wanted files by name, own sources and headers by path
  std::map<std::string, Remark> missing;     // why a wanted file cannot be used
  std::vector<Remark> remarks;               // on the whole
  StudentChoice choice = {};                 // what the student's grade.toml says
  bool refused = false;                      // nothing of it can be graded; the last remark says why
  // paths of the wanted files, where they differ from their names
  std::map<std::string, std::string> places = {};
};

/// Those of `files` (contents by path) that a file includes, directly or through others: the place where the compiler
/// looks for each, and its path. An include that leads nowhere is met by the only file of that name.
std::map<std::string, std::string> own_includes(const std::map<std::string, std::string>& files,
                                                const std::string& path, const std::string& content);

struct Person {
  std::string name;     // as far as names of files tell
  std::string id = {};  // empty: unknown
};

/// What somebody handed in: folders, archives and files, each with the name that the student gave it.
struct Handed {
  std::string name;  // whose it is
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  std::string layout = {};          // "Moodle", "Canvas", "Gradescope"; empty: another
  std::vector<Person> people = {};  // one, or a group
  bool late = false;
};

constexpr std::size_t largest_file = 1u << 20;    // byte, of a file that is graded
constexpr std::size_t largest_total = 64u << 20;  // byte, unpacked
constexpr std::size_t most_entries = 2000;
constexpr std::size_t longest_path = 200;  // byte, of files that are laid out as they were handed in
constexpr int deepest_archive = 3;         // an archive in an archive in an archive
// of a whole program, all of which is compiled
constexpr std::size_t most_program_files = 200;
constexpr std::size_t largest_program = 4u << 20;  // byte, of its C++ files together

/// Takes the wanted files, looked for in the top folder, in src/ and one folder below, the shallowest first; letters'
/// case may differ. Backups and older copies stand behind (copies.h), and a file grade.toml chooses; `roles` are what
/// it may name classes for. Where none is there, but one archive is, takes them out of that. Where none is wanted by
/// name, takes every C++ file that is no library's, by its path. Links are never followed. Throws InputError when there
/// is nothing at `path`; all that a student may have done wrong becomes a remark instead.
Submission read_submission(const std::filesystem::path& path, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles = {});
Submission read_submission(const Handed& handed, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles = {});

/// By its ending.
bool is_archive(const std::filesystem::path& file);

// Matches the names in a submission with the wanted files; without wanted files every C++ file matches.

class FileMatcher {
 public:
  explicit FileMatcher(std::vector<std::string> wanted, std::vector<std::string> roles = {})
      : wanted_(std::move(wanted)), roles_(std::move(roles)) {}
  /// True for a wanted file in one of the folders that are searched ("src/rk4.cpp"), and for files that it may include.
  bool wants(const std::string& path) const { return !match(path).empty() || may_be_included(path); }
  void take(const std::string& path, std::string content);
  void refuse(const std::string& path, const std::string& key) {
    if (const std::string name = match(path); !name.empty()) found_[name].push_back({path, key, {}});
  }
  bool empty() const { return found_.empty(); }
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
  bool may_be_included(const std::string& path) const;
  void choose(Submission& submission) const;
  std::vector<std::string> wanted_, roles_;
  std::map<std::string, std::vector<Found>> found_;  // by wanted name, in the order met
  std::map<std::string, std::string> beside_;        // by path: what wanted files may include
  std::size_t taken_ = 0, beside_size_ = 0;          // byte
};

/// By its ending.
bool is_cpp(const std::string& path);
/// No header.
bool is_source(const std::string& path);

std::string lower(std::string text);
/// What stands behind the last slash.
std::string base_name(const std::string& path);

/// Steps below the top folder; src/ counts for nothing.
int depth_of(const std::string& path);

}  // namespace coursework
