// The folder in which a sweep keeps what its points gave: one file per point, by its hash.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/point.h"

namespace crosscheck {

class Store {
 public:
  explicit Store(std::filesystem::path folder) : folder_(std::move(folder)) {}
  bool has(const std::string& hash) const { return find(hash).has_value(); }
  /// Nothing where the point is not there; a file that cannot be read counts as not there.
  std::optional<Rows> find(const std::string& hash) const;
  /// Written under another name and renamed: a killed run leaves whole files only.
  void keep(const std::string& hash, const Rows& rows) const;
  /// Why a point failed, in a file of its own; it does not count as there, and the next keep() or run replaces it.
  void keep_failure(const std::string& hash, const std::string& why) const;
  void forget_failure(const std::string& hash) const;
  std::optional<std::string> failure_of(const std::string& hash) const;
  void clear() const { std::filesystem::remove_all(folder_); }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path file_of(const std::string& hash) const { return folder_ / (hash + ".json"); }
  std::filesystem::path failure_file_of(const std::string& hash) const { return folder_ / (hash + ".failed"); }
  std::filesystem::path folder_;
};

}  // namespace crosscheck
