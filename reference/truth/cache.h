// Cache of truths in files, because converged ones take seconds.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reference/truth/truth.h"

namespace crosscheck {

/// The linker's fingerprint of the running program (hexadecimal), or an empty string.
std::string build_id();

/// Truths of one program in a folder, one per file, keyed by everything they depend on: the scene (hash and step), the
/// run's duration and samples, and the program, so that another build never reads them.
class TruthCache {
 public:
  TruthCache(std::filesystem::path folder, std::string program)
      : folder_(std::move(folder)), program_(std::move(program)) {}
  /// The cache in $CROSSCHECK_CACHE, else $XDG_CACHE_HOME/crosscheck, else ~/.cache/crosscheck; nullopt if none is
  /// defined, or the program has no build id.
  static std::optional<TruthCache> from_environment();

  /// Returns the stored truth, or computes and stores one ("no truth" is stored too). Ignores damaged files and those
  /// of another program. Stores nothing if the folder is not writable.
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
