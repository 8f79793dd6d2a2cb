// What a student handed in: a folder, zip or tar, from which only the files asked for by name are taken.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace coursework {

/// A sentence to be said: a key of check/common.LANGUAGE.txt and what fills it in.
struct Remark {
  std::string key;
  std::vector<std::string> with;
};

struct Submission {
  std::string name;
  std::map<std::string, std::string> files;  // content of those that were asked for and found, by name
  std::map<std::string, Remark> missing;     // why one that was asked for cannot be used
  std::vector<Remark> remarks;               // on the whole; where it is refused, nothing of it is in `files`
};

constexpr std::size_t largest_file = 1u << 20;    // byte, of a file that is graded
constexpr std::size_t largest_total = 64u << 20;  // byte, unpacked
constexpr std::size_t most_entries = 2000;
// of a whole program, all of which is compiled
constexpr std::size_t most_program_files = 200;
constexpr std::size_t largest_program = 4u << 20;  // byte, of its C++ files together

/// Takes the wanted files, looked for in the top folder, in src/ and one folder below, the shallowest first; letters'
/// case may differ. Where none is wanted by name, takes every C++ file, by its path. Links are never followed. Throws
/// InputError when there is nothing at `path`; all that a student may have done wrong becomes a remark instead.
Submission read_submission(const std::filesystem::path& path, const std::vector<std::string>& wanted);

}  // namespace coursework
