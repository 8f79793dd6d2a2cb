// Tables and parity certificates as JSON files, for programs.
#pragma once

#include <string>

#include "experiments/experiment.h"
#include "mysim/base/json.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate);

/// A table's rows as objects by column name. Empty cells and numbers that are not finite are null.
Json rows_json(const Table& table);

/// Provenance, notes, and of each table its columns with units and its rows as objects by column name: the same cells
/// as in the CSV files.
std::string tables_json(const TableSet& rows, const Provenance& provenance);

}  // namespace crosscheck
