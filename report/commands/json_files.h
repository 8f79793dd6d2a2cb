#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/base/json.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate);

/// Parses a header like "method, step [s]"; a column without a unit gets "1".
std::vector<Column> columns_of(const std::string& header);

/// certificate-SCENE-METHOD.json
std::string file_of(const Certificate& certificate);
/// Writes tables and their dictionary as CSV, and the certificates as JSON.
void write_tables(const TableSet& rows, const Provenance& lines, const std::filesystem::path& folder);

/// Rows as objects by column name. Empty cells and non-finite numbers are null.
Json rows_json(const Table& table);

/// Provenance, notes and tables. A table has its columns with units, and its rows as in rows_json().
std::string tables_json(const TableSet& rows, const Provenance& provenance);

struct TestCase {
  std::string group, name;
  std::string outcome = {};  // failure, error or skipped; empty: passed
  std::string message = {}, text = {};
};
std::string junit_xml(const std::string& suite, const std::vector<TestCase>& cases);

}  // namespace crosscheck
