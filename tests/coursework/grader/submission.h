// Reads a submission, a folder or an archive. Only the wanted files and their includes are read.
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
  std::map<std::string, std::string> files;  // contents: wanted files by name; other sources and headers by path
  std::map<std::string, Remark> missing;     // reasons why wanted files cannot be used
  std::vector<Remark> remarks;               // on the submission as a whole
  StudentChoice choice = {};                 // contents of the student's grade.toml
  bool python = false;                       // the parts are in Python
  bool refused = false;                      // nothing can be graded; the last remark is the reason
  // name of a wanted file -> its path, unless the path is too long
  std::map<std::string, std::string> places = {};
};

/// Files that the file at `path` includes, directly or indirectly, among `files` (contents by path). Maps the path at
/// which the compiler looks for a file to the file's actual path. If there is no file at the path of an include, the
/// file of that name elsewhere is taken, provided that it is the only one.
std::map<std::string, std::string> own_includes(const std::map<std::string, std::string>& files,
                                                const std::string& path, const std::string& content);

struct Person {
  std::string name;     // as far as file names reveal it
  std::string id = {};  // empty if unknown
};

/// An item handed in by a person or a group: folders, archives and files, each with its original name.
struct Handed {
  std::string name;  // the author's name
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  std::string layout = {};          // "Moodle", "Canvas", "Gradescope", or empty
  std::vector<Person> people = {};  // one person, or a group
  bool late = false;
};

constexpr std::size_t largest_file = 1u << 20;    // bytes, for a graded file
constexpr std::size_t largest_total = 64u << 20;  // byte, unpacked
constexpr std::size_t most_entries = 2000;
constexpr std::size_t longest_path = 200;  // bytes, for files that keep their paths
constexpr int deepest_archive = 3;         // an archive in an archive in an archive is read
// limits of a whole program, all of which is compiled
constexpr std::size_t most_program_files = 200;
constexpr std::size_t largest_program = 4u << 20;  // bytes, all C++ files together

/// Finds the wanted files in the top folder, in src/ and one folder below, ignoring case; prefers files in the fewest
/// folders. Backups and older copies have lower priority (copies.h). The student's file grade.toml overrides the
/// choice, and may name classes for `roles`. If no wanted file is found, but a single archive, reads that archive. If
/// no file is wanted by name, reads every C++ file that is not part of a library, and names it by its path. Never
/// follows links. Throws InputError if there is nothing at `path`; all errors of students become remarks.
Submission read_submission(const std::filesystem::path& path, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles = {});
Submission read_submission(const Handed& handed, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& roles = {});
/// The folder or archive at `path`, as handed in by one person. Throws InputError if it does not exist.
Handed handed_at(const std::filesystem::path& path);

/// True if the extension is that of an archive.
bool is_archive(const std::filesystem::path& file);

/// True if the extension is that of a C++ source or header.
bool is_cpp(const std::string& path);
bool is_python(const std::string& path);

// Finds the wanted files among the files of a submission. Without wanted files every C++ file matches.

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
  /// Reason to refuse a whole program as soon as it is too large; nullopt if files are wanted by name.
  std::optional<Remark> too_large() const;
  /// Greatest depth at which folders are searched.
  int deepest() const { return wanted_.empty() ? 8 : 3; }
  /// Sets the submission's files, missing files and remarks.
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
  std::map<std::string, std::vector<Found>> found_;  // wanted name -> files in the order of reading
  std::map<std::string, std::string> beside_;        // path -> content of headers that the wanted files may include
  std::size_t taken_ = 0, beside_size_ = 0;          // byte
};

/// True if the file is not a header.
bool is_source(const std::string& path);

/// The source with comments, strings and character literals replaced by blanks.
std::string code_of(std::string source);

/// The text, in which the name of each include (with its quotes or brackets) is replaced by the result of `lead`. If
/// the result is empty, the name remains unchanged.
std::string with_includes(const std::string& text,
                          const std::function<std::string(const std::string& name, bool in_brackets)>& lead);

std::string lower(std::string text);
std::string base_name(const std::string& path);

/// Number of folders below the top one, without src/.
int depth_of(const std::string& path);

}  // namespace coursework
