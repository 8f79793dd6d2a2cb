// Tables as one JSON file, for programs.
#pragma once

#include "experiments/point.h"

namespace crosscheck {

/// Provenance, notes, and of each table its columns with units and its rows as objects by column name: the same cells
/// as in the CSV files. Empty cells and numbers that are not finite are null.
std::string tables_json(const Rows& rows, const Provenance& provenance);

}  // namespace crosscheck
