// Tables as structs: a row is a struct that declares its columns once, and both writers and readers use the
// struct.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "experiments/tables/table.h"
#include "mysim/base/errors.h"
#include "mysim/run/run.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// A column of the table whose rows are `Row`s: its name and unit in the header, and what the data dictionary says of
/// it.
template <class Row, class T>
struct ColumnOf {
  std::string_view name, unit;
  T Row::*member;
  std::string_view description;
};
template <class Row, class T>
constexpr ColumnOf<Row, T> column(std::string_view name, std::string_view unit, T Row::*member,
                                  std::string_view description) {
  return {name, unit, member, description};
}

/// The words of an enum that stands in tables, in the order of its values from `first` on. To be specialised next to
/// each.
template <class Enum>
struct EnumRange;  // static constexpr Enum first, last;
template <>
struct EnumRange<Verdict> {
  static constexpr Verdict first = Verdict::ok, last = Verdict::unsupported;
};
template <>
struct EnumRange<Tier> {
  static constexpr Tier first = Tier::exact, last = Tier::another_engine;
};

template <class T>
struct CellOf;

/// The value as a cell: enums as their words, bool as 1 or 0, an empty optional as an empty cell.
template <class T>
Cell to_cell(const T& value) {
  return CellOf<T>::write(value);
}

template <>
struct CellOf<std::string> {
  static Cell write(const std::string& value) { return value; }
  static std::string read(const Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (std::holds_alternative<std::monostate>(cell)) return "";
    throw InputError("expected a text");
  }
};
template <>
struct CellOf<double> {
  static Cell write(double value) { return value; }
  static double read(const Cell& cell) {  // whole numbers of a file too
    if (const auto* number = std::get_if<double>(&cell)) return *number;
    if (const auto* whole = std::get_if<long>(&cell)) return static_cast<double>(*whole);
    throw InputError("expected a number");
  }
};
template <>
struct CellOf<long> {
  static Cell write(long value) { return value; }
  static long read(const Cell& cell) {
    if (const auto* whole = std::get_if<long>(&cell)) return *whole;
    throw InputError("expected a whole number");
  }
};
template <>
struct CellOf<int> {
  static Cell write(int value) { return static_cast<long>(value); }
  static int read(const Cell& cell) { return static_cast<int>(CellOf<long>::read(cell)); }
};
template <>
struct CellOf<bool> {
  static Cell write(bool value) { return static_cast<long>(value); }
  static bool read(const Cell& cell) { return CellOf<long>::read(cell) != 0; }
};
template <class Enum>
requires std::is_enum_v<Enum>
struct CellOf<Enum> {
  static Cell write(Enum value) { return std::string(name_of(value)); }
  static Enum read(const Cell& cell) {
    // a file whose column holds this word alone, or nothing, reads it as a number
    const auto* number = std::get_if<double>(&cell);
    const std::string word = number && std::isnan(*number) ? "nan" : CellOf<std::string>::read(cell);
    for (int i = static_cast<int>(EnumRange<Enum>::first); i <= static_cast<int>(EnumRange<Enum>::last); ++i)
      if (name_of(static_cast<Enum>(i)) == word) return static_cast<Enum>(i);
    throw InputError(fmt::format("unknown word '{}'", word));
  }
};
/// An all-empty column of a file reads as text "".
template <class T>
struct CellOf<std::optional<T>> {
  static Cell write(const std::optional<T>& value) { return value ? CellOf<T>::write(*value) : Cell(); }
  static std::optional<T> read(const Cell& cell) {
    if (std::holds_alternative<std::monostate>(cell)) return std::nullopt;
    if (!std::is_same_v<T, std::string> && std::holds_alternative<std::string>(cell) &&
        std::get<std::string>(cell).empty())
      return std::nullopt;
    return CellOf<T>::read(cell);
  }
};

template <class Row>
std::vector<Column> columns_of() {
  return std::apply(
      [](const auto&... column) {
        return std::vector<Column>{{std::string(column.name), std::string(column.unit)}...};
      },
      Row::columns);
}

/// An empty table of such rows; Row::table is its name unless another is given (one table for each scene).
template <class Row>
Table table_of(std::string name = std::string(Row::table)) {
  return {std::move(name), columns_of<Row>(), {}};
}

template <class Row>
void add(Table& table, const Row& row) {
  table.rows.push_back(std::apply(
      [&](const auto&... column) { return std::vector<Cell>{to_cell(row.*(column.member))...}; }, Row::columns));
}

/// Throws InputError that names the table, and the column where a cell holds something else; where the table has other
/// columns, too.
template <class Row>
std::vector<Row> rows_of(const Table& table) {
  if (table.columns != columns_of<Row>())
    throw InputError(fmt::format("table {}: expected the columns of table {}", table.name, Row::table));
  std::vector<Row> rows;
  rows.reserve(table.rows.size());
  for (const std::vector<Cell>& cells : table.rows) {
    Row& row = rows.emplace_back();
    size_t i = 0;
    const auto read = [&](const auto& column) {
      using Value = std::decay_t<decltype(row.*(column.member))>;
      try {
        row.*(column.member) = CellOf<Value>::read(cells[i++]);
      } catch (const InputError& error) {
        throw InputError(fmt::format("table {}, column {}: {}", table.name, column.name, error.what()));
      }
    };
    std::apply([&](const auto&... column) { (read(column), ...); }, Row::columns);
  }
  return rows;
}

}  // namespace crosscheck
