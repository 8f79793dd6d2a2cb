// Tables: columns with units, rows of cells, written as CSV with their provenance.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace crosscheck {

/// Empty means not applicable. nan and inf are allowed in failed rows only.
using Cell = std::variant<std::monostate, std::string, double, long>;
inline Cell cell_of(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

/// `# key: value` lines above a table: who made these numbers, from what, with what.
using Provenance = std::vector<std::pair<std::string, std::string>>;

struct Column {
  std::string name, unit;  // unit "1" when dimensionless
  bool operator==(const Column&) const = default;
};

struct Table {
  std::string name;  // file name without .csv; names that end in -cost hold timings
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;

  void add(std::vector<Cell> row);            // throws std::logic_error where it has not as many cells as columns
  int column(const std::string& name) const;  // throws std::out_of_range with the name
  const Cell& at(size_t row, const std::string& column) const { return rows[row][this->column(column)]; }
};

/// Text of a number: 17 significant digits, so that it reads back to the same bits.
std::string exact_text(double value);

/// A field of CSV, in quotes where it needs them.
std::string csv_field(const std::string& text);

/// A row of it, without the line feed.
std::string csv_row(const std::vector<Cell>& row);

/// RFC 4180: comma, LF, quotes where needed; one header row "name [unit]".
std::string csv(const Table& table, const Provenance& provenance);
void write_csv(const Table& table, const Provenance& provenance, const std::filesystem::path& folder);

}  // namespace crosscheck
