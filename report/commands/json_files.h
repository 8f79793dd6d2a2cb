// Tables and parity certificates as JSON files, and JUnit XML, for programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/base/json.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate);

/// Columns from a header like "method, step [s]"; without a unit they have 1.
std::vector<Column> columns_of(const std::string& header);

/// certificate-SCENE-METHOD.json.
std::string file_of(const Certificate& certificate);
/// Writes tables with their dictionary as CSV, and the certificates.
void write_tables(const TableSet& rows, const Provenance& lines, const std::filesystem::path& folder);

/// A table's rows as objects by column name. Empty cells and numbers that are not finite are null.
Json rows_json(const Table& table);

/// Provenance, notes, and of each table its columns with units and its rows as objects by column name: the same cells
/// as in the CSV files.
std::string tables_json(const TableSet& rows, const Provenance& provenance);

struct TestCase {
  std::string group, name;
  std::string outcome = {};  // failure, error or skipped; empty if the case passed
  std::string message = {}, text = {};
};
/// JUnit XML, as CI systems read it.
std::string junit_xml(const std::string& suite, const std::vector<TestCase>& cases);

}  // namespace crosscheck
