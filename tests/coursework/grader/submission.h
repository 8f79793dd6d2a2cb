// A submission is a folder or an archive, from which only the wanted files and their includes are read.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/grader/copies.h"

namespace coursework {

/// A message: a key of check/common.LANGUAGE.txt and the values to fill in.
struct Remark {
  std::string key;
  std::vector<std::string> with;
};

struct Submission {
  std::string name;
  std::map<std::string, std::string> files;  // contents: wanted files by name, own sources and headers by path
  std::map<std::string, Remark> missing;     // reasons why wanted files cannot be used
  std::vector<Remark> remarks;               // on the submission as a whole
  StudentChoice choice = {};                 // contents of the student's grade.toml
  bool python = false;                       // its parts are in Python
  bool refused = false;                      // nothing can be graded; the last remark has the reason
  // paths of the wanted files that differ from their names
  std::map<std::string, std::string> places = {};
};

/// Files among `files` (contents by path) that a file includes, directly or indirectly: the path at which the compiler
/// looks for each -> its path. An unresolved include matches the only file of that name.
std::map<std::string, std::string> own_includes(const std::map<std::string, std::string>& files,
                                                const std::string& path, const std::string& content);

struct Person {
  std::string name;     // as far as file names reveal it
  std::string id = {};  // empty: unknown
};

/// An item handed in by a person or a group: folders, archives and files, each with its original name.
struct Handed {
  std::string name;  // the author's name
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  std::string layout = {};          // "Moodle", "Canvas", "Gradescope"; empty: another
  std::vector<Person> people = {};  // one person, or a group
  bool late = false;
};

constexpr std::size_t largest_file = 1u << 20;    // byte, for a graded file
constexpr std::size_t largest_total = 64u << 20;  // byte, unpacked
constexpr std::size_t most_entries = 2000;
constexpr std::size_t longest_path = 200;  // byte, for files that keep their paths
constexpr int deepest_archive = 3;         // an archive in an archive in an archive
// limits of a whole program, all of which is compiled
constexpr std::size_t most_program_files = 200;
constexpr std::size_t largest_program = 4u << 20;  // byte, all C++ files together

/// Finds the wanted files in the top folder, in src/ and one folder below, the shallowest first, ignoring case. Backups
/// and older copies have lower priority (copies.h), and a file grade.toml overrides the choice; `roles` are the roles
/// for which it may name classes. If there are no such files but a single archive, reads that. If no file is wanted by
/// name, takes every C++ file that is not a library's, by its path. Never follows links. Throws InputError if there is
/// nothing at `path`; all errors of students become remarks instead.
Submission read_submission(const std::filesystem::path& path, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles = {});
Submission read_submission(const Handed& handed, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles = {});
/// The folder or archive at `path`, as handed in by one person. Throws InputError if there is none.
Handed handed_at(const std::filesystem::path& path);

/// True if the extension is that of an archive.
bool is_archive(const std::filesystem::path& file);

/// True if the extension is that of a C++ source or header.
bool is_cpp(const std::string& path);
bool is_python(const std::string& path);

// Matches the names in a submission with the wanted files; without wanted files every C++ file matches.

class FileMatcher {
 public:
  explicit FileMatcher(std::vector<std::string> wanted, std::vector<std::string> roles = {})
      : wanted_(std::move(wanted)), roles_(std::move(roles)) {}
  /// True for a wanted file in one of the searched folders ("src/rk4.cpp"), and for files that it may include.
  bool wants(const std::string& path) const { return !match(path).empty() || may_be_included(path); }
  void take(const std::string& path, std::string content);
  void refuse(const std::string& path, const std::string& key) {
    if (const std::string name = match(path); !name.empty()) found_[name].push_back({path, key, {}});
  }
  bool empty() const { return found_.empty(); }
  /// Reason to refuse a whole program as soon as it is too large; empty if files are wanted by name.
  std::optional<Remark> too_large() const;
  /// Depth limit for folders below the top one.
  int deepest() const { return wanted_.empty() ? 8 : 3; }
  /// Sets files, missing and remarks.
  void into(Submission& submission) const;

 private:
  struct Found {
    std::string path, refused, content;
  };
  std::string match(const std::string& path) const;
  bool may_be_included(const std::string& path) const;
  std::vector<std::string> paths() const;
  bool wants_python() const { return !wanted_.empty() && is_python(wanted_.front()); }
  void choose(Submission& submission) const;
  std::vector<std::string> wanted_, roles_;
  std::map<std::string, std::vector<Found>> found_;  // by wanted name, in the order met
  std::map<std::string, std::string> beside_;        // by path: files that wanted files may include
  std::size_t taken_ = 0, beside_size_ = 0;          // byte
};

/// True if the file is not a header.
bool is_source(const std::string& path);

/// The source with comments, strings and character literals replaced by blanks.
std::string code_of(std::string source);

/// The text with the name of each include, including its quotes or brackets, replaced by the result of `lead`; an empty
/// result leaves it unchanged.
std::string with_includes(const std::string& text,
                          const std::function<std::string(const std::string& name, bool in_brackets)>& lead);

std::string lower(std::string text);
/// The path component after the last slash.
std::string base_name(const std::string& path);

/// Number of folders below the top one; src/ does not count.
int depth_of(const std::string& path);

}  // namespace coursework
