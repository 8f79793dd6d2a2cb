// Tables: columns with units, and rows of cells; reading and writing as CSV with provenance.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace crosscheck {

/// A cell is empty if the quantity is not applicable. nan and inf are allowed in failed rows only.
using Cell = std::variant<std::monostate, std::string, double, long>;
inline Cell cell_of(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }

/// `# key: value` lines above a table: the program that made the numbers, its inputs and its tools.
using Provenance = std::vector<std::pair<std::string, std::string>>;

struct Column {
  std::string name, unit;  // unit "1" when dimensionless
  bool operator==(const Column&) const = default;
};

struct Table {
  std::string name;  // file name without .csv; tables whose names end in -cost contain timings
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;

  void add(std::vector<Cell> row);            // throws std::logic_error unless `row` has one cell per column
  int column(const std::string& name) const;  // throws std::out_of_range with the name
  const Cell& at(size_t row, const std::string& column) const { return rows[row][this->column(column)]; }
};

/// Text of 17 significant digits, which is read back to the same bits.
std::string exact_text(double value);

/// A line of a CSV file, without the line feed.
std::string csv_row(const std::vector<Cell>& row);

/// Text of a CSV file according to RFC 4180 (comma, LF, quotes where needed) with one header row "name [unit]".
std::string csv(const Table& table, const Provenance& provenance);
void write_csv(const Table& table, const Provenance& provenance, const std::filesystem::path& folder);

/// Throws std::bad_variant_access if the cell is not text.
inline const std::string& text_at(const Table& table, size_t row, const std::string& column) {
  return std::get<std::string>(table.at(row, column));
}
inline std::string text_or_none(const Table& table, size_t row, const std::string& column) {
  const auto* text = std::get_if<std::string>(&table.at(row, column));
  return text ? *text : "";
}
inline std::optional<double> number_at(const Table& table, size_t row, const std::string& column) {
  const Cell& cell = table.at(row, column);
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* whole = std::get_if<long>(&cell)) return static_cast<double>(*whole);
  return std::nullopt;
}
inline double number_at(const Table& table, size_t row, const std::string& column, double otherwise) {
  return number_at(table, row, column).value_or(otherwise);
}
/// True if the cell is 1; false if it is 0 or empty.
inline bool flag_at(const Table& table, size_t row, const std::string& column) {
  const auto* flag = std::get_if<long>(&table.at(row, column));
  return flag && *flag != 0;
}
/// The distinct texts of a column, in order of first appearance.
inline std::vector<std::string> distinct(const Table& table, const std::string& column) {
  std::vector<std::string> all;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const std::string& text = text_at(table, i, column); std::find(all.begin(), all.end(), text) == all.end())
      all.push_back(text);
  return all;
}

/// Reads a table that write_csv() wrote, without its provenance. Whole numbers become long, other numbers double. A
/// column that is empty or contains any other text is read as text. Throws InputError: "FILE:LINE: expected ...".
Table read_csv(const std::filesystem::path& file);

}  // namespace crosscheck
