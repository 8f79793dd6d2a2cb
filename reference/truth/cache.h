// Cache of truths in files, by scene, run and program.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "reference/truth/truth.h"

namespace crosscheck {

// Identity of the running program.

/// The linker's fingerprint of the running program's content, in hexadecimal digits; empty if it has none.
std::string build_id();

// Truths found earlier: converged ones take seconds, and the same ones are needed repeatedly.

/// Truths of one program in a folder, one file each, with everything a truth depends on as the key: the scene (its hash
/// and step), and the run's duration and samples. The program is part of the key: another build never reads them.
class TruthCache {
 public:
  TruthCache(std::filesystem::path folder, std::string program)
      : folder_(std::move(folder)), program_(std::move(program)) {}
  /// The folder $CROSSCHECK_CACHE, else $XDG_CACHE_HOME/crosscheck, else ~/.cache/crosscheck. Returns nullopt if no
  /// such folder is defined, or the program has no build id.
  static std::optional<TruthCache> from_environment();

  /// Returns the stored truth, or computes and stores one; "no truth" is stored too. A file that is damaged or was made
  /// by another program is ignored. If the folder is not writable, nothing is stored.
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
