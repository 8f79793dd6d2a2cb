// What stands in a table's cells, for those who read tables: charts, sentences, conclusions.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "experiments/table.h"

namespace crosscheck {

/// Throws std::bad_variant_access where it is no text.
inline const std::string& text_at(const Table& table, size_t row, const std::string& column) {
  return std::get<std::string>(table.at(row, column));
}
/// The text, or "" where the cell is empty.
inline std::string text_or_none(const Table& table, size_t row, const std::string& column) {
  const auto* text = std::get_if<std::string>(&table.at(row, column));
  return text ? *text : "";
}
/// Whole numbers too; nothing where the cell is empty or text.
inline std::optional<double> number_at(const Table& table, size_t row, const std::string& column) {
  const Cell& cell = table.at(row, column);
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* whole = std::get_if<long>(&cell)) return static_cast<double>(*whole);
  return std::nullopt;
}
inline double number_at(const Table& table, size_t row, const std::string& column, double otherwise) {
  return number_at(table, row, column).value_or(otherwise);
}
/// False where the cell is empty.
inline bool flag_at(const Table& table, size_t row, const std::string& column) {
  const auto* flag = std::get_if<long>(&table.at(row, column));
  return flag && *flag != 0;
}
/// The texts of a column, each once, in the order in which they come first.
inline std::vector<std::string> distinct(const Table& table, const std::string& column) {
  std::vector<std::string> all;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const std::string& text = text_at(table, i, column); std::find(all.begin(), all.end(), text) == all.end())
      all.push_back(text);
  return all;
}

}  // namespace crosscheck
