// A cache of truths in files, by scene, run and program.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reference/truth/truth.h"

namespace crosscheck {

// The identity of the running program.

/// The linker's fingerprint of the running program's content, in hexadecimal digits; empty where it has none.
std::string build_id();

// Truth that was found before: converged ones cost seconds, and the same ones are needed again and again.

/// Truths of one program in a folder, one file each, by what a truth depends on: the scene (its hash and step), the
/// run's duration and samples. The program is part of the key: another build never reads them.
class TruthCache {
 public:
  TruthCache(std::filesystem::path folder, std::string program)
      : folder_(std::move(folder)), program_(std::move(program)) {}
  /// The folder $CROSSCHECK_CACHE, else $XDG_CACHE_HOME/crosscheck, else ~/.cache/crosscheck. None where no such folder
  /// is named, or the program has no build id.
  static std::optional<TruthCache> from_environment();

  /// The stored truth, or a new one that is stored; "no truth" is stored too. A file that is damaged or was made by
  /// another program counts for nothing, and a folder that cannot be written to stores nothing.
  std::optional<Truth> find_or_compute(const Scene& scene, const Run& run,
                                       const std::function<std::optional<Truth>()>& compute) const;
  std::filesystem::path file_of(const Scene& scene, const Run& run) const;

 private:
  std::string key_of(const Scene& scene, const Run& run) const;
  std::filesystem::path file_at(const std::string& key) const;
  std::filesystem::path folder_;
  std::string program_;
};

}  // namespace crosscheck
