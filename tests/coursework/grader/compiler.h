// The compiler, and the cache of what it made of sources of ours.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/coursework/grader/lane.h"

namespace coursework {

/// Compiling may start the compiler's own passes; half a minute of CPU is thirty times what a part takes. The wall is
/// far off: on a busy machine waiting is not the source's fault.
constexpr Limits compile_limits{.cpu = 30, .wall = 300, .memory = 4096, .processes = 64, .output = 4096, .file = 64};

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

/// Runs the command in the lane, which may write to `writable`. Throws std::runtime_error that says what became of
/// `what` where it did not end well: these are sources of ours.
void compile_ours(const Lane& trusted, const std::vector<std::string>& command, const std::filesystem::path& writable,
                  const std::string& what);

/// Fingerprint of a text, as a file name.
std::string key_of(const std::string& content);

}  // namespace coursework
