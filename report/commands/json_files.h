// Machine-readable output: tables and parity certificates as JSON files, and JUnit XML.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/base/json.h"
#include "reference/certificate/certificate.h"

namespace crosscheck {

std::string certificate_json(const Certificate& certificate);

/// Columns from a header like "method, step [s]"; a column without a unit gets "1".
std::vector<Column> columns_of(const std::string& header);

/// File name of a certificate: certificate-SCENE-METHOD.json.
std::string file_of(const Certificate& certificate);
/// Writes tables with their dictionary as CSV, and the certificates.
void write_tables(const TableSet& rows, const Provenance& lines, const std::filesystem::path& folder);

/// A table's rows as objects by column name. Empty cells and non-finite numbers are null.
Json rows_json(const Table& table);

/// Provenance, notes and tables as JSON. A table has its columns with units, and its rows as objects by column name,
/// with the same cells as the CSV files.
std::string tables_json(const TableSet& rows, const Provenance& provenance);

struct TestCase {
  std::string group, name;
  std::string outcome = {};  // failure, error or skipped; empty if the case passed
  std::string message = {}, text = {};
};
/// JUnit XML in the form that CI systems read.
std::string junit_xml(const std::string& suite, const std::vector<TestCase>& cases);

}  // namespace crosscheck
