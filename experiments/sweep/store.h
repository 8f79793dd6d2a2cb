// Files of a sweep: its list of points, and the tables of each as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

// The list of a sweep's points, written next to the store, so that shards can be joined later.

struct PointList {
  struct Entry {
    std::string name, hash;
    bool operator==(const Entry&) const = default;
  };
  std::vector<std::string> experiments;  // those that draw conclusions from the rows
  std::vector<Entry> points;
  Provenance provenance;  // of the tables: command, commit, scenes, ...
};

PointList point_list_of(std::vector<std::string> experiments, std::span<const Point> points, Provenance provenance);

void write_point_list(const PointList& list, const std::filesystem::path& folder);
/// Throws InputError that names the file and what was expected.
PointList read_point_list(const std::filesystem::path& folder);

/// The folder for the points of a sweep with that output folder.
std::filesystem::path store_in(const std::filesystem::path& folder);

// A table set as JSON, read back to the same bits: the form in which a finished point is kept.

std::string table_set_json(const TableSet& set);
/// Throws InputError, "expected ...", when the text is no table set.
TableSet read_table_set(const std::string& text);

// The folder in which a sweep keeps its points' rows: one file per point, by its hash.

class Store {
 public:
  explicit Store(std::filesystem::path folder) : folder_(std::move(folder)) {}
  bool has(const std::string& hash) const { return find(hash).has_value(); }
  /// Nothing where the point is not there; a file that cannot be read counts as not there, and `fault` says why.
  std::optional<TableSet> find(const std::string& hash, std::string* fault = nullptr) const;
  /// Written under another name and renamed: a killed run leaves whole files only.
  void keep(const std::string& hash, const TableSet& tables) const;
  /// Stores why a point failed, in its own file; it does not count as there, and the next keep() or run replaces it.
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
