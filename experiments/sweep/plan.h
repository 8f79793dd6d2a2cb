// The plan of a sweep: the list of its points, written beside the store, so that shards can be joined later.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/point.h"

namespace crosscheck {

struct Plan {
  struct Entry {
    std::string name, hash;
    bool operator==(const Entry&) const = default;
  };
  std::vector<std::string> experiments;  // whose conclusions are drawn from the rows
  std::vector<Entry> points;
  Provenance provenance;  // of the tables: command, commit, scenes, ...
};

Plan plan_of(std::vector<std::string> experiments, std::span<const Point> points, Provenance provenance);

void write_plan(const Plan& plan, const std::filesystem::path& folder);
/// Throws InputError that names the file and what was expected.
Plan read_plan(const std::filesystem::path& folder);

/// Where the points of a sweep with that output folder are kept.
std::filesystem::path store_in(const std::filesystem::path& folder);

}  // namespace crosscheck
