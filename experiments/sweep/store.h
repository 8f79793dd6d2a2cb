// Files of a sweep: its list of points, and the tables of each point as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

// List of a sweep's points, written next to the store, so that shards can be joined later.

struct PointList {
  struct Entry {
    std::string name, hash;
    bool operator==(const Entry&) const = default;
  };
  std::vector<std::string> experiments;  // experiments that draw conclusions from the rows of all points
  std::vector<Entry> points;
  Provenance provenance;  // origin of the tables: command, commit, scenes, ...
};

PointList point_list_of(std::vector<std::string> experiments, std::span<const Point> points, Provenance provenance);

void write_point_list(const PointList& list, const std::filesystem::path& folder);
/// Throws InputError with the file's name and the expected content.
PointList read_point_list(const std::filesystem::path& folder);

/// The folder for points inside the sweep's output folder.
std::filesystem::path store_in(const std::filesystem::path& folder);

// JSON of a table set. Reading it back restores the same bits.

std::string table_set_json(const TableSet& set);
TableSet read_table_set(const std::string& text);

// A folder with the rows of finished points: one file per point, named by its hash.

class Store {
 public:
  explicit Store(std::filesystem::path folder) : folder_(std::move(folder)) {}
  bool has(const std::string& hash) const { return find(hash).has_value(); }
  /// Returns nullopt if the point is missing, or if its file cannot be read, in which case `fault` is set to the
  /// reason.
  std::optional<TableSet> find(const std::string& hash, std::string* fault = nullptr) const;
  /// Writes a temporary file and renames it, so that a killed run leaves only complete files.
  void keep(const std::string& hash, const TableSet& tables) const;
  /// Stores the reason of a failure. The point remains missing, and the file is replaced by the next keep() or run.
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
