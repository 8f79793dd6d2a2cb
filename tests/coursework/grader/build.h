// Builds a program around each part: the student's in a sandbox, ours from a cache.
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

/// Limits of the compiler, which may start processes for its passes. A part needs about 1 s of CPU time, and a fifth of
/// the 1 GB that each pass may use. The wall-clock limit is large, because a busy machine is not the source's fault.
constexpr Limits compile_limits{.cpu = 30, .wall = 1800, .memory = 1024, .processes = 64, .output = 4096, .file = 64};

class Compiler {
 public:
  /// Throws InputError if there is no C++ compiler, or no folder for the cache.
  Compiler();

  /// The program and the options of every call, without the language standard.
  const std::vector<std::string>& command() const { return command_; }
  /// Hash that changes with the compiler and these options.
  const std::string& fingerprint() const { return fingerprint_; }
  const std::filesystem::path& cache() const { return cache_; }

  /// The file for this key, created by `make` (which receives the path to write) if it does not exist. Concurrent
  /// callers never see a partial file.
  std::filesystem::path cached(const std::string& key, const std::string& ending,
                               const std::function<void(const std::filesystem::path&)>& make) const;

 private:
  std::vector<std::string> command_;
  std::string fingerprint_;
  std::filesystem::path cache_;
};

/// Folder that programs report for the student's files, wherever these were compiled.
constexpr std::string_view student_folder = "/handed-in";
/// The compiler's option that reports files below `folder` as files of student_folder.
std::string as_student_folder(const std::filesystem::path& folder);

/// Options of Builder::checked(). Programs are not position-independent, so that run-time addresses equal those in the
/// file.
const std::vector<std::string>& checking_options();

/// Runs the command in the sandbox, where it may write to `writable`. Throws std::runtime_error that names `what` if
/// the command fails, which means an error in our sources.
void compile_ours(const Sandbox& trusted, const std::vector<std::string>& command,
                  const std::filesystem::path& writable, const std::string& what);

/// Fingerprint of a text, as a file name.
std::string key_of(const std::string& content);

/// The remark that compiling the file exceeds the limit on memory or file size.
Remark too_large(const std::string& file);

/// The remark with line and text of the first error in the student's `file` (its bare name), or in one of the files
/// `own` that it includes. `said` is the output of g++ or clang++ in English.
Remark first_error(const std::string& file, const std::string& said, const std::vector<std::string>& own = {});

struct Built {
  std::filesystem::path program;   // empty if not built
  Remark error = {};               // reason, if not built
  bool missing = false;            // true: not handed in; false: does not compile
  std::vector<Remark> notes = {};  // remarks that precede the tests
};

/// Builds an assignment's submissions into one program per part. `trusted` runs the compiler on our sources, `sandbox`
/// on the student's.
class Builder {
 public:
  virtual ~Builder() = default;

  /// The part's program with a source of ours (the solution, or one with a known mistake). Compiles the same contents
  /// only once. Throws std::runtime_error with the compiler's output.
  virtual std::filesystem::path ours(const std::string& part, const std::string& source) const = 0;

  /// Every part's program with the student's code, compiled in the sandbox within `folder`, which need not exist. Runs
  /// `jobs` compilers in parallel.
  virtual std::map<std::string, Built> theirs(const Submission& submission, const std::filesystem::path& folder,
                                              unsigned jobs) const = 0;

  /// Rebuilds the part's program for an experiment, in which the submission may be modified. Each call of a function in
  /// `wrapped` is redirected to __wrap_NAME in `around`, a source of ours (ld's --wrap). Returns nothing for whole
  /// programs.
  virtual Built varied(const Submission&, const std::string&, const std::filesystem::path&,
                       const std::vector<std::string>& = {}, const std::string& = "") const {
    return {};
  }

  /// Rebuilds the part's program with checks. An index out of range ends the program and is reported on standard error
  /// (by the standard library's debug mode or the compiler's own checks), and a crash reports its location.
  virtual Built checked(const Submission& submission, const std::string& part,
                        const std::filesystem::path& folder) const = 0;

  /// Path of a part's file within the folder of a solution.
  virtual std::string file_of(const std::string& part) const { return part + ".cpp"; }
  /// Name of the student's file for a part.
  virtual std::string handed_in(const std::string& part) const { return file_of(part); }
};

/// The assignment's own builder, or the default. Throws InputError if there is no C++ compiler.
std::unique_ptr<Builder> builder_for(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

std::filesystem::path solution_of(const Assignment& assignment, const Builder& builder, const std::string& part);

std::string content_of_file(const std::filesystem::path& file);
/// The content of a file below grader/, in which {0}, {1}, ... are replaced.
std::string filled(const std::string& file, const std::vector<std::string>& with);

}  // namespace coursework
