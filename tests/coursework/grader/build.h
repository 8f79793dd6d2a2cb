// Programs around a part, the student's in a sandbox and ours from a cache: the compiler, its messages in plain words,
// the builders.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/sandbox.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {

/// Compiling may start the compiler's own passes; half a minute of CPU is thirty times what a part takes, and 1 GB for
/// each pass five times. The wall is far off: on a busy machine waiting is not the source's fault.
constexpr Limits compile_limits{.cpu = 30, .wall = 1800, .memory = 1024, .processes = 64, .output = 4096, .file = 64};

class Compiler {
 public:
  /// Throws InputError when there is no C++ compiler, or no folder for a cache.
  Compiler();

  /// The program and options that every call begins with; the standard is not among them.
  const std::vector<std::string>& command() const { return command_; }
  /// Changes with the compiler and those options.
  const std::string& fingerprint() const { return fingerprint_; }
  const std::filesystem::path& cache() const { return cache_; }

  /// The file that was made for this key, made now by `make` (which is given the file to write) where there is none.
  /// Whoever asks at the same time finds all of it or nothing.
  std::filesystem::path cached(const std::string& key, const std::string& ending,
                               const std::function<void(const std::filesystem::path&)>& make) const;

 private:
  std::vector<std::string> command_;
  std::string fingerprint_;
  std::filesystem::path cache_;
};

/// Where a program says that a student's files stand, in whatever folder they were compiled.
constexpr std::string_view student_folder = "/handed-in";
/// The compiler's option for files that stand below this folder.
std::string as_student_folder(const std::filesystem::path& folder);

/// Options of Builder::checked(). No position-independent program: its addresses are those of its file.
const std::vector<std::string>& checking_options();

/// Runs the command in the sandbox, which may write to `writable`. Throws std::runtime_error that says what became of
/// `what` where it did not end well: these are sources of ours.
void compile_ours(const Sandbox& trusted, const std::vector<std::string>& command,
                  const std::filesystem::path& writable, const std::string& what);

/// Fingerprint of a text, as a file name.
std::string key_of(const std::string& content);

/// That compiling the file takes more memory, or a larger file, than it may.
Remark too_large(const std::string& file);

/// The first error that concerns the student's `file` (its bare name), or one of `own` that it includes: where and
/// what. `said` is what g++ or clang++ wrote, in English.
Remark first_error(const std::string& file, const std::string& said, const std::vector<std::string>& own = {});

struct Built {
  std::filesystem::path program;   // empty: there is none
  Remark error = {};               // why
  bool missing = false;            // it was not handed in; else it does not compile
  std::vector<Remark> notes = {};  // what else is to be said before any test
};

/// How an assignment's submissions become one program per part. `trusted` runs the compiler on sources of ours,
/// `sandbox` on a student's.
class Builder {
 public:
  virtual ~Builder() = default;

  /// The part's program with this source of ours in the part's place (its solution, a known mistake). Compiled at most
  /// once for the same contents. Throws std::runtime_error with the compiler's words.
  virtual std::filesystem::path ours(const std::string& part, const std::string& source) const = 0;

  /// Every part's program with what the student wrote, compiled in the sandbox within `folder`, which need not exist;
  /// `jobs` compilers at a time.
  virtual std::map<std::string, Built> theirs(const Submission& submission, const std::filesystem::path& folder,
                                              unsigned jobs) const = 0;

  /// The part's program once more, for an experiment: the submission may have been changed, and each call of a function
  /// in `wrapped` goes to __wrap_NAME in `around`, a source of ours (ld's --wrap). Nothing where programs are whole.
  virtual Built varied(const Submission&, const std::string&, const std::filesystem::path&,
                       const std::vector<std::string>& = {}, const std::string& = "") const {
    return {};
  }

  /// The part's program once more, which ends where it asks for an index that is not there and says which on standard
  /// error, as the standard library's debug mode and the compiler's own checks do, and says where it is when it
  /// crashes.
  virtual Built checked(const Submission& submission, const std::string& part,
                        const std::filesystem::path& folder) const = 0;

  /// A part's file within the folder of a solution.
  virtual std::string file_of(const std::string& part) const { return part + ".cpp"; }
};

/// As the assignment says. Throws InputError when there is no C++ compiler.
std::unique_ptr<Builder> builder_for(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

std::filesystem::path solution_of(const Assignment& assignment, const Builder& builder, const std::string& part);

std::string content_of_file(const std::filesystem::path& file);
/// A file below grader/ with {0}, {1}, ... filled in.
std::string filled(const std::string& file, const std::vector<std::string>& with);

}  // namespace coursework
